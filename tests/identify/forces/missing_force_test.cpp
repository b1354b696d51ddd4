// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/missing_force.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "identify/forces/force_sizes.hpp"
#include "identify/forces/forces_everywhere.hpp"
#include "tests/identify/forces/hidden_force.hpp"

using namespace catena;

namespace {

testing::Film short_film() {
  testing::Film film;
  film.links = film.case_links = 6;
  film.camera.duration = 2;
  film.camera.markers = 6;
  return film;
}

MissingForce force_in(const testing::Filmed& filmed) {
  const FittedModel baseline = filmed.baseline();
  REQUIRE(baseline.ok);
  return missing_force(*baseline.problem, baseline.x, {filmed.film.camera.noise});
}

}  // namespace

TEST_CASE("the smoother's covariances between times are those of all numbers at once") {
  constexpr Eigen::Index kNodes = 4;
  constexpr double kVariance = 2, kStart = 0.5, kByState = 0.9, kByForce = 0.5, kByRate = 0.1;
  constexpr double kSeen = 3;
  const auto number = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  LinearRecording recording;
  recording.start_offset = recording.own_mean = Eigen::VectorXd::Zero(1);
  recording.start_by_parameter = number(1);
  recording.own_deviation = number(kStart);
  const LinearRecording::Step step{.by_state = number(kByState),
                                   .by_force = Eigen::RowVector2d(kByForce, kByRate),
                                   .by_parameter = number(0),
                                   .offset = number(0),
                                   .duration = 0.05};
  recording.steps.assign(kNodes - 1, step);
  recording.seen.assign(
      kNodes, {.value = number(0.3), .by_state = number(kSeen), .by_parameter = number(0)});
  const ForcePrior prior;
  const Smoothed smoothed = smooth_forces({Eigen::VectorXd(), Eigen::VectorXd(), {recording}},
                                          {{0, 0}}, {kVariance}, prior, true, kNodes - 1);
  // All numbers: the start, then w and its rate at each node; what is seen of them.
  const Eigen::Matrix2d a = prior.transition(step.duration);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(1 + 2 * kNodes, 1 + 2 * kNodes);
  covariance(0, 0) = kStart * kStart;
  for (Eigen::Index i = 0; i < kNodes; ++i) {
    Eigen::Matrix2d between = kVariance * Eigen::Matrix2d::Identity();
    for (Eigen::Index j = i; j < kNodes; ++j, between = a * between) {
      covariance.block<2, 2>(1 + 2 * j, 1 + 2 * i) = between;
      covariance.block<2, 2>(1 + 2 * i, 1 + 2 * j) = between.transpose();
    }
  }
  Eigen::MatrixXd seen(kNodes, 1 + 2 * kNodes);
  Eigen::RowVectorXd state = Eigen::RowVectorXd::Unit(1 + 2 * kNodes, 0);
  for (Eigen::Index i = 0; i < kNodes; ++i) {
    seen.row(i) = kSeen * state;
    state *= kByState;
    state.segment<2>(1 + 2 * i) += Eigen::RowVector2d(kByForce, kByRate * prior.rate());
  }
  const Eigen::MatrixXd both = seen * covariance;
  const Eigen::MatrixXd of_seen =
      both * seen.transpose() + Eigen::MatrixXd::Identity(kNodes, kNodes);
  const Eigen::MatrixXd after = covariance - both.transpose() * inverse(of_seen) * both;
  for (Eigen::Index i = 0; i < kNodes; ++i)
    for (Eigen::Index j = i; j < kNodes; ++j) {
      const auto& at = smoothed.recordings[0].covariance[static_cast<std::size_t>(i)];
      CAPTURE(i);
      CAPTURE(j);
      CHECK(at.at(static_cast<std::size_t>(j - i))(0, 0) ==
            doctest::Approx(after(1 + 2 * i, 1 + 2 * j)).epsilon(1e-9).scale(0));
    }
}

