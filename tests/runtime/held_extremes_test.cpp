// SPDX-License-Identifier: BSD-3-Clause
//
// Extreme but legal cables in space that are twisted, held, lie on a floor, or carry a body: a motion as it is at tight
// tolerances, with its energy kept, or a status that says what to change; never wrong with success.
#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "common/impossible_value.hpp"
#include "runtime/held_end.hpp"
#include "tests/runtime/space_cable.hpp"

namespace {

using catena::Model;
using catena::State;
using catena::Status;
using Eigen::Index;
using Eigen::VectorXd;
using testing::askew;
using testing::set;

constexpr int kMostSteps = 5'000;  // so that what is too stiff is said soon

using Values = std::vector<std::pair<const char*, double>>;

struct Row {
  std::string what;
  std::string words;  ///< of the message where it is not simulated; empty: it must be
  Values values;  ///< of parameters, beside those of the usual cable; "length" scales all lengths
  double duration = 0.3;
  double relative_tolerance = 1e-8;
};

VectorXd parameters_of(const Model& model, const Values& usual, const Values& values) {
  VectorXd p = testing::cable(model, 0.3, 5e-3);
  const Index n = model.links();
  for (const Values* all : {&usual, &values})
    for (const auto& [name, value] : *all) {
      const std::string family = name;
      if (family == "stiffness")
        p.segment(3 * n, n).setConstant(value);
      else if (family == "damping")
        p.segment(4 * n, n).setConstant(value);
      else if (family == "length") {
        p.segment(0, n) *= value;
        p.segment(n, n) *= value;
        p.segment(2 * n, n) *= value * value * value;
      } else
        set(model, p, name, value);
    }
  return p;
}

/// The energies' greatest change, J.
double energy_moved(const catena::Simulation& run) {
  const Eigen::MatrixXd& energy = run.trajectory.energy;
  return (energy.rowwise().maxCoeff() - energy.rowwise().minCoeff()).maxCoeff();
}

void check_rows(const char* file, const Values& usual, const std::vector<Row>& rows) {
  const Model model = Model::load(file);
  for (const Row& row : rows) {
    INFO(row.what);
    const VectorXd p = parameters_of(model, usual, row.values);
    std::string said;
    catena::Simulation found;
    const std::vector<double> times = {0, row.duration / 2, row.duration};
    catena::SimulationOptions options;
    options.relative_tolerance = row.relative_tolerance;
    options.max_steps = kMostSteps;
    State start;
    try {
      start = model.held() ? closed_end(model, p, askew(model), 0, {}) : askew(model);
      found = simulate(model, p, start, times, options);
      said = found.message;
    } catch (const catena::ImpossibleValue& refused) {
      said = refused.what();
      found.status = Status::kSingular;
    }
    INFO(said);
    CHECK(said.find("nan") == std::string::npos);
    if (found.status != Status::kSuccess) {
      CHECK(!row.words.empty());
      CHECK(said.find(row.words) != std::string::npos);
      continue;
    }
    CHECK(row.words.empty());
    CHECK(found.trajectory.q.allFinite());
    CHECK(found.energy_imbalance <= 1e-4 * energy_moved(found));
    const catena::Simulation right = simulate(model, p, start, times, testing::tight());
    INFO(right.message);
    CHECK(right.status == Status::kSuccess);
    if (right.status != Status::kSuccess) continue;
    CHECK((found.trajectory.q - right.trajectory.q).cwiseAbs().maxCoeff() < 1e-5);
  }
}

}  // namespace

