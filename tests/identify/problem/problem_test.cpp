// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include "common/impossible_value.hpp"
#include "identify/fit/error.hpp"
#include "tests/identify/differences.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/near.hpp"

using namespace catena;
using testing::sections;

namespace {

const char* const kThreeLinks = R"(
[model]
links = 3
[cable]
length = 1.2
density = 0.3
load_mass = 0.2
[[parameter]]
name = "EI"
sets = "bending_stiffness"
value = 0.02
free = true
lower = 0.001
upper = 1.0
[[parameter]]
name = "damping"
sets = "damping_length"
value = 0.004
free = true
lower = 0.0001
upper = 1.0
[[parameter]]
name = "length"
sets = "cable.length"
value = 1.2
free = true
lower = 1.0
upper = 1.5
[[parameter]]
name = "mass"
sets = "load_mass"
value = 0.2
free = true
lower = 0.0
upper = 1.0
)";

/// Holds the sensitivities against central differences. The simulations are good to about 1e-8, so
/// differences over h = 1e-5 are good to about 1e-3 of what they measure.
void check_jacobian(const Problem& problem) {
  const Eigen::VectorXd x = problem.start();
  const Residuals at = residuals_of(problem, evaluate(problem, x, true, true), Part::kFit);
  const auto residuals = [&](const Eigen::VectorXd& at_x) {
    return residuals_of(problem, evaluate(problem, at_x, true, false), Part::kFit).value;
  };
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double h = 1e-4 * std::max(0.1, std::abs(x[j]));
    const double error = (testing::central_difference(residuals, x, j, h) - at.jacobian.col(j))
                             .cwiseAbs()
                             .maxCoeff() /
                         at.jacobian.col(j).cwiseAbs().maxCoeff();
    CAPTURE(problem.unknowns()[static_cast<std::size_t>(j)].name);
    CHECK(error < 2e-3);
  }
}

}  // namespace

TEST_CASE("sensitivities of markers agree with differences, whatever is unknown") {
  const char* const starts[] = {
      "[initial]\nshape = \"smooth\"\nterms = 2\ncoefficients = [0.4, 0.3]\nfree = true\n"
      "[initial.velocity]\nshape = \"straight\"\nrates = [0.5]\nfree = true\n",
      "[initial]\nshape = \"angles\"\nangles = [0.1, 0.4, 0.2]\nfree = true\n"
      "[initial.velocity]\nshape = \"angles\"\nrates = [0.5, 0.0, 1.0]\nfree = true\n",
      "[initial]\nshape = \"catenary\"\nheld = {side = 0.5, down = 0.8}\n",
      "[initial]\nshape = \"hanging\"\n[initial.velocity]\nshape = \"smooth\"\nterms = 1\nrates = "
      "[1.0]\n",
  };
  const Model model = Model::built_in(3);
  for (const char* start : starts) {
    CAPTURE(std::string(start));
    Case the_case = sections(std::string(kThreeLinks) + start);
    testing::add_experiment(the_case, "run");
    // a marker in the middle of a link, one near a joint, one at the end of the shortest cable
    // tried
    const Problem problem(the_case, model, {testing::empty_markers({0.2, 0.85, 1.19}, 20, 0.05)});
    check_jacobian(problem);
  }
}

TEST_CASE("angles are compared as they are, the hidden parameters come back from perfect data") {
  Case the_case =
      sections(std::string(kThreeLinks) + "[initial]\nshape = \"straight\"\nangle = 0.5\n");
  the_case.parameters.resize(2);
  testing::add_experiment(the_case, "run", DataKind::kAngles);
  Recording recording;
  recording.points.resize(1);
  recording.points[0].link = 2;
  recording.channels = {{0, Component::kAngle, "angle"}};
  for (int k = 0; k < 30; ++k) recording.time.push_back(0.05 * k);
  recording.measured.setZero(1, 30);
  recording.fit_frames = 30;
  const Model model = Model::built_in(3);
  recording = testing::with_truth(the_case, model, recording);
  CHECK(recording.measured(0, 0) == doctest::Approx(0.5));
  const Problem problem(the_case, model, {recording});
  CHECK(error_of(problem, evaluate(problem, problem.start(), true, false), Part::kFit) == 0);
  check_jacobian(problem);
}

