// SPDX-License-Identifier: GPL-3.0-or-later
//
// The steady tension that an effect asks for is the tension of a chain without angular accelerations, which the
// generator finds from the cut forces of the whole equations: in 50-digit arithmetic.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "generator/certificate/exact_evaluation.hpp"
#include "generator/derivation/chain.hpp"
#include "tests/generator/derivation/seeded_vectors.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
using GiNaC::ex;
using GiNaC::numeric;

namespace steady_tension_test {
namespace {

constexpr int kLinks = 3;
// Evaluation in 50 digits loses a few to cancellation; a wrong term would be of order one.
constexpr double kTolerance = 1e-40;

using testing::dot, testing::draw, testing::kAxes, testing::name, testing::Vector;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double size(const ex& e) { return std::abs(GiNaC::ex_to<numeric>(e.evalf()).to_double()); }

const char* const kEffect =
    "format = 1\nkind = \"effect\"\nid = \"own\"\ntitle = \"Own\"\ndescription = \"One\"\n"
    "[parameters.c]\nunit = \"1/N\"\nneutral = 0.0\ndescription = \"c\"\n"
    "[parameters.k]\nunit = \"N m/rad\"\nneutral = 0.0\ndescription = \"k\"\n"
    "[[state]]\nname = \"turned\"\nunit = \"rad\"\nper = \"joint\"\n"
    "rate = \"c*steady_tension*joint_rate\"\n"
    "[[torque]]\nat = \"joint\"\nvalue = \"-k*turned\"\n";

/// What the state of joint i turns by, at rates of turning that are constant, and the tension of link i there.
struct Found {
  std::vector<Vector> rate;
  std::vector<ex> tension;
};
Found found_in(Space space, const std::map<std::string, ex>& set) {
  const testing::TemporaryFolder folder;
  Description description = plain_chain();
  description.space = space;
  for (const char* id : {"support_motion", "centre_offset", "gravity_tilt", "load_mass"})
    description.effects.push_back(built_in_effect(id));
  description.effects.push_back(read_effect(folder.write("own.toml", kEffect)));
  Chain chain(description, kLinks);
  ExactEvaluation evaluation(chain.definitions(), [&](const std::string& input) {
    const auto known = set.find(input);
    return known != set.end() ? known->second : draw(input);
  });
  Found found;
  const std::size_t components = space == Space::kPlane ? 1 : 3;
  for (std::size_t i = 0; i < kLinks; ++i) {
    Vector rate = {0, 0, 0};
    for (std::size_t a = 0; a < components; ++a)
      rate[a] = evaluation.of(chain.state_rates()[a * kLinks + i]);
    found.rate.push_back(rate);
    found.tension.push_back(evaluation.of(chain.tensions()[i]));
  }
  return found;
}

}  // namespace

TEST_CASE("in the plane the steady tension is the tension without angular accelerations") {
  GiNaC::Digits = 50;
  std::map<std::string, ex> set;
  for (int i = 1; i <= kLinks; ++i) set[name("theta_ddot", i)] = 0;
  const Found found = found_in(Space::kPlane, set);
  ex above = 0;
  for (int i = 1; i <= kLinks; ++i) {
    CAPTURE(i);
    const auto at = static_cast<std::size_t>(i) - 1;
    const ex rate = draw(name("theta_dot", i));
    CHECK(size(found.tension[at]) > 0.1);
    CHECK(size(found.rate[at][0] - draw("own_c") * found.tension[at] * (rate - above)) <
          kTolerance);
    above = rate;
  }
}

TEST_CASE("in space the steady tension is the tension without angular accelerations") {
  GiNaC::Digits = 50;
  std::map<std::string, ex> set;
  std::vector<Vector> turning = {{0, 0, 0}};
  for (int i = 1; i <= kLinks; ++i) {
    const auto [e, rate] = testing::drawn_direction(i);
    for (std::size_t a = 0; a < 3; ++a) {
      const std::string family = "direction_" + std::string(kAxes[a]);
      set[name(family, i)] = e[a];
      set[name(family + "_dot", i)] = rate[a];
      set[name(family + "_ddot", i)] = (-dot(rate, rate) * e[a]).evalf();
    }
    turning.push_back(cross(e, rate));
  }
  const Found found = found_in(Space::kThreeDimensional, set);
  for (std::size_t i = 1; i <= kLinks; ++i) {
    CAPTURE(i);
    CHECK(size(found.tension[i - 1]) > 0.1);
    for (std::size_t a = 0; a < 3; ++a)
      CHECK(size(found.rate[i - 1][a] - draw("own_c") * found.tension[i - 1] *
                                            (turning[i][a] - turning[i - 1][a])) < kTolerance);
  }
}

}  // namespace steady_tension_test
