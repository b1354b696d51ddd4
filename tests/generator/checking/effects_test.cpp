// SPDX-License-Identifier: GPL-3.0-or-later
//
// Derivations of chains with effects.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/generator/checking/checked.hpp"
#include "tests/support/failure.hpp"

using namespace catena;
using namespace catena::checking;
using namespace catena::tests;

namespace {

/// Energies of n links, with `more` in Rayleigh's function and `torque` on theta_i, and the equations.
std::string derivation(const std::string& more, const std::string& torque = "T_i") {
  return "links 2\n"
         "for i = 1..n\n"
         "  x_i = sum(j = 1..i-1, l_j*sin(theta_j)) + l_i/2*sin(theta_i)\n"
         "  y_i = sum(j = 1..i-1, l_j*cos(theta_j)) + l_i/2*cos(theta_i)\n"
         "end\n"
         "x_c = sum(j = 1..n, l_j*sin(theta_j)); y_c = sum(j = 1..n, l_j*cos(theta_j))\n"
         "T = sum(i = 1..n, m_i/2*(ddt(x_i)^2 + ddt(y_i)^2) + I_i/2*thetadot_i^2)\n"
         "    + m_c/2*(ddt(x_c)^2 + ddt(y_c)^2)\n"
         "V = sum(i = 1..n, k_i/2*(theta_i - theta[i-1])^2 - g*m_i*y_i) - g*m_c*y_c\n"
         "D = sum(i = 1..n, c_i/2*(thetadot_i - thetadot[i-1])^2) " +
         more +
         "\nL = T - V\n"
         "equation i: ddt(diff(L, thetadot_i)) - diff(L, theta_i) + diff(D, thetadot_i) = " +
         torque + " for i = 1..n\n";
}

constexpr const char* kLoadDrag =
    "+ load_drag_coefficient/3*(ddt(x_c)^2 + ddt(y_c)^2 + 1e-12)^(3/2)";

Effect brake() {
  Effect effect = built_in_effect("pivot_damping");
  effect.id = "brake";
  effect.parameters[0].name = "b";
  effect.parameters[0].scope = catena::Scope::kJoint;
  effect.scalars[0].at = Place::kJoint;
  effect.scalars[0].value.text = "b*joint_rate^2/2";
  return effect;
}

}  // namespace

TEST_CASE("drag of the load, with its root, is proved") {
  const Checked result =
      checked(derivation(kLoadDrag), std::nullopt, {built_in_effect("load_drag")});
  CHECK(result.count(Verdict::kEqual) == 6);
}

TEST_CASE("a brake with a parameter for each joint, any number of links") {
  const std::string right =
      derivation("+ sum(i = 1..n, brake_b_i/2*(thetadot_i - thetadot[i-1])^2)");
  for (const int links : {1, 3, 6})
    CHECK(checked(right, links, {brake()}).count(Verdict::kEqual) == 4 + links);
  const std::string wrong = derivation("+ sum(i = 1..n, brake_b_i/2*thetadot_i^2)");
  const Checked result = checked(wrong, 3, {brake()});
  CHECK(result.of("T").verdict == Verdict::kEqual);
  CHECK(result.of("equation 3").verdict == Verdict::kDifferent);
  CHECK(result.of("equation 3").difference == "thetadot_2*brake_b_3");
}

TEST_CASE("what is wrong with an effect is named") {
  const Effect drag = built_in_effect("air_drag_linear");
  const Checked result = checked(derivation(""), std::nullopt, {drag});
  CHECK(result.of("L").verdict == Verdict::kEqual);
  CHECK(result.of("D").verdict == Verdict::kDifferent);
  CHECK(result.of("equation 1").origins ==
        std::vector<std::string>{"the effect air_drag_linear: missing"});
}

TEST_CASE("an added mass is part of M") {
  const Effect added = built_in_effect("added_mass");
  const std::string moved =
      "links 1\nM[1,1] = I_1 + m_1*l_1^2/4 + m_c*l_1^2 + l_1^2*added_mass_load "
      "+ l_1^3/4*added_mass_normal\n";
  const Checked result = checked(moved, std::nullopt, {added});
  INFO(result.findings[0].difference);
  CHECK(result.count(Verdict::kEqual) == 1);
  CHECK(checked("links 1\nM[1,1] = I_1 + m_1*l_1^2/4 + m_c*l_1^2\n", std::nullopt, {added})
            .count(Verdict::kDifferent) == 1);
}

TEST_CASE("forces without a potential belong to the equations alone") {
  const Effect wind = built_in_effect("steady_wind");
  const Checked result = checked(derivation(""), std::nullopt, {wind});
  CHECK(result.of("L").verdict == Verdict::kEqual);
  CHECK(result.of("D").verdict == Verdict::kEqual);
  CHECK(result.of("equation 1").verdict == Verdict::kDifferent);
}

TEST_CASE("what cannot be checked with effects is refused") {
  const auto said = [](const std::string& text, const std::vector<Effect>& effects) {
    return failure([&] { checked(text, std::nullopt, effects); });
  };
  const Effect drag = built_in_effect("load_drag");
  CHECK(said("links 2\nC[1,1] = c_1 + c_2\n", {drag}).find("C is not defined for a chain with") !=
        std::string::npos);
  CHECK(said("links 2\nload_drag_coefficient = 2\n", {drag}).find("cannot be assigned") !=
        std::string::npos);
  CHECK(said("links 2\nD = load_drag_coefficient_2\n", {drag}).find("has no index") !=
        std::string::npos);
  CHECK(said("links 2\nD = brake_b*thetadot_1^2\n", {brake()}).find("needs an index") !=
        std::string::npos);
  CHECK(said("links 2\nD = brake_b_3*thetadot_1^2\n", {brake()}).find("not in 1..2") !=
        std::string::npos);
  CHECK(said("links 2\nD = load_drag_coefficient\n", {}).find("(--effect)") != std::string::npos);
  for (const char* id : {"joint_hysteresis", "axial_stretch", "support_motion"})
    CHECK(said(derivation(""), {built_in_effect(id)}).find("symbol") != std::string::npos);
}
