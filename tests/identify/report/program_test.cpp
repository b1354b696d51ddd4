// SPDX-License-Identifier: BSD-3-Clause
//
// catena report, as a user runs it.
#include <doctest/doctest.h>

#include "tests/identify/program/catena_program.hpp"
#include "tests/identify/report/made_results.hpp"

namespace catena::testing {
namespace {

TEST_CASE("catena report writes a page beside the result, or what else is asked for") {
  const TemporaryFolder folder;
  folder.write("result.json", report::made_pendulum().dump());
  const std::string path = folder.path().string();

  const ProcessResult plain = run_catena({"report", path});
  CHECK(plain.exit_status == 0);
  CHECK(plain.output == path + "/report.html: 16 figures, 0.3 MB\n");
  CHECK(text_of(folder.path() / "report.html").starts_with("<!DOCTYPE html>"));
  std::filesystem::remove(folder.path() / "report.html");

  const ProcessResult figures = run_catena({"report", path, "--csv", path + "/csv"});
  CHECK(figures.exit_status == 0);
  CHECK(std::filesystem::exists(folder.path() / "csv/error_over_time.csv"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "report.html"));

  const ProcessResult data = run_catena({"report", path, "--json"});
  CHECK(data.exit_status == 0);
  CHECK(nlohmann::json::parse(data.output)["kind"] == "report");
}

TEST_CASE("catena report: wrong input ends with 2, says why and writes nothing") {
  const TemporaryFolder folder;
  const std::string path = folder.path().string();
  nlohmann::json spoilt = report::made_pendulum();
  spoilt["experiments"][0]["measured"]["angle"][0].push_back(1.0);
  folder.write("spoilt.json", spoilt.dump());
  folder.write("good.json", report::made_pendulum().dump());
  struct Row {
    std::vector<std::string> arguments;
    const char* words;
  };
  for (const Row& row :
       {Row{{path + "/none.json"},
            "none.json: cannot be read (No such file or directory); give a result.json"},
        Row{{path + "/spoilt.json"}, "experiments[0].measured.angle[0] is"},
        Row{{}, "RESULT is required"}, Row{{path + "/good.json", "--pdf"}, "--pdf"},
        Row{{path + "/good.json", "-o", "/proc/none/report.html"}, "/proc/none"}}) {
    CAPTURE(row.words);
    std::vector<std::string> arguments = {"report"};
    arguments.insert(arguments.end(), row.arguments.begin(), row.arguments.end());
    const ProcessResult result = run_catena(arguments);
    CAPTURE(result.output);
    CHECK(result.exit_status == 2);
    CHECK(result.output.find(row.words) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(folder.path() / "report.html"));
  }
}

}  // namespace
}  // namespace catena::testing