TEST_CASE("a hidden spring to a wall is found: its place, its force over time, its interval") {
  truth::Hidden hidden;
  hidden.wall_spring = 1;  // N/m
  const testing::Filmed filmed = testing::film(short_film(), hidden);
  const FittedModel baseline = filmed.baseline();
  REQUIRE(baseline.ok);
  const MissingForce found =
      missing_force(*baseline.problem, baseline.x, {filmed.film.camera.noise});
  REQUIRE(found.found);
  CHECK(found.share > 0.9);
  REQUIRE(found.one_place);
  REQUIRE(found.best.has_value());
  const double length = filmed.film.cable().length;
  CHECK(std::abs(found.best->arc_length - testing::true_place(filmed.film)) < 0.02 * length);
  const testing::Recovery recovery = testing::recovery_at_place(filmed, hidden, found);
  CHECK(recovery.error < 0.05);
  CHECK(recovery.covered > 0.9);
  // Without knowing that it acts at one place, from what forces along the whole cable do.
  const testing::Recovery modes = testing::recovery_of_modes(filmed, hidden, found);
  CHECK(modes.error < 0.2);
  CHECK(modes.covered > 0.9);
  // Of 27 patterns only those that are shown are left: the others would widen every interval.
  CHECK(found.patterns.size() == 27);
  CHECK(found.everywhere.at(0).size.rows() < 5);
  CHECK(found.everywhere.at(0).rows.size() ==
        static_cast<std::size_t>(found.everywhere.at(0).size.rows()));
  // The spring does not push down. A down force would follow the noise, and the side force with it.
  CHECK(found.at_best.at(0).rows == std::vector<std::string>{"side"});
  // The fit without the force has made EI three times as large.
  CHECK(found.parameters.at(0).name == "EI");
  CHECK(found.parameters.at(0).value == doctest::Approx(0.014).epsilon(0.1).scale(0));
  REQUIRE(found.words.size() >= 2);
  CHECK(found.words[0].starts_with("a side force at arc length 1."));
}

TEST_CASE("a force along the whole cable: its two lowest modes, with intervals that hold it") {
  double covered = 0;
  constexpr int kFilms = 6;
  for (int seed = 1; seed <= kFilms; ++seed) {
    CAPTURE(seed);
    testing::Film film = short_film();
    film.camera.seed = static_cast<unsigned>(seed);
    testing::Filmed filmed = testing::film(film, {});
    testing::push(filmed, {.size = 0.1, .seed = static_cast<unsigned>(seed), .spread = true});
    const MissingForce found = force_in(filmed);
    REQUIRE(found.found);
    CHECK_FALSE(found.one_place);
    const testing::Recovery modes = testing::recovery_of_modes(filmed, {}, found);
    CHECK(modes.error < 0.2);
    covered += modes.covered / kFilms;
    // Those of the force at one instant, which hold what the prior allows, are four times as wide.
    const MissingForce::OverTime& shown = found.everywhere.at(0).normal_modes.at(0);
    CHECK(shown.deviation.row(0).norm() < 0.1 * filmed.gust_modes.row(0).norm());
  }
  CHECK(covered > 0.9);
}

TEST_CASE("a force of no known form is expected to be no stronger than the weight") {
  testing::Film film = short_film();
  film.camera.duration = 1;
  truth::Hidden hidden;
  hidden.wall_spring = 30;  // N/m
  const testing::Filmed filmed = testing::film(film, hidden);
  const truth::Cable cable = film.cable();
  const double weight = (cable.density * cable.length + cable.load_mass) * cable.gravity;
  const MissingForce found = force_in(filmed);
  REQUIRE(found.found);
  double largest = 0;
  for (const MissingForce::Pattern& pattern : found.patterns)
    if (pattern.unit == "N/m") largest = std::max(largest, pattern.prior_deviation);
  CHECK(largest == doctest::Approx(weight / cable.length));
  CHECK(found.best->arc_length == doctest::Approx(testing::true_place(film)).epsilon(0.05));

  const FittedModel baseline = filmed.baseline();
  ChainMeasures chain(*baseline.problem, baseline.x, 0);
  std::vector<ForcePattern> patterns = forces_everywhere(chain);
  const auto deviation_of = [&](const std::string& name) {
    const std::vector<double> variances = largest_variances(patterns, chain);
    for (std::size_t m = 0; m < patterns.size(); ++m)
      if (patterns[m].name == name) return std::sqrt(variances[m]);
    return 0.0;
  };
  CHECK(deviation_of("side force at arc length 2.58 m") == doctest::Approx(weight));
  CHECK(deviation_of("torque at the support") == doctest::Approx(weight * cable.length));
  patterns = moment_patterns(5, chain);
  const double link = cable.length / film.links;
  CHECK(deviation_of(moment_name(5, chain.lengths)) ==
        doctest::Approx((cable.density * link + cable.load_mass) * cable.gravity * link));
  // What pushes does not depend on gravity.
  chain.gravity = 1e-3;
  CHECK(deviation_of(moment_name(5, chain.lengths)) ==
        doctest::Approx((cable.density * link + cable.load_mass) * 9.80665 * link));
}

