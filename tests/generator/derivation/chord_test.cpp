// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tie between two places of the chain against its virtual work on the two points, in 50-digit arithmetic, at
// seeded random states.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "generator/certificate/exact_evaluation.hpp"
#include "generator/derivation/chain.hpp"
#include "generator/derivation/structure.hpp"
#include "tests/generator/derivation/seeded_vectors.hpp"
#include "tests/support/data.hpp"

using namespace catena;
using GiNaC::ex;
using GiNaC::numeric;

namespace chord_test {
namespace {

constexpr int kLinks = 4;
// A place goes from one link to the next over 1e-9 m; at the ends of the chain it is off by half of that.
constexpr double kTolerance = 1e-8;

using testing::dot, testing::draw, testing::kAxes, testing::name, testing::Vector;

double number(const ex& e) { return GiNaC::ex_to<numeric>(e.evalf()).to_double(); }

// A chain of links of 0.5 m, and how the ends of its links move.
struct Motion {
  std::map<std::string, ex> inputs;
  std::vector<Vector> direction, rate;  ///< of link i, from 1 on
};

Motion motion_in(Space space, const ex& from, const ex& to) {
  Motion motion;
  motion.inputs = {{"tie_upper_place", from}, {"tie_lower_place", to}};
  motion.direction.resize(1), motion.rate.resize(1);
  for (int i = 1; i <= kLinks; ++i) {
    motion.inputs[name("length", i)] = numeric(1, 2);
    Vector e, rate;
    if (space == Space::kPlane) {
      const ex theta = draw(name("theta", i)), turning = draw(name("theta_dot", i));
      e = {GiNaC::sin(theta).evalf(), GiNaC::cos(theta).evalf(), 0};
      rate = {(turning * e[1]).evalf(), (-turning * e[0]).evalf(), 0};
    } else {
      const testing::LinkDirection drawn = testing::drawn_direction(i);
      e = drawn.along, rate = drawn.rate;
      for (std::size_t a = 0; a < 3; ++a) {
        const std::string family = "direction_" + std::string(kAxes[a]);
        motion.inputs[name(family, i)] = e[a];
        motion.inputs[name(family + "_dot", i)] = rate[a];
      }
    }
    motion.direction.push_back(e), motion.rate.push_back(rate);
  }
  return motion;
}

// How much of link i lies above the place.
ex above(const ex& place, int i) {
  const ex beyond = place - numeric(i - 1, 2);
  return number(beyond) < 0 ? ex(0) : number(beyond) > 0.5 ? ex(numeric(1, 2)) : beyond;
}

Description tied(Space space, bool with_tie) {
  Description description = plain_chain();
  description.space = space;
  if (with_tie)
    description.effects.push_back(read_effect(tests::source_folder() / "tests/runtime/tie.toml"));
  return description;
}

// Each generalised force is what the force on the two points does along the motion of the links.
void compare_with_virtual_work(Space space, const ex& from, const ex& to) {
  const Motion motion = motion_in(space, from, to);
  Chain chain(tied(space, true), kLinks), plain(tied(space, false), kLinks);
  const auto inputs = [&](const std::string& input) {
    const auto known = motion.inputs.find(input);
    return known != motion.inputs.end() ? known->second : draw(input);
  };
  ExactEvaluation with_tie(chain.definitions(), inputs), without(plain.definitions(), inputs);
  Vector apart = {0, 0, 0}, parting = {0, 0, 0};
  std::vector<ex> between(1);
  for (int i = 1; i <= kLinks; ++i) {
    const auto at = static_cast<std::size_t>(i);
    between.push_back(above(to, i) - above(from, i));
    for (std::size_t a = 0; a < 3; ++a) {
      apart[a] += between[at] * motion.direction[at][a];
      parting[a] += between[at] * motion.rate[at][a];
    }
  }
  const ex distance = GiNaC::sqrt(dot(apart, apart)).evalf(),
           rate = (dot(apart, parting) / distance).evalf();
  const ex drawn = draw("tie_spring") * (distance - draw("tie_rest_length")) +
                   draw("tie_dashpot") * rate + draw("tie_pull");
  for (int i = 1; i <= kLinks; ++i) {
    CAPTURE(i);
    const auto at = static_cast<std::size_t>(i);
    const std::size_t components = space == Space::kPlane ? 1 : 3;
    for (std::size_t a = 0; a < components; ++a) {
      // How the link moves along its coordinate: in space a unit vector, without what is along the link.
      Vector moves = {motion.direction[at][1], -motion.direction[at][0], 0};
      if (space != Space::kPlane)
        for (std::size_t b = 0; b < 3; ++b)
          moves[b] = ex(a == b ? 1 : 0) - motion.direction[at][a] * motion.direction[at][b];
      const ex expected = drawn * between[at] * dot(moves, apart) / distance;
      const std::size_t row = a * kLinks + at - 1;
      const ex found = with_tie.of(chain.residual()[row]) - without.of(plain.residual()[row]);
      CHECK(std::abs(number(found - expected)) < kTolerance);
    }
    // The tie draws links together; what they bear of it is the opposite of its pull.
    const ex tension = with_tie.of(chain.tensions()[at - 1]) - without.of(plain.tensions()[at - 1]);
    CHECK(std::abs(number(tension + drawn * 2 * between[at] * dot(motion.direction[at], apart) /
                                        distance)) < kTolerance);
  }
  CHECK(std::abs(number(drawn)) > 0.1);
}

}  // namespace

TEST_CASE("a tie does the work of its force on the two places") {
  GiNaC::Digits = 50;
  for (const Space space : {Space::kPlane, Space::kThreeDimensional}) {
    CAPTURE(static_cast<int>(space));
    compare_with_virtual_work(space, numeric(3, 10), numeric(17, 10));
    compare_with_virtual_work(space, numeric(18, 10), numeric(7, 10));
    compare_with_virtual_work(space, numeric(13, 10), numeric(14, 10));  // within one link
    compare_with_virtual_work(space, -1, 3);  // beyond the ends: from end to end
  }
}

TEST_CASE(
    "a tie adds a column for each axis to the triangles of the Newton matrix, and none to M") {
  for (const Space space : {Space::kPlane, Space::kThreeDimensional}) {
    CAPTURE(static_cast<int>(space));
    const auto ranks = [&](bool with_tie, bool mass_alone) {
      Chain chain(tied(space, with_tie), kLinks);
      Definitions& names = chain.definitions();
      Weights weights{1, 0, 0};
      if (!mass_alone) weights = {names.input("ca"), names.input("cv"), names.input("cq")};
      const Quasiseparable found = find_structure(chain, weights, "matrix_");
      REQUIRE_MESSAGE(found.found, found.reason);
      return std::array{found.upper_rank, found.lower_rank};
    };
    CHECK(ranks(true, true) == ranks(false, true));
    const int axes = space == Space::kPlane ? 2 : 3;
    for (std::size_t k = 0; k < 2; ++k)
      CHECK(ranks(true, false)[k] == ranks(false, false)[k] + axes);
  }
}

}  // namespace chord_test
