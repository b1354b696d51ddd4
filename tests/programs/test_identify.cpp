// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "identify/case.hpp"
#include "tests/programs/catena_program.hpp"

using namespace catena;
using testing::run_catena;

namespace {

/// A folder with swing/positions.csv, made with k = 0.1 and c = 0.005.
struct Twin {
  testing::TemporaryFolder folder;
  Twin() {
    const auto swing = folder.write("swing.toml", testing::kSwing);
    REQUIRE(run_catena({"simulate", swing, "--output", folder.path() / "swing", "-q"}).exit_status == 0);
  }
};

}  // namespace

TEST_CASE("identify finds the truth, writes it, and the fitted case confirms it") {
  const Twin twin;
  for (const char* method : {"nelder_mead", "least_squares"}) {
    CAPTURE(std::string(method));
    const auto study = twin.folder.write(
        "fit.toml", std::string(testing::kFit) + "[optimiser]\nmethod = \"" + method + "\"\n");
    const std::filesystem::path out = twin.folder.path() / "out" / method;
    const ProcessResult run = run_catena({"identify", study, "--output", out});
    CHECK_MESSAGE(run.exit_status == 0, run.output);
    for (const char* word : {"identified", "fit", "validate", "RMS before", "RMS after", "mm"})
      CHECK(run.output.find(word) != std::string::npos);
    const Case fitted = read_case(out / "fitted.toml");
    CHECK(fitted.parameters[0].value == doctest::Approx(0.1).epsilon(1e-3));
    CHECK(fitted.parameters[1].value == doctest::Approx(0.005).epsilon(1e-3));
    const ProcessResult again =
        run_catena({"simulate", out / "fitted.toml", "--output", out / "again"});
    CHECK_MESSAGE(again.exit_status == 0, again.output);
    // the fitted case simulates to what the fit saw, digit by digit
    CHECK(testing::text_of(out / "again" / "residuals.csv") ==
          testing::text_of(out / "residuals.csv"));
    CHECK(testing::text_of(out / "residuals.csv").find(",validate,") != std::string::npos);
    const std::string before = testing::text_of(out / "result.json");
    CHECK(run_catena({"identify", study, "--output", out, "-q"}).output.empty());
    CHECK(testing::text_of(out / "result.json") == before);
  }
}

TEST_CASE("an interrupted fit leaves the best so far and exits with 130") {
  const Twin twin;
  // a long fit: many links, many starts
  std::string slow = testing::replaced(testing::kFit, "links = 2", "links = 60");
  slow += "[optimiser]\nmethod = \"nelder_mead\"\nstarts = 1000\nmax_evaluations = 1000000\n"
          "[simulation]\nrelative_tolerance = 1e-11\n";
  const auto study = twin.folder.write("fit.toml", slow);
  const std::filesystem::path out = twin.folder.path() / "out";
  const std::string program = std::string(CATENA_BINARY_DIR) + "/bin/catena";
  const pid_t child = fork();
  if (child == 0) {
    execl(program.c_str(), "catena", "identify", study.c_str(), "--output", out.c_str(), "-q", nullptr);
    _exit(127);
  }
  usleep(1'500'000);
  kill(child, SIGINT);
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  CHECK(testing::text_of(out / "result.json").find("\"status\": \"interrupted\"") != std::string::npos);
  CHECK(read_case(out / "fitted.toml").parameters.size() == 2);

  const ProcessResult limited =
      run_catena({"identify", study, "--output", out / "limited", "--time-limit", "1.5", "-q"});
  CHECK(limited.exit_status == 0);
  CHECK(testing::text_of(out / "limited" / "result.json").find("\"status\": \"time_limit\"") !=
        std::string::npos);
}