TEST_CASE("no force is found where nothing is hidden") {
  const testing::Filmed filmed = testing::film(short_film(), {});
  const FittedModel baseline = filmed.baseline();
  REQUIRE(baseline.ok);
  const MissingForce found =
      missing_force(*baseline.problem, baseline.x, {filmed.film.camera.noise});
  REQUIRE(found.everywhere.size() == 1);  // the motion was followed
  CHECK_FALSE(found.found);
  CHECK(found.share < 0.01);
  CHECK(found.places.empty());
}

TEST_CASE("two recordings with values that are missing have one force each") {
  truth::Hidden hidden;
  hidden.wall_spring = 1;
  testing::Filmed filmed = testing::film(short_film(), hidden);
  const testing::Filmed other = [&] {
    testing::Film film = short_film();
    film.camera.seed = 2;
    film.camera.lost = 0.2;
    return testing::film(film, hidden);
  }();
  testing::add_experiment(filmed.the_case, "second run");
  const auto problem =
      std::make_shared<const Problem>(filmed.the_case, any_links_model(filmed.film.case_links),
                                      std::vector<Recording>{filmed.recording, other.recording});
  const FittedModel baseline = fit_model(problem, problem->start(), {}, fit_least_squares, nullptr);
  REQUIRE(baseline.ok);
  const double noise = filmed.film.camera.noise;
  const MissingForce found = missing_force(*problem, baseline.x, {noise, noise});
  REQUIRE(found.found);
  REQUIRE(found.everywhere.size() == 2);
  CHECK(found.everywhere[1].experiment == "second run");
  REQUIRE(found.at_best.size() == 2);
  // The same force was filmed twice.
  const Eigen::RowVectorXd apart = found.at_best[0].size.row(0) - found.at_best[1].size.row(0);
  CHECK(apart.norm() < 0.15 * found.at_best[0].size.row(0).norm());
}

namespace {

void check_constant(const CandidateLaw::Constant& constant, double truth, const char* unit) {
  CAPTURE(constant.name);
  CAPTURE(constant.value);
  CHECK(constant.unit == unit);
  CHECK(constant.deviation > 0);
  CHECK(constant.deviation < 0.02 * std::abs(truth));
  CHECK(std::abs(constant.value - truth) < 0.02 * std::abs(truth));
}

}  // namespace

TEST_CASE("a lens, a shutter that rolls, a drift and a slipping marker are no force") {
  struct Wrong {
    const char* name;
    double truth::Camera::*error;
    double size;
  };
  for (const Wrong& wrong :
       {Wrong{"the lens bends lines, or the camera looks at a slant", &truth::Camera::lens, 0.02},
        Wrong{"the picture is read line by line (rolling shutter)", &truth::Camera::shutter, 0.004},
        Wrong{"the camera drifts", &truth::Camera::drift, 0.02},
        Wrong{"marker 3 slips along the cable", &truth::Camera::slip, 0.02}}) {
    CAPTURE(wrong.name);
    testing::Film film = short_film();
    film.camera.*wrong.error = wrong.size;
    const MissingForce found = force_in(testing::film(film, {}));
    CHECK_FALSE(found.found);
    REQUIRE(found.sensor.has_value());
    CHECK(found.sensor->name == wrong.name);
    REQUIRE(found.words.size() == 1);
    CHECK(found.words[0].starts_with("no force on the chain: an error of the camera"));
  }
}