TEST_CASE("extreme twisted cables between two clamps") {
  check_rows(TWISTED_8,
             {{"twists.to_side", 0.5},
              {"twists.to_down", 0.4},
              {"twists.turn", 0.8},
              {"twists.end_turn", 2.0},
              {"twists.torsion", 0.4},
              {"twists.roll", 1.5},
              {"twists.roll_rate", 3.0},
              {"twists.amplitude", 0.1}},
             {
                 {"as it is", "", {}},
                 {"GJ 1e-12", "", {{"twists.torsion", 1e-12}}},
                 {"GJ 1e6, 50 us", "", {{"twists.torsion", 1e6}}, 5e-5},
                 {"GJ 1e6", "less stiff", {{"twists.torsion", 1e6}}},
                 {"GJ 1e40", "less stiff", {{"twists.torsion", 1e40}}},
                 {"roll 1000", "shorter time", {{"twists.roll", 1000.0}}},
                 {"roll rate 1e6", "", {{"twists.roll_rate", 1e6}}, 1e-3},
                 {"clamp of no stiffness", "", {{"twists.firmness", 0.0}}},
                 {"clamp 1e6", "", {{"twists.firmness", 1e6}}, 1e-4},
                 {"stiffness 1e-12", "", {{"stiffness", 1e-12}}},
                 {"stiffness 0", "", {{"stiffness", 0.0}}},
                 {"stiffness 1e6", "less stiff", {{"stiffness", 1e6}}},
                 {"stiffness 1e6, 50 us", "", {{"stiffness", 1e6}}, 5e-5},
                 {"damping 0", "", {{"damping", 0.0}}},
                 {"damping 1e4, 10 ms", "", {{"damping", 1e4}}, 0.01},
                 {"load 1e6, 1 ms", "", {{"load_mass", 1e6}}, 1e-3},
                 {"links of 1 mm",
                  "",
                  {{"length", 1e-3 / 0.15},
                   {"twists.to_side", 3.33e-3},
                   {"twists.to_down", 2.66e-3},
                   {"twists.amplitude", 1e-3}},
                  1e-3},
                 {"ends at one place", "", {{"twists.to_side", 0.0}, {"twists.to_down", 0.0}}},
                 {"nearly taut",
                  "",
                  {{"twists.to_side", 1.2 * 0.8},
                   {"twists.to_down", 1.2 * 0.5999},
                   {"twists.amplitude", 0.0}}},
                 {"too far", "longer than its ends are apart", {{"twists.to_side", 2.0}}},
                 {"clamp turned back", "", {{"twists.end_turn", 3.0 + 0.14159265358979}}},
                 {"tolerance 1e-12", "", {}, 0.3, 1e-12},
                 {"a clamp that turns 1e6 times a second",
                  "shorter time",
                  {{"twists.turn_across", 0.5}, {"twists.frequency", 1e6}},
                  1e-4},
             });
}

TEST_CASE("extreme cables held in between") {
  check_rows(
      HELD_JOINT_9,
      {{"holds_joint.to_side", 0.3}, {"holds_joint.to_down", 0.4}, {"holds_joint.amplitude", 0.05}},
      {
          {"as it is", "", {}},
          {"stiffness 1e-12", "", {{"stiffness", 1e-12}}},
          {"stiffness 1e6, 50 us", "", {{"stiffness", 1e6}}, 5e-5},
          {"stiffness 1e6", "less stiff", {{"stiffness", 1e6}}},
          {"damping 0", "", {{"damping", 0.0}}},
          {"damping 1e3", "", {{"damping", 1e3}}},
          {"load 0", "", {{"load_mass", 0.0}}},
          {"load 1e6", "shorter time", {{"load_mass", 1e6}}},
          {"nearly taut",
           "",
           {{"holds_joint.to_side", 0.8 * 0.6},
            {"holds_joint.to_down", 0.79999 * 0.8},
            {"holds_joint.amplitude", 0.0}}},
          {"pulled beyond",
           "farther than it is long",
           {{"holds_joint.to_side", 0.8 * 0.6},
            {"holds_joint.to_down", 0.79 * 0.8},
            {"holds_joint.amplitude", 0.5}}},
          {"at the support", "", {{"holds_joint.to_side", 0.0}, {"holds_joint.to_down", 0.0}}},
          {"links of 1 mm",
           "",
           {{"length", 9e-3 / 1.2},
            {"holds_joint.to_side", 2e-3},
            {"holds_joint.to_down", 3e-3},
            {"holds_joint.amplitude", 5e-4}},
           0.01},
          {"1 kHz", "", {{"holds_joint.frequency", 1e3}, {"holds_joint.amplitude", 1e-5}}, 0.02},
          {"tolerance 1e-12", "", {}, 0.3, 1e-12},
      });
}

