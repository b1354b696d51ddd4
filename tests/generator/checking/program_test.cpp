// SPDX-License-Identifier: GPL-3.0-or-later
//
// catena-derive check, tried from outside.
#include <doctest/doctest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/support/data.hpp"

namespace {

struct Outcome {
  int status;
  std::string text;  ///< standard output and error
};

Outcome run(const std::string& arguments) {
  const std::string command =
      catena::tests::build_folder().string() + "/bin/catena-derive check " + arguments + " 2>&1";
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  Outcome outcome{0, ""};
  std::array<char, 4096> buffer{};
  for (std::size_t count; (count = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    outcome.text.append(buffer.data(), count);
  const int status = pclose(pipe);
  outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return outcome;
}

std::string example(const std::string& name) {
  return catena::tests::source_folder() / "examples" / "derivations" / name;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("exit status 0 when all is equal, 1 when something is different or undecided") {
  CHECK(run(example("chapter_3_two_links.txt")).status == 0);
  CHECK(run(example("stiffness_4_11_as_printed.txt")).status == 1);
  CHECK(run(example("undecided_gudermann.txt")).status == 1);
}

TEST_CASE("the report names entry, line, difference, origin and a state") {
  const Outcome outcome = run(example("stiffness_4_11_as_printed.txt"));
  for (const std::string part :
       {"K[1,2]  different  (line 16, overwriting line 6, 14)", "yours - the chain's = k_2",
        "from: spring of joint 2: missing", "yours 0, the chain's -",
        "K comes out diagonal; the chain's is tridiagonal",
        "16 checked: 10 equal (proved), 6 different, 0 undecided"}) {
    INFO(outcome.text);
    CHECK(contains(outcome.text, part));
  }
}

TEST_CASE("the number of links and the states can be chosen") {
  CHECK(contains(run("--links 7 " + example("gravity_4_23.txt")).text, "7 checked: 7 equal"));
  const std::string file = example("lagrangian_2_9.txt");
  CHECK(run("--seed 5 " + file).text == run("--seed 5 " + file).text);
  CHECK(run("--seed 5 " + file).text != run("--seed 6 " + file).text);
}

TEST_CASE("effects are named on the command line, and in the answer") {
  const Outcome outcome = run(example("air_drag.txt") + " --effect air_drag_linear");
  CHECK(outcome.status == 0);
  CHECK(contains(outcome.text, "air_drag.txt: 3 links, with air_drag_linear"));
  CHECK(run(example("air_drag.txt")).status == 2);
}

TEST_CASE("the answer is the same byte for byte each time") {
  for (const std::string file : {"lagrangian_2_9.txt", "catenary_2_50_2_53.txt"}) {
    const std::string first = run(example(file)).text;
    for (int i = 0; i < 5; ++i) CHECK(run(example(file)).text == first);
  }
}

TEST_CASE("wrong use and wrong input end with status 2 and say what to do") {
  const std::string path =
      (std::filesystem::temp_directory_path() / "catena_wrong_derivation.txt").string();
  std::ofstream(path) << "links 2\nM[1,1] = l_1 l_1\n";
  const Outcome wrong = run(path);
  CHECK(wrong.status == 2);
  CHECK(contains(wrong.text, path + ":2:14: error: expected an operator"));
  std::filesystem::remove(path);
  const Outcome absent = run("/nowhere/derivation.txt");
  CHECK(absent.status == 2);
  CHECK(contains(absent.text, "/nowhere/derivation.txt: error: cannot be read"));
  CHECK(run("").status == 2);
  CHECK(run("--links two " + example("gravity_4_23.txt")).status == 2);
  CHECK(run("--links 0 " + example("gravity_4_23.txt")).status == 2);
  CHECK(contains(run("--effect air_drg_linear " + example("air_drag.txt")).text,
                 "did you mean \"air_drag_linear\"?"));
  CHECK(run("--help").status == 0);
}