TEST_CASE("the law of a spring to a wall: stiffness and rest position") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.wall_spring = 0.3;  // N/m
  hidden.wall_side = 0.3;    // m
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  CHECK(found.law->found);
  CHECK(found.law->force == "side force");
  CHECK(found.law->variable == "side position");
  CHECK(found.law->confirmed == doctest::Approx(1).epsilon(0.02));
  CHECK(found.sensor->log_evidence < found.log_evidence);
  CHECK(std::abs(found.law->site.arc_length - testing::true_place(film)) <
        3 * found.law->place_deviation);
  REQUIRE(found.law->formula.constants.size() == 2);
  check_constant(found.law->formula.constants[0], 0.3, "N/m");
  check_constant(found.law->formula.constants[1], 0.3, "m");
  CHECK(std::any_of(found.words.begin(), found.words.end(), [](const std::string& words) {
    return words.starts_with("its law: side force = -linear x (side position - rest), linear = ");
  }));
}

TEST_CASE("the law of a tie between two places: its stiffness and both places") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.tie = 5;        // N/m
  hidden.tie_slack = 1;  // m
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  const ForceLaw& law = *found.law;
  CHECK(law.found);
  CHECK(law.force == "force that parts two places");
  CHECK(law.variable == "their distance");
  CHECK(law.site.kind == SiteKind::kPair);
  const double length = film.cable().length, last = length - 0.5 * length / film.links;
  CHECK(std::abs(law.site.arc_length - testing::true_place(film)) < 3 * law.place_deviation);
  CHECK(std::abs(law.site.other_arc_length - last) < 3 * law.other_place_deviation);
  CHECK(law.place_deviation < 0.01 * length);
  CHECK(law.other_place_deviation < 0.01 * length);
  REQUIRE(law.formula.constants.size() == 2);
  CHECK(law.formula.constants[0].value == doctest::Approx(5).epsilon(0.1));
  CHECK(law.formula.constants[1].value == doctest::Approx(1).epsilon(0.02));
}

TEST_CASE("the law of drag at a place: along the velocity, with the square of the speed") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.place_drag = 0.1;  // kg/m
  const testing::Filmed filmed = testing::film(film, hidden);
  const MissingForce found = force_in(filmed);
  REQUIRE(found.law.has_value());
  CHECK(found.law->found);
  CHECK(found.law->force == "force along the velocity");
  CHECK(found.law->variable == "speed");
  CHECK(std::abs(found.best->arc_length - testing::true_place(film)) <
        0.05 * filmed.film.cable().length);
  REQUIRE(found.law->formula.constants.size() == 1);
  CHECK(found.law->formula.constants[0].name == "quadratic");
  check_constant(found.law->formula.constants[0], 0.1, "N s^2/m^2");
}

TEST_CASE(
    "a string to a hook: the hook is found, and a one-sided spring to the side is told as its "
    "class") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.string = 0.5;  // N/m
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  std::vector<ForceLaw> all = found.law->rivals;
  all.push_back(*found.law);
  const auto string = std::find_if(all.begin(), all.end(), [](const ForceLaw& law) {
    return law.variable == "distance from it" && law.formula.constants.front().name == "spring";
  });
  REQUIRE(string != all.end());
  const auto check = [&](std::size_t i, const char* name, double truth) {
    const CandidateLaw::Constant& constant = string->formula.constants[i];
    CAPTURE(constant.value);
    CHECK(constant.name == name);
    CHECK(std::abs(constant.value - truth) < 3 * constant.deviation);
    CHECK(constant.deviation < 0.2);
  };
  check(0, "spring", hidden.string);
  check(1, "edge", hidden.string_slack);
  check(2, "point_side", hidden.string_side);
  check(3, "point_down", hidden.string_down);
}

TEST_CASE(
    "a magnet below the load: its fixed point is under the middle of the arc, not under an end of "
    "it") {
  testing::Film film = short_film();
  film.camera.duration = 3.5;
  film.camera.markers = 12;
  truth::Hidden hidden;
  hidden.magnet = 0.02;  // N m^2
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "distance from it");
  REQUIRE(found.law->formula.constants.size() == 3);
  CHECK(found.law->formula.constants[0].name == "pull");
  check_constant(found.law->formula.constants[0], hidden.magnet, "N m^2");
  CHECK(std::abs(found.law->formula.constants[1].value) < 0.01);
  CHECK(found.law->formula.constants[2].value ==
        doctest::Approx(film.cable().length + hidden.magnet_depth).epsilon(0.005));
}

TEST_CASE(
    "drag of the load is a force at one place, however many strengths forces everywhere have") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  film.camera.seed = 101;
  truth::Hidden hidden;
  hidden.load_drag = 0.02;  // kg/m
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.found);
  CHECK(found.one_place);
  CHECK(found.best->arc_length == doctest::Approx(film.cable().length));
}