TEST_CASE("extreme bodies at the end") {
  check_rows(BODY_5,
             {{"load_body.drag_lateral", 1.0},
              {"load_body.centre_vertical", 0.05},
              {"load_body.centre_longitudinal", 0.02},
              {"load_body.drag_longitudinal", 1.0}},
             {
                 {"as it is", "", {}},
                 {"inertia 1e-9",
                  "",
                  {{"load_body.inertia_roll", 1e-9},
                   {"load_body.inertia_yaw", 1e-9},
                   {"load_body.inertia_pitch", 1e-9}}},
                 {"inertia 1e9",
                  "",
                  {{"load_body.inertia_roll", 1e9},
                   {"load_body.inertia_yaw", 1e9},
                   {"load_body.inertia_pitch", 1e9}}},
                 {"drag 1e9", "", {{"load_body.drag_lateral", 1e9}}},
                 {"added mass 1e9", "look at masses", {{"load_body.added_lateral", 1e9}}},
                 {"displaces 1e9 kg, 1 us", "", {{"load_body.displaced", 1e9}}, 1e-6},
                 {"centre 100 m off", "", {{"load_body.centre_vertical", 100.0}}},
                 {"current 100 m/s, 50 ms", "", {{"load_body.current_side", 100.0}}, 0.05},
                 {"damping 1e9", "", {{"load_body.turning_damping", 1e9}}},
                 {"pressure 100 m", "", {{"load_body.pressure", -100.0}}},
                 {"stiffness 1e6", "less stiff", {{"stiffness", 1e6}}},
                 {"no load", "", {{"load_mass", 0.0}}},
             });
}

TEST_CASE("extreme floors") {
  check_rows(OVER_FLOOR_5,
             {{"sea_floor.bed", 0.9},
              {"sea_floor.firmness", 1e3},
              {"sea_floor.friction", 0.5},
              {"sea_floor.resistance", 10.0},
              {"sea_floor.load_firmness", 1e3}},
             {
                 {"as it is", "", {}},
                 {"firmness 1e9, 20 ms",
                  "",
                  {{"sea_floor.firmness", 1e9}, {"sea_floor.load_firmness", 1e9}},
                  0.02},
                 {"firmness 1e9, rounding 1e-6, 20 ms",
                  "",
                  {{"sea_floor.firmness", 1e9},
                   {"sea_floor.load_firmness", 1e9},
                   {"sea_floor.rounding", 1e-4}},
                  0.02},
                 {"rounding 1e-4", "", {{"sea_floor.rounding", 1e-4}}},
                 {"friction 10", "", {{"sea_floor.friction", 10.0}}},
                 {"resistance 1e9", "", {{"sea_floor.resistance", 1e9}}},
                 {"the floor over the support", "", {{"sea_floor.bed", -20000.0}}, 1e-4},
                 {"20 km down", "", {{"sea_floor.bed", 20000.0}}},
                 {"rounding 10 m", "", {{"sea_floor.rounding", 10.0}}, 0.01},
             });
}

TEST_CASE("a twisted cable at rest is found, or the message says what to change") {
  const Model model = Model::load(TWISTED_8);
  for (const double roll : {0.0, 1.5})
    for (const double torsion : {0.0, 1e-12, 0.4, 1e6}) {
      CAPTURE(roll);
      CAPTURE(torsion);
      const VectorXd p = parameters_of(model,
                                       {{"twists.to_side", 0.5},
                                        {"twists.to_down", 0.4},
                                        {"twists.turn", 0.8},
                                        {"twists.end_turn", 2.0}},
                                       {{"twists.roll", roll}, {"twists.torsion", torsion}});
      const catena::Equilibrium found = hanging_equilibrium(model, p);
      INFO(found.message);
      if (roll != 0 && torsion > 1e-3) {  // it buckles into loops
        CHECK(found.status == Status::kNoConvergence);
        CHECK(found.message.find("begin with angles instead") != std::string::npos);
        continue;
      }
      REQUIRE(found.status == Status::kSuccess);
      VectorXd a(model.coordinates());
      REQUIRE(model.acceleration({0, found.state.q.data(), found.state.v.data(), a.data(),
                                  found.state.z.data(), nullptr, p.data()},
                                 a.data()) == 0);
      CHECK(a.head(3 * model.links()).cwiseAbs().maxCoeff() < 1e-6);  // 1/s^2
    }
}
