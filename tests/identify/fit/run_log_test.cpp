// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/run_log.hpp"

#include <doctest/doctest.h>
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "common/sha256.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace catena;
using testing::text_of;

namespace {

HistoryEntry entry(double value) {
  return {value * value, Eigen::VectorXd::Constant(2, value), "said"};
}

/// A log of three evaluations.
std::string three_evaluations(const std::filesystem::path& file) {
  {
    RunLog log(file, "key", 2, false);
    for (const double value : {1.0, 2.0, 3.0}) log.record(0, entry(value));
  }
  return text_of(file);
}

std::string refusal(const std::filesystem::path& file, const std::string& key = "key") {
  return failure([&] { RunLog(file, key, 2, true); });
}

}  // namespace

TEST_CASE("a log of something else, and a file that is no log, are refused") {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "run.log";
  three_evaluations(file);
  CHECK(refusal(file, "other").find("belongs to another case") != std::string::npos);
  CHECK_NOTHROW(RunLog(file, "other", 2, false));
  folder.write("run.log", "my own notes\n");
  CHECK(failure([&] { RunLog(file, "key", 2, false); }).find("is no log") != std::string::npos);
  CHECK(text_of(file) == "my own notes\n");
  std::filesystem::remove(file);
  std::filesystem::create_symlink(folder.path() / "elsewhere",
                                  file);  // of a folder that others made
  CHECK(refusal(file).find("run.log: is a link") != std::string::npos);
  CHECK(!std::filesystem::exists(folder.path() / "elsewhere"));
}

TEST_CASE("any line that was damaged, edited or removed is noticed") {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "run.log";
  const std::string whole = three_evaluations(file);
  CHECK(refusal(file).empty());
  REQUIRE(std::count(whole.begin(), whole.end(), '\n') == 4);
  for (std::size_t at = whole.find('\n') + 1; at < whole.size(); ++at) {  // each character
    std::string damaged = whole;
    damaged[at] = damaged[at] == '7' ? '8' : '7';
    folder.write("run.log", damaged);
    // The end of a line that is gone joins two lines; at the end of the file, it is cut off.
    CHECK(refusal(file).empty() == (at + 1 == whole.size()));
  }
  const std::size_t second = whole.find('\n', whole.find('\n') + 1) + 1;
  const std::size_t third = whole.find('\n', second) + 1;
  folder.write("run.log", whole.substr(0, second) + whole.substr(third));
  CHECK(refusal(file).find("run.log:3: ") != std::string::npos);
}

TEST_CASE("a log cut off anywhere is continued") {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "run.log";
  const std::string whole = three_evaluations(file);
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    folder.write("run.log", whole.substr(0, length));
    {
      RunLog log(file, "key", 2, true);
      for (const double value : {1.0, 2.0, 3.0}) log.record(0, entry(value));
    }
    CHECK(text_of(file) == whole);
  }
}

TEST_CASE("a log that cannot be written any more says so once, and keeps what it has") {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "run.log";
  const std::string whole = three_evaluations(file);
  std::vector<std::string> said;
  {
    RunLog log(file, "key", 2, true, [&](const std::string& text) { said.push_back(text); });
    signal(SIGXFSZ, SIG_IGN);
    rlimit before = {};
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
    const rlimit full = {whole.size() + 10, before.rlim_max};
    REQUIRE(setrlimit(RLIMIT_FSIZE, &full) == 0);
    for (const double value : {1.0, 2.0, 3.0, 4.0, 5.0}) log.record(0, entry(value));
    REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
  }
  REQUIRE(said.size() == 1);
  CHECK(said[0].find("File too large") != std::string::npos);
  const RunLog log(file, "key", 2, true);
  CHECK(log.recall(0, entry(3).x) != nullptr);
  CHECK(log.recall(0, entry(4).x) == nullptr);
}