TEST_CASE("a spring beside an end stop: no formula fits, the law is a curve") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  film.camera.seed = 3;
  truth::Hidden hidden;
  hidden.wall_spring = 0.3;  // N/m
  hidden.stop = 2;
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "side position");
  const CandidateLaw::Formula& formula = found.law->formula;
  REQUIRE(formula.curve);
  CHECK(formula.energy.find("knot_d") != std::string::npos);
  // The slope is that of the spring at first, and of both at last.
  double last = 0;
  for (const CandidateLaw::Constant& constant : formula.constants)
    if (constant.unit == "N/m") last += constant.value;
  REQUIRE(formula.constants.at(1).name == "linear");
  CHECK(last > 4 * formula.constants.at(1).value);
  CHECK(std::count(found.words.begin(), found.words.end(),
                   "no formula fits: it is a curve of straight pieces between knots") == 1);
}

namespace {

/// What a curve does against a velocity or rate, N or N m.
double curve_at(const CandidateLaw::Formula& formula, double x) {
  std::map<std::string, double> of;
  for (const CandidateLaw::Constant& constant : formula.constants)
    of[constant.name] = constant.value;
  for (const CandidateLaw::Constant& constant : formula.fixed) of[constant.name] = constant.value;
  const auto value = [&](const std::string& name) { return of.contains(name) ? of.at(name) : 0.0; };
  const double size = std::abs(x);
  double last_knot = 0, last = 0;
  for (char n = 'a'; of.contains(std::string("knot_") + n); ++n) {
    const double knot = of.at(std::string("knot_") + n);
    const double here = value(std::string("resistance_") + n) +
                        value(std::string(x > 0 ? "forward_" : "backward_") + n);
    if (size <= knot)
      return std::copysign(last + (here - last) * (size - last_knot) / (knot - last_knot), x);
    last_knot = knot, last = here;
  }
  return std::copysign(last, x);
}

/// Root mean square of the curve less the true one where the motion goes, over that of the true one.
template <class True>
double curve_error(const CandidateLaw::Formula& formula, const std::vector<double>& visited,
                   const True& true_law) {
  double error = 0, whole = 0;
  for (const double x : visited) {
    error += std::pow(curve_at(formula, x) - true_law(x), 2);
    whole += std::pow(true_law(x), 2);
  }
  return std::sqrt(error / whole);
}

testing::Film curve_film() {
  testing::Film film = short_film();
  film.camera.duration = 5;
  film.camera.markers = 12;
  return film;
}

/// The law of a film, which is a curve against this variable, and what was visited.
struct FoundCurve {
  CandidateLaw::Formula formula;
  std::vector<truth::OutsideForces> truth;
};
FoundCurve curve_found(const testing::Film& film, const truth::Hidden& hidden,
                       const std::string& variable) {
  const testing::Filmed filmed = testing::film(film, hidden);
  const MissingForce found = force_in(filmed);
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == variable);
  REQUIRE(found.law->formula.curve);
  CAPTURE(found.law->formula.text);
  return {found.law->formula,
          truth::outside_forces(film.cable(), hidden, film.start(), filmed.recording.time)};
}

}  // namespace

TEST_CASE("a damper with play in a joint: a curve against the rate, which leaves the play out") {
  truth::Hidden hidden;
  hidden.loose = 0.1;  // N m s/rad
  hidden.loose_rate = 0.7;
  testing::Film film = curve_film();
  const FoundCurve found = curve_found(film, hidden, "joint rate");
  std::vector<double> rates;
  for (const truth::OutsideForces& at : found.truth) rates.push_back(at.joint_rate);
  CHECK(curve_error(found.formula, rates, [](double w) {
          return 0.1 * (std::max(0.0, w - 0.7) - std::max(0.0, -w - 0.7));
        }) < 0.1);
}

TEST_CASE("a valve at a place resists one way: a curve that is not odd") {
  truth::Hidden hidden;
  hidden.valve = 0.1;  // N s/m
  const FoundCurve found = curve_found(curve_film(), hidden, "side velocity");
  std::vector<double> velocities;
  for (const truth::OutsideForces& at : found.truth) velocities.push_back(at.middle.velocity.side);
  CHECK(curve_error(found.formula, velocities, [](double v) { return 0.1 * std::max(0.0, v); }) <
        0.1);
  CHECK(curve_at(found.formula, -2) == 0);
}