TEST_CASE("experiments share the physics and have starts of their own") {
  Case the_case =
      sections(std::string(kThreeLinks) + "[initial]\nshape = \"straight\"\nfree = true\n");
  the_case.parameters.resize(2);
  testing::add_experiment(the_case, "first");
  testing::add_experiment(the_case, "second");
  testing::add_experiment(the_case, "unseen");
  the_case.experiments[2].use = Use::kValidate;
  const Model model = Model::built_in(3);
  std::vector<Recording> recordings;
  for (const double angle : {0.3, 0.6, 0.9}) {
    Case truth = the_case;
    truth.experiments.resize(1);
    truth.initial.coefficients = {angle};
    recordings.push_back(
        testing::with_truth(truth, model, testing::empty_markers({0.6, 1.2}, 20, 0.05)));
  }
  recordings[2].fit_frames = 0;
  const Problem problem(the_case, model, recordings);
  std::vector<std::string> names;
  for (const Unknown& unknown : problem.unknowns()) names.push_back(unknown.name);
  CHECK(names == std::vector<std::string>{"EI", "damping", "first: angle 1", "second: angle 1"});
  // the starts were found from the first frames, that of the unseen one too
  CHECK(problem.unknowns()[2].start == catena::near(0.3, 1e-3));
  CHECK(problem.unknowns()[3].start == catena::near(0.6, 1e-3));
  const Evaluation evaluation = evaluate(problem, problem.start(), true, true);
  CHECK(evaluation.ok);
  CHECK(error_of(problem, evaluation, Part::kFit) < 1e-3);
  CHECK(error_of(problem, evaluation, Part::kValidation) < 1e-3);
  const Residuals residuals = residuals_of(problem, evaluation, Part::kFit);
  for (std::size_t i = 0; i < residuals.index.size(); ++i)  // a start moves its own experiment only
    CHECK((residuals.jacobian(static_cast<Eigen::Index>(i), 2) == 0) ==
          (residuals.index[i].experiment != 0));
}

TEST_CASE("a window is an experiment with a start of its own; those after fit_until validate") {
  Case the_case = sections(std::string(kThreeLinks) +
                           "[initial]\nshape = \"angles\"\nfree = true\n"
                           "[initial.velocity]\nshape = \"angles\"\nfree = true\n");
  testing::add_experiment(the_case, "run");
  Case truth = the_case;
  truth.initial.coefficients = {0.5, 0.4, 0.3};
  truth.initial.velocity_coefficients = {0, 0, 0};
  the_case.experiments[0].window = 0.5;
  Recording recording = testing::empty_markers({0.4, 0.8, 1.2}, 61, 0.025);
  recording = testing::with_truth(truth, Model::built_in(3), recording);
  recording.fit_frames = 40;  // until 0.975 s
  const Problem problem(the_case, Model::built_in(3), {recording});
  REQUIRE(problem.experiments().size() == 3);
  CHECK(problem.experiments()[0].fitted());
  CHECK(problem.experiments()[1].fitted());
  CHECK(!problem.experiments()[2].fitted());
  CHECK(problem.experiments()[1].spec.name == "run from 0.5 s");
  CHECK(problem.unknowns().size() == 4 + 2 * 6);
  // starts found from seven frames are near enough for the whole window to be near
  const Evaluation evaluation = evaluate(problem, problem.start(), true, false);
  CHECK(error_of(problem, evaluation, Part::kFit) < 0.03);
}

TEST_CASE("a simulation that fails is infinitely bad, and says why") {
  Case the_case = sections(std::string(kThreeLinks) +
                           "[initial]\nshape = \"straight\"\nangle = 1.0\n"
                           "[simulation]\nmax_steps = 20\n");
  testing::add_experiment(the_case, "run");
  const Problem problem(the_case, Model::built_in(3), {testing::empty_markers({1.0}, 50, 0.05)});
  const Evaluation evaluation = evaluate(problem, problem.start(), true, true);
  CHECK(!evaluation.ok);
  CHECK(evaluation.message.starts_with("run: "));
  CHECK(evaluation.message.find("t = ") != std::string::npos);
  CHECK(error_of(problem, evaluation, Part::kFit) == std::numeric_limits<double>::infinity());
  CHECK(evaluation.predictions[0].simulated.array().isNaN().all());
}

