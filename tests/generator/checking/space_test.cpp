// SPDX-License-Identifier: GPL-3.0-or-later
//
// Derivations in space by two angles a link: against the chain that models are emitted from, which has unit vectors
// and no angles, in 50 digits.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "description/description.hpp"
#include "generator/certificate/exact_evaluation.hpp"
#include "generator/checking/numeric_state.hpp"
#include "generator/derivation/chain.hpp"
#include "tests/generator/checking/checked.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/text.hpp"

using namespace catena;
using namespace catena::tests;
using catena::testing::replaced;
using GiNaC::ex;

namespace {

constexpr int kDigits = 50;
// Evaluation in 50 digits loses a few to cancellation; a wrong term would be of order one.
constexpr double kTolerance = 1e-40;

/// Azimuth about the vertical: as the start of a case has it. Singular where a link is plumb.
const char* const kAboutVertical = R"(links 3 in space
q_i = [sin(theta_i)*cos(phi_i), cos(theta_i), sin(theta_i)*sin(phi_i)] for i = 1..n
for i = 1..n
  for j = 1..n
    A[i,j] = l_i*l_j*(m_c + m[max(i,j)]/2 + sum(k = max(i,j)+1..n, m_k)) - (if i == j then l_i^2*m_i/4 - I_i else 0)
    M[i,j] = A[i,j]*(cos(theta_i)*cos(theta_j)*cos(phi_i - phi_j) + sin(theta_i)*sin(theta_j))
    M[i,n+j] = A[i,j]*cos(theta_i)*sin(theta_j)*sin(phi_i - phi_j)
    M[n+i,n+j] = A[i,j]*sin(theta_i)*sin(theta_j)*cos(phi_i - phi_j)
  end
end
symmetric M
L = sum(i = 1..n, g*l_i*(m_c + m_i/2 + sum(k = i+1..n, m_k))*q[i,2]
    - k_i/2*acos(sum(a = 1..3, q[i,a]*q[i-1,a]))^2
    + sum(j = 1..n, A[i,j]/2*sum(a = 1..3, ddt(q[i,a])*ddt(q[j,a]))))
)";

/// The equations of `text` at a random state, and those of the emitted chain along the same angles.
double largest_difference(const std::string& text, std::uint64_t seed) {
  const Checked hand = checked(text);
  const checking::ChainSymbols& symbols = *hand.derivation.chain;
  std::vector<ex> all{symbols.load_mass, symbols.gravity};
  for (const auto* family : {&symbols.angle, &symbols.rate, &symbols.acceleration, &symbols.length,
                             &symbols.mass, &symbols.inertia, &symbols.stiffness, &symbols.damping})
    all.insert(all.end(), family->begin() + 1, family->end());
  NumericState state = random_state(symbols_in(all), seed);
  for (std::size_t i = 1; i < symbols.torque.size(); ++i) state.values[symbols.torque[i]] = 0;
  const auto value = [&](const ex& expression) -> ex {
    return evaluate_at(expression, state).value();
  };

  const auto component = [](std::size_t axis, const std::string& dots, const std::string& index) {
    return "direction_" + std::string(std::array{"side", "down", "across"}[axis]) + dots + index;
  };
  std::map<std::string, ex> inputs{{"load_mass", value(symbols.load_mass)},
                                   {"gravity", value(symbols.gravity)}};
  for (int i = 1; i <= symbols.links; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const std::string index = "[" + std::to_string(i) + "]";
    for (const auto& [name, family] :
         {std::pair{"length", &symbols.length}, std::pair{"mass", &symbols.mass},
          std::pair{"inertia", &symbols.inertia}, std::pair{"stiffness", &symbols.stiffness},
          std::pair{"damping", &symbols.damping}})
      inputs[name + index] = value((*family)[at]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const ex& q = symbols.direction[at][axis];
      const ex rate = symbols.time_derivative(q);
      inputs[component(axis, "", index)] = value(q);
      inputs[component(axis, "_dot", index)] = value(rate);
      inputs[component(axis, "_ddot", index)] = value(symbols.time_derivative(rate));
    }
  }
  Description description = plain_chain();
  description.space = Space::kThreeDimensional;
  Chain chain(description, symbols.links);
  ExactEvaluation evaluation(chain.definitions(),
                             [&](const std::string& name) { return inputs.at(name); });

  double largest = 0;
  int equations = 0;
  for (const Entry& entry : hand.derivation.entries) {
    if (entry.quantity != Quantity::kEquation) continue;
    ++equations;
    const ex& angle = symbols.angle[static_cast<std::size_t>(entry.row)];
    const int link = (entry.row - 1) % symbols.links + 1;
    ex along = 0;
    for (int axis = 0; axis < 3; ++axis)
      along +=
          value(derivative(
              symbols.direction[static_cast<std::size_t>(link)][static_cast<std::size_t>(axis)],
              angle)) *
          evaluation.of(
              chain.residual()[static_cast<std::size_t>(axis * symbols.links + link - 1)]);
    const ex difference = (value(entry.value - entry.right) - along).evalf();
    largest = std::max(largest, std::abs(GiNaC::ex_to<GiNaC::numeric>(difference).to_double()));
  }
  CHECK(equations == 2 * symbols.links);
  return largest;
}

}  // namespace