TEST_CASE("a force that follows the velocity and drives it is no law") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.place_drag = -0.1;  // kg/m
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.one_place);
  CHECK(found.at_best.at(0).rows == std::vector<std::string>{"side", "down"});
  REQUIRE(found.law.has_value());
  CHECK_FALSE(found.law->found);
}

TEST_CASE("a mass at a place: it pulls down, and lags behind") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  film.camera.markers = 12;
  truth::Hidden hidden;
  hidden.insect = 0.02;  // kg
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "acceleration less gravity");
  CHECK(std::abs(found.law->site.arc_length - testing::true_place(film)) <
        3 * found.law->place_deviation);
  REQUIRE(found.law->formula.constants.size() == 1);
  check_constant(found.law->formula.constants[0], hidden.insect, "kg");
}

TEST_CASE("a spring before a dashpot in a joint: its stiffness and its lag") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.maxwell = 0.3;      // N m/rad
  hidden.maxwell_lag = 0.3;  // s
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "relaxing joint angle");
  CHECK(found.law->site.joint == 3);
  const auto& constants = found.law->formula.constants;
  REQUIRE(constants.size() == 2);
  const double truth[] = {hidden.maxwell, hidden.maxwell_lag};
  for (const std::size_t i : {0, 1}) {
    CAPTURE(constants[i].value);
    CAPTURE(constants[i].deviation);
    CHECK(std::abs(constants[i].value - truth[i]) < 3 * constants[i].deviation);
    CHECK(constants[i].deviation < 0.1 * truth[i]);
  }
}

TEST_CASE("a tension that pulls beside the middle of a joint: its lever") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  film.held_side = 1.4, film.held_down = 2.16;  // taut: a cable that snaps has no steady tension
  truth::Hidden hidden;
  hidden.eccentric_pull = 0.01;  // m
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "tension");
  CHECK(found.law->site.joint == 3);
  REQUIRE(found.law->formula.constants.size() == 1);
  check_constant(found.law->formula.constants[0], hidden.eccentric_pull, "m");
}

TEST_CASE("a viscous joint and an elastic one remember nothing") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  truth::Hidden viscous, elastic;
  viscous.brake = 0.1;  // N m s/rad
  viscous.brake_rate = 1e3;
  elastic.joint_stop = 0.2;  // N m/rad
  elastic.joint_gap = 0;
  for (const auto& [hidden, variable] :
       {std::pair{viscous, "joint rate"}, std::pair{elastic, "joint angle"}}) {
    const MissingForce found = force_in(testing::film(film, hidden));
    REQUIRE(found.law.has_value());
    REQUIRE(found.law->found);
    CHECK(found.law->variable == variable);
  }
}

/// The formulas of a push, that of the law and those of its rivals.
std::map<std::string, CandidateLaw::Formula> by_direction(const ForceLaw& law) {
  std::map<std::string, CandidateLaw::Formula> formulas = {{law.force, law.formula}};
  for (const ForceLaw& rival : law.rivals) formulas.emplace(rival.force, rival.formula);
  return formulas;
}

TEST_CASE("a kick is a pulse in time: when, and with how much of an impulse") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.kick = 0.05;  // N s
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "time");
  CHECK(found.law->by_points);
  // So short a push does in one direction nearly what it does in another: exact fits have to decide.
  const auto directions = by_direction(*found.law);
  CHECK(directions.size() == 2);
  REQUIRE(directions.contains("side force"));
  const auto& constants = directions.at("side force").constants;
  REQUIRE(constants.size() == 3);
  CHECK(constants[1].name == "duration");
  CHECK(constants[2].value == doctest::Approx(hidden.kick_time).epsilon(0.02));
  // The integral of a bell is sqrt(2 pi) amplitude width.
  const double impulse = std::sqrt(2 * std::numbers::pi) * constants[0].value * constants[1].value;
  CHECK(std::abs(impulse - hidden.kick) < 0.1 * hidden.kick);
}