TEST_CASE("refits are kept bit by bit, each for the fit that it began at") {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "run.log";
  FitResult fit;
  fit.x = Eigen::Vector2d(1.0 / 3, -1e-300);
  FitResult other = fit;
  other.x[0] = std::nextafter(other.x[0], 1);
  CHECK(name_of(other) != name_of(fit));
  const Refit refit{"bootstrap", 7, name_of(fit)};
  const Eigen::Vector4d values(0.1, std::numeric_limits<double>::infinity(), -2.0 / 3, 5e-324);
  RunLog(file, "key", 4, false).finish(refit, values);
  const RunLog log(file, "key", 4, true);
  REQUIRE(log.refitted(refit).has_value());
  CHECK(*log.refitted(refit) == values);
  CHECK(!log.refitted({"bootstrap", 7, name_of(other)}));
  CHECK(!log.refitted({"bootstrap", 6, name_of(fit)}));
  CHECK(!log.refitted({"profile", 7, name_of(fit)}));
}

TEST_CASE("a line that no run writes is refused, though its check is right") {
  const testing::TemporaryFolder folder;
  struct Row {
    const char* line;
    bool read;
  };
  const Row rows[] = {
      {"e\t0\t0.5\t1,2\t", true},
      {"e\t0\t0.5\t1\t", false},
      {"s\t0\t1\t0.5\t0.7\t1,2\t2\t3\t1\t1\t0\tdone", true},
      {"s\t0\t1\t0.5\t0.7\t1\t2\t3\t1\t1\t0\tdone", false},
      {"s\t0\t99\t0.5\t0.7\t1,2\t2\t3\t1\t1\t0\tdone", false},
      {"s\t0\t0\t0.5\t0.7\t1,2\t2\t3\t1\t1\t0\tdone", false},  // not run
      {"r\tbootstrap\t0\tfit\t1,2", true},
      {"r\tbootstrap\t0\tfit\t1,2,3", false},
      {"r\tbootstrap\t0\tfit\t", false},
      {"r\tprofile\t0\tfit\t1,0.1,0.2,3,4", true},
      {"r\tprofile\t0\tfit\t", false},
      {"r\tprofile\t0\tfit\t1", false},
      {"r\tprofile\t0\tfit\t1,2,3,4", false},  // a cost is missing
      {"r\tprofile\t0\tfit\t7,0.1,0.2,3,4", false},
      {"r\tprofile\t0\tfit\tnan,0.1,0.2,3,4", false},
      {"r\tend\t0\tfit\t100,1", true},
      {"r\tend\t0\tfit\t100", false},
      {"r\tother\t0\tfit\t1,2", false},
      {"x", false},
  };
  for (const Row& row : rows) {
    CAPTURE(row.line);
    const auto file = folder.write("run.log", std::string("catena run log 2 key\n") + row.line +
                                                  "\t" + sha256_hex(row.line).substr(0, 16) + "\n");
    CHECK((refusal(file).find("run.log:2: ") != std::string::npos) == !row.read);
    CHECK(refusal(file).empty() == row.read);
  }
}

TEST_CASE("finished starts are taken over from the log of the shard that has them") {
  const testing::TemporaryFolder folder;
  const auto theirs = folder.path() / "theirs.log";
  {
    RunLog log(theirs, "key", 2, false);
    FitResult found;
    found.status = FitStatus::kConverged;
    found.x = Eigen::Vector2d(1, 2);
    log.record(1, entry(1));
    log.finish(1, found);
    log.record(4, entry(2));  // not finished
  }
  RunLog log(folder.path() / "own.log", "key", 2, false);
  log.take_over(theirs, {1, 3});
  REQUIRE(log.finished(1).has_value());
  CHECK(log.finished(1)->history.size() == 1);
  CHECK(!log.finished(4));
  CHECK(log.recall(4, entry(2).x) == nullptr);
  CHECK(failure([&] {
          log.take_over(theirs, {0, 3});
        }).find("the work of shard 2, not 1, of 3") != std::string::npos);
  RunLog stranger(folder.path() / "stranger.log", "another key", 2, false);
  CHECK(failure([&] {
          stranger.take_over(theirs, {1, 3});
        }).find("theirs.log: belongs to") != std::string::npos);
}
