// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/fit_remarks.hpp"

#include <doctest/doctest.h>

#include "identify/problem/evaluation.hpp"
#include "tests/identify/recordings.hpp"

using namespace catena;

namespace {

constexpr double kNoise = 1e-3;  // m

/// Two recordings of 2 s, the first cut into windows of 0.5 s that start at rest like the whole, with
/// twenty times the stiffness that was filmed.
Problem wrongly_stiff() {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "first");
  the_case.experiments[0].noise = kNoise;
  const Recording seen = testing::with_truth(
      the_case, Model::built_in(2), testing::empty_markers({0.5, 1.0}, 80, 0.025), kNoise, 3);
  the_case.experiments.push_back(the_case.experiments[0]);
  the_case.experiments[0].window = 0.5;
  the_case.experiments[1].name = "second";
  for (ParameterSpec& parameter : the_case.parameters)
    if (parameter.sets == "stiffness") parameter.value *= 20;
  return Problem(the_case, Model::built_in(2), {seen, seen});
}

}  // namespace

TEST_CASE("what a fit leaves above the noise is said once for a recording, with its range") {
  const Problem problem = wrongly_stiff();
  REQUIRE(problem.experiments().size() > 3);
  const Evaluation evaluation = evaluate(problem, problem.start(), true, false);
  REQUIRE(evaluation.ok);
  const std::vector<FitRemark> remarks = remarks_on_fit(problem, evaluation);
  REQUIRE(remarks.size() == 2);
  CHECK(remarks[0].recording == "first");
  CHECK(remarks[0].experiment == 0);
  CHECK(remarks[0].words.find(" to ") != std::string::npos);
  CHECK(remarks[0].words.find("times the noise (1 mm) in 4 of 4 fitted windows.") !=
        std::string::npos);
  CHECK(remarks[1].recording == "second");
  CHECK(problem.experiments()[remarks[1].experiment].spec.name == "second");
  CHECK(remarks[1].words.find("windows") == std::string::npos);
}