TEST_CASE("elevation and azimuth give the equations of the emitted chain in space") {
  GiNaC::Digits = kDigits;
  const std::string text = example("elevation_azimuth_4_1.txt");
  for (const std::uint64_t seed : {1U, 2U, 3U}) CHECK(largest_difference(text, seed) < kTolerance);
  CHECK(largest_difference(replaced(text, "2*thetadot_j*phidot_j*sin(phi_j)*cos(",
                                    "thetadot_j*phidot_j*sin(phi_j)*cos("),
                           1) > 0.01);
}

TEST_CASE("the block form holds for other numbers of links") {
  const std::string text = example("elevation_azimuth_4_1.txt");
  for (const int links : {1, 2, 5}) {
    const Checked result = checked(text, links);
    CHECK(result.count(Verdict::kEqual) == 12 * links * links + 6 * links + 2);
    CHECK(result.count(Verdict::kEqual) == static_cast<int>(result.findings.size()));
    CHECK(independent_equations(result.findings, 2 * links) == 2 * links);
  }
}

TEST_CASE("a mistake in a block is different, and its origin is named") {
  const std::string text = example("elevation_azimuth_4_1.txt");
  const Checked sign = checked(replaced(text, "M[i,n+j] = A", "M[i,n+j] = -A"));
  CHECK(sign.of("M[1,5]").verdict == Verdict::kDifferent);
  CHECK(sign.of("M[1,2]").verdict == Verdict::kEqual);
  const Checked damper =
      checked(replaced(text, "-thetadot_i*cos(phi_i)^2", "-thetadot_i*cos(phi_i)"));
  CHECK(damper.of("D").verdict == Verdict::kDifferent);
  const Checked load = checked(replaced(text, "G[i] = g*l_i*(m_c + m_i/2", "G[i] = g*l_i*(m_i/2"));
  CHECK(load.of("G[2]").origins == std::vector<std::string>{"gravity of the load: missing"});
  CHECK(load.of("G[5]").verdict == Verdict::kEqual);
}

TEST_CASE("what the angles mean is the derivation's choice") {
  const Checked result = checked(kAboutVertical);
  CHECK(result.count(Verdict::kEqual) == 37);
  CHECK(result.findings.size() == 37);
  CHECK(checked(replaced(kAboutVertical, "q[i,2]", "q[i,1]")).of("L").verdict ==
        Verdict::kDifferent);
}

TEST_CASE("directions that cannot be meant are refused") {
  const std::string rest = "G_1 = 0\n";
  const auto refusal = [&](const std::string& direction) {
    return failure([&] { checked("links 1 in space\n" + direction + rest); });
  };
  CHECK(refusal("") ==
        "test: error: q_1 is not set; say what the angles mean by q_i = [side, down, across] for i "
        "= 1..n");
  CHECK(refusal("q_1 = [sin(theta_1), cos(theta_1), phi_1]\n") ==
        "test:2:7: error: q[1] is no unit vector: its square is not proved to be 1");
  CHECK(refusal("q_1 = [sin(theta_1), cos(theta_1)]\n") ==
        "test:2:7: error: the unit vector of a link is written [side, down, across]");
  CHECK(refusal("q_1 = [0, 1, 0]\nq_1 = [0, 1, 0]\n") == "test:3:1: error: q[1] is set twice");
  CHECK(refusal("q_1 = [0, thetadot_1, 1]\n") ==
        "test:2:11: error: the unit vector of a link contains a rate or an acceleration");
  CHECK(refusal("q_2 = [0, 1, 0]\n") ==
        "test:2:1: error: q[2]: the index 2 is not in 1..1 (there are 1 links)");
  CHECK(failure([] { checked("links 1 in plane\nG_1 = 0\n"); }) ==
        "test:1:12: error: expected 'space', as in 'links 3 in space', found 'plane'");
  CHECK(failure([] {
          checked("links 1 in space\n", std::nullopt, {built_in_effect("load_drag")});
        }) == "test:1:1: error: derivations with effects are compared in the plane only");
  const Checked slanted = checked(
      "links 1 in space\nq_1 = [cos(theta_1)*cos(phi_1), sin(theta_1)*cos(phi_1), "
      "sin(phi_1)]\nK[1,1] = k_1\n");
  CHECK(slanted.findings[0].verdict == Verdict::kDifferent);
  CHECK(slanted.findings[0].remark.find("the links do not point down") != std::string::npos);
}

TEST_CASE("phi is a name of one's own in the plane") {
  CHECK(checked("links 1\nphi = theta_1\nG_1 = g*l_1*(m_1/2 + m_c)*sin(phi)\n")
            .count(Verdict::kEqual) == 1);
}