TEST_CASE("the case with what was found gives the same error") {
  Case the_case = sections(std::string(kThreeLinks) +
                           "[initial]\nshape = \"smooth\"\nterms = 2\nfree = true\n");
  testing::add_experiment(the_case, "run");
  Case truth = the_case;
  truth.initial.coefficients = {0.4, 0.2};
  const Model model = Model::built_in(3);
  const Recording recording =
      testing::with_truth(truth, model, testing::empty_markers({0.4, 0.8, 1.2}, 30, 0.05));
  const Problem problem(the_case, model, {recording});
  Eigen::VectorXd x = problem.start();
  x *= 1.01;
  const Problem again(problem.with(x), model, {recording});
  CHECK((again.start() - x).cwiseAbs().maxCoeff() == 0);
  CHECK(error_of(again, evaluate(again, again.start(), true, false), Part::kFit) ==
        error_of(problem, evaluate(problem, x, true, false), Part::kFit));
}

TEST_CASE("values of single experiments outlast a fit, and tell the same of every experiment") {
  Case the_case =
      sections(std::string(kThreeLinks) + "[initial]\nshape = \"straight\"\nangle = 0.5\n");
  the_case.parameters[3].per_experiment = true;
  for (const char* name : {"first", "second", "unseen"}) testing::add_experiment(the_case, name);
  the_case.experiments[2].use = Use::kValidate;
  const Model model = Model::built_in(3);
  const std::vector<Recording> recordings(3, testing::empty_markers({0.6, 1.0}, 10, 0.05));
  const Problem problem(the_case, model, recordings);
  REQUIRE(problem.unknowns().size() == 5);
  Eigen::VectorXd x = problem.start();
  x[3] = 0.3;
  x[4] = 0.4;
  const Case found = problem.with(x);
  CHECK(found.parameters[3].value == 0.2);
  CHECK(found.parameters[3].value_in("first") == 0.3);
  CHECK(found.parameters[3].value_in("second") == 0.4);
  const Problem again(found, model, recordings);
  CHECK(again.start() == x);
  for (int e = -1; e < 3; ++e)
    CHECK(again.model_parameters(again.start(), e) == problem.model_parameters(x, e));
}

TEST_CASE("values that describe no cable fail as a simulation does; mistakes are thrown") {
  Case the_case = sections(std::string(kThreeLinks) +
                           "[initial]\nshape = \"catenary\"\nheld = {side = 0.5, down = 0.8}\n");
  testing::add_experiment(the_case, "run");
  const Problem problem(the_case, Model::built_in(3), {testing::empty_markers({1.19}, 5, 0.05)});
  for (const auto& [unknown, value] : {std::pair(2, 0.9), {2, 1.15}, {3, -1.0}}) {
    Eigen::VectorXd x = problem.start();  // too short for the held point, for the marker; a mass
    x[unknown] = value;
    for (const bool jacobian : {false, true}) {
      const Evaluation evaluation = evaluate(problem, x, true, jacobian);
      CHECK(!evaluation.ok);
      CHECK(evaluation.predictions[0].status == Status::kNotFinite);
      CHECK(evaluation.predictions[0].simulated.array().isNaN().all());
    }
  }
  SensitivityDirection wrong;
  wrong.q = Eigen::VectorXd::Ones(7);
  CHECK_THROWS_AS(problem.predict(problem.start(), 0, true, {wrong}), std::invalid_argument);
}

TEST_CASE("windows too short for data are refused; none is cut forever") {
  const auto windows = [](double window, double step) {
    Case the_case =
        sections(std::string(kThreeLinks) + "[initial]\nshape = \"straight\"\nfree = true\n");
    testing::add_experiment(the_case, "run");
    the_case.experiments[0].window = window;
    the_case.experiments[0].where = "case.toml:40";
    const Problem problem(the_case, Model::built_in(3), {testing::empty_markers({1.0}, 41, step)});
    return problem.experiments().size();
  };
  CHECK(failure([&] { windows(1e-10, 0.05); }) ==
        "case.toml:40: window: 1e-10 s; a window needs at least 8 frames, which take 0.4 s here; "
        "give a longer one");
  CHECK(failure([&] { windows(0.3, 0.05); }).find("window: 0.3 s") != std::string::npos);
  CHECK(windows(0.5, 0.05) == 4);
  CHECK(windows(1e-9, 1e-10) == 0);  // frames nearer than the edge of a window is sharp
}