TEST_CASE(
    "a push that is too short to see its direction has every direction as the law or a rival") {
  testing::Film film = short_film();
  film.camera.duration = 3;
  film.camera.seed = 4;  // the linear equations decide against the side force
  truth::Hidden hidden;
  hidden.kick = 0.05;  // N s
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(by_direction(*found.law).size() == 2);
}

TEST_CASE("a push that begins and stays: when, how fast, how strong") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.push = 0.2;  // N
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "time");
  CHECK(found.law->formula.text ==
        "side force = amplitude x (1 + tanh((time - moment)/duration))/2");
  const double truth[] = {hidden.push, 0.2, hidden.push_time};  // 0.2 s: truth/cable.cpp
  for (const std::size_t i : {0, 1, 2}) {
    const CandidateLaw::Constant& constant = found.law->formula.constants.at(i);
    CAPTURE(constant.name);
    CAPTURE(constant.value);
    CHECK(std::abs(constant.value - truth[i]) < 3 * constant.deviation);
    CHECK(constant.deviation < 0.1 * truth[i]);
  }
}

TEST_CASE("dry friction of the support: a sign alone, and its moment") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.pivot_friction = 0.045;  // N m
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->formula.text == "torque at the support = -friction x sign of rate of link 1");
  const CandidateLaw::Constant& friction = found.law->formula.constants.at(0);
  CAPTURE(friction.value);
  CHECK(std::abs(friction.value - hidden.pivot_friction) < 0.05 * hidden.pivot_friction);
}

TEST_CASE("friction that holds joints, with the tension and without") {
  testing::Film film = short_film();
  film.camera.duration = 5;
  film.camera.markers = 12;
  truth::Hidden pressed, plain;
  pressed.tension_friction = 0.003;  // m
  plain.joint_friction = 0.045;      // N m
  for (const auto& [hidden, force] : {std::pair(pressed, "bending moment over the tension"),
                                      std::pair(plain, "bending moment")}) {
    const MissingForce found = force_in(testing::film(film, hidden));
    REQUIRE(found.law.has_value());
    REQUIRE(found.law->found);
    CHECK(found.law->formula.text ==
          fmt::format("{} = -friction x sign of rate of curvature", force));
    CHECK(found.law->site.kind == SiteKind::kJoints);
    // As sharp as the truth, which rounds it over 0.008 rad/s.
    const auto& fixed = found.law->formula.fixed;
    const auto step =
        std::find_if(fixed.begin(), fixed.end(), [](const auto& of) { return of.name == "step"; });
    REQUIRE(step != fixed.end());
    CHECK(step->value * film.cable().length / film.links < 0.01);
    // Where the cable snaps, its tension is not the steady one: only the other friction has a size to compare.
    if (hidden.joint_friction == 0) continue;
    const CandidateLaw::Constant& friction = found.law->formula.constants.at(0);
    CAPTURE(friction.value);
    CHECK(std::abs(friction.value - hidden.joint_friction) < 0.1 * hidden.joint_friction);
  }
}

TEST_CASE(
    "play of a joint: a dead zone, not the curve that follows the noise of the motion found") {
  testing::Film film = short_film();
  film.camera.duration = 5;
  film.camera.markers = 12;
  film.camera.seed = 62074;
  truth::Hidden hidden;
  hidden.joint_stop = 1;  // N m/rad
  const MissingForce found = force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->formula.text == "moment = -spring x ((joint angle) beyond -gap to gap)");
  const auto& constants = found.law->formula.constants;
  REQUIRE(constants.size() == 2);
  const double truth[] = {hidden.joint_stop, hidden.joint_gap};
  for (const std::size_t i : {0, 1}) {
    CAPTURE(constants[i].name);
    CAPTURE(constants[i].value);
    CHECK(std::abs(constants[i].value - truth[i]) < 3 * constants[i].deviation);
    CHECK(constants[i].deviation < 0.05 * truth[i]);
  }
}

TEST_CASE("a force in time that follows no law has none") {
  testing::Film film = short_film();
  film.camera.duration = 4;
  testing::Filmed filmed = testing::film(film, {});
  testing::push(filmed, {0.05, 1});
  const MissingForce found = force_in(filmed);
  REQUIRE(found.found);
  REQUIRE(found.one_place);
  REQUIRE(found.law.has_value());
  CHECK_FALSE(found.law->found);
  CHECK(found.law->formula.text.empty());
  CHECK(found.law->chance > 0.01);
}
