// SPDX-License-Identifier: BSD-3-Clause
//
// What needs more time or memory than is begun unasked, through the program: refused with status 2 and
// nothing written; begun with --yes.
#include <doctest/doctest.h>

#include "tests/identify/program/catena_program.hpp"

using namespace catena;
using testing::replaced;
using testing::run_catena;

namespace {

const char* const kColumns = "time_s,side_1_m,down_1_m,side_2_m,down_2_m\n";
const char* const kPoints = ",0.28,0.41,0.56,0.83\n";

/// Rows so many seconds apart.
std::string rows(int count, double apart) {
  std::string text = kColumns;
  for (int k = 0; k < count; ++k) text += std::to_string(k * apart) + kPoints;
  return text;
}

void check_refused(const testing::TemporaryFolder& folder, std::vector<std::string> call,
                   const std::string& what) {
  const std::filesystem::path out = folder.path() / "out";
  call.insert(call.end(), {"--output", out});
  const ProcessResult refused = run_catena(call);
  CHECK(refused.exit_status == 2);
  CHECK_MESSAGE(refused.output.find(what) != std::string::npos, refused.output);
  CHECK_MESSAGE(refused.output.find("--yes") != std::string::npos, refused.output);
  CHECK_FALSE(std::filesystem::exists(out));
}

std::string fit_of(const std::string& data) {
  return replaced(replaced(testing::kFit, "swing/positions.csv", data), "fit_until = 0.6\n", "");
}

/// A fit to 2e8 s of a motion that never ends, in as many steps as it takes.
std::string endless_fit(const testing::TemporaryFolder& folder) {
  folder.write("data.csv", rows(3, 1e8));
  std::string text = replaced(fit_of("data.csv"), "value = 0.002", "value = 0.0");
  text = replaced(text, "lower = 0.0001", "lower = 0.0");
  return text + "[simulation]\nmax_steps = 1000000000\n";
}

}  // namespace

TEST_CASE("fits that would take hours are begun with --yes only") {
  const testing::TemporaryFolder folder;
  folder.write("data.csv", rows(3, 0.1));
  const std::string starts =
      fit_of("data.csv") + "[optimiser]\nmethod = \"nelder_mead\"\nstarts = ";
  const auto many = folder.write("case.toml", starts + "20000\n");
  check_refused(folder, {"identify", many, "--threads", "1", "--bootstrap", "100000"},
                "the identification needs about ");
  const auto run = [&](std::vector<std::string> more) {
    more.insert(more.begin(),
                {"identify", many, "--output", folder.path() / "out", "--threads", "1"});
    return run_catena(more);
  };
  CHECK(run({"--time-limit", "0.3"}).exit_status == 0);  // that is the time then
  CHECK(run({"--time-limit", "0.3", "--bootstrap", "1", "--yes"}).exit_status == 0);
}

TEST_CASE("profiles count as fits do") {
  const testing::TemporaryFolder folder;
  const auto slow = folder.write("case.toml", endless_fit(folder));
  check_refused(folder, {"identify", slow, "--profiles", "--time-limit", "1", "--threads", "1"},
                "the identification needs ");
}

TEST_CASE("simulations that would take hours end after seconds, without --yes") {
  const testing::TemporaryFolder folder;
  std::string alone = replaced(testing::kSwing, "value = 0.005", "value = 0.0");
  alone = replaced(alone, "duration = 1.0\nstep = 0.02",
                   "duration = 1e8\nstep = 1e5\nmax_steps = 1000000000");
  check_refused(folder, {"simulate", folder.write("alone.toml", alone)},
                "the simulation needs about ");
  const auto with_data = folder.write("case.toml", endless_fit(folder));
  check_refused(folder, {"simulate", with_data}, "the simulation needs about ");
  check_refused(folder, {"diagnose", with_data, "--threads", "1"},
                "the diagnosis needs more than ");
}

TEST_CASE("motions that fill the memory are kept with --yes only") {
  const testing::TemporaryFolder folder;
  folder.write("data.csv", rows(400'000, 0.001));
  const auto the_case =
      folder.write("case.toml", replaced(fit_of("data.csv"), "links = 2", "links = 12"));
  check_refused(folder, {"simulate", the_case}, "keeping the motions needs about 5.7 GB");
}
