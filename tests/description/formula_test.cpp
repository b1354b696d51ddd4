// SPDX-License-Identifier: BSD-3-Clause
#include "description/formula.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace catena;

namespace {

Formula torque(const std::string& text) {
  Effect effect;
  effect.coordinates = {{"strain", "1", ""}};
  effect.scalars = {{ScalarKind::kTorque, Place::kJoint, false, {text, "f.toml", 1, "torque"}}};
  return formulas(effect).at(0);
}

}  // namespace

TEST_CASE("LaTeX keeps the meaning: parentheses where they are needed and only there") {
  const std::pair<const char*, const char*> rows[] = {
      {"-a*joint_rate", "-\\mathrm{a} \\, \\dot{\\varphi}"},
      {"a - (b - c)", "\\mathrm{a} - \\left(\\mathrm{b} - \\mathrm{c}\\right)"},
      {"(a - b) - c", "\\mathrm{a} - \\mathrm{b} - \\mathrm{c}"},
      {"a + (b + c)", "\\mathrm{a} + \\mathrm{b} + \\mathrm{c}"},
      {"a - -b", "\\mathrm{a} - \\left(-\\mathrm{b}\\right)"},
      {"a*(b + c)", "\\mathrm{a} \\, \\left(\\mathrm{b} + \\mathrm{c}\\right)"},
      {"a*-b", "\\mathrm{a} \\, \\left(-\\mathrm{b}\\right)"},
      {"-(a + b)", "-\\left(\\mathrm{a} + \\mathrm{b}\\right)"},
      {"-a^2", "-\\mathrm{a}^{2}"},
      {"(-a)^2", "\\left(-\\mathrm{a}\\right)^{2}"},
      {"(a*b)^2", "\\left(\\mathrm{a} \\, \\mathrm{b}\\right)^{2}"},
      {"(a/b)^2", "\\left(\\frac{\\mathrm{a}}{\\mathrm{b}}\\right)^{2}"},
      {"(a^2)^3", "\\left(\\mathrm{a}^{2}\\right)^{3}"},
      {"a^(3/2)", "\\mathrm{a}^{\\frac{3}{2}}"},
      {"a/(b*c)", "\\frac{\\mathrm{a}}{\\mathrm{b} \\, \\mathrm{c}}"},
      {"2*3", "2 \\cdot 3"},
      {"2.5e-3*a", "2.5 \\cdot 10^{-3} \\, \\mathrm{a}"},
      {"sqrt(angle + 1)", "\\sqrt{\\theta + 1}"},
      {"sin(2*pi*time)", "\\sin\\left(2 \\, \\pi \\, t\\right)"},
      {"asinh(a)", "\\operatorname{asinh}\\left(\\mathrm{a}\\right)"},
      {"strain_rate*a_rate", "\\dot{\\mathrm{strain}} \\, \\mathrm{a\\_rate}"},
      {"velocity_normal", "v_{n}"},
  };
  for (const auto& row : rows) {
    CAPTURE(row.first);
    CHECK(torque(row.first).latex == "\\tau = " + std::string(row.second));
  }
}

TEST_CASE("a force along a velocity and a load that is displaced have formulas") {
  Effect effect;
  const auto written = [](const char* text) { return Expression{text, "f.toml", 1, "force"}; };
  ForceTerm force;
  force.at = Place::kChord;
  force.value = written("-pull");
  force.along = written("distance_rate");
  effect.forces = {force};
  effect.kinematics.load_down = written("reach");
  const std::vector<Formula> all = formulas(effect);
  REQUIRE(all.size() == 3);
  CHECK(all[0].what == "Force, along the chord, along a velocity");
  CHECK(all[0].latex == "F_{v} = -\\mathrm{pull}");
  CHECK(all[1].latex == "v_{F} = \\dot{d}");
  CHECK(all[2].latex == "d_{d} = \\mathrm{reach}");
}

TEST_CASE("MathML says the same and is balanced") {
  CHECK(torque("-a*joint_rate^2").mathml ==
        "<math><mi>&#964;</mi><mo>=</mo><mrow><mo>&#8722;</mo><mi mathvariant=\"normal\">a</mi>"
        "</mrow><mo "
        "rspace=\"0.17em\">&#8290;</mo><msup><mrow><mover><mi>&#966;</mi><mo>&#729;</mo></mover></"
        "mrow>"
        "<mrow><mn>2</mn></mrow></msup></math>");
  for (const std::string& id : built_in_effect_ids()) {
    CAPTURE(id);
    for (const Formula& formula : formulas(built_in_effect(id))) {
      std::vector<std::string> open;
      for (auto at = formula.mathml.find('<'); at != std::string::npos;
           at = formula.mathml.find('<', at + 1)) {
        const bool closing = formula.mathml[at + 1] == '/';
        const auto begin = at + (closing ? 2 : 1);
        const std::string tag =
            formula.mathml.substr(begin, formula.mathml.find_first_of(" >", begin) - begin);
        if (!closing) {
          open.push_back(tag);
        } else {
          REQUIRE_FALSE(open.empty());
          CHECK(open.back() == tag);
          open.pop_back();
        }
      }
      CHECK(open.empty());
      CHECK(std::count(formula.latex.begin(), formula.latex.end(), '{') ==
            std::count(formula.latex.begin(), formula.latex.end(), '}'));
    }
  }
}

TEST_CASE("every built-in effect shows its formulas, said of the right place") {
  for (const std::string& id : built_in_effect_ids()) {
    CAPTURE(id);
    CHECK_FALSE(formulas(built_in_effect(id)).empty());
  }
  const auto drag = formulas(built_in_effect("load_drag"));
  REQUIRE(drag.size() == 1);
  CHECK(drag[0].what == "Dissipation, at the load");
  const auto wind = formulas(built_in_effect("steady_wind"));
  REQUIRE(wind.size() == 3);
  CHECK(wind[0].what == "Velocity of the fluid, side");
  CHECK(wind[0].latex == "w_{s} = \\mathrm{wind}");
  CHECK(wind[1].what == "Force per length, at the middle of every link");
  CHECK(wind[1].latex.find("f_{n} = -\\mathrm{normal} \\, u_{n}") == 0);
  const auto current = formulas(built_in_effect("current"));
  REQUIRE(current.size() == 7);
  CHECK(current[6].latex.find("F_{a} = -\\mathrm{load} \\, u_{a}") == 0);
  // A name of its own is not the position across.
  CHECK(formulas(built_in_effect("marker_offset"))[0].latex.find("\\mathrm{across}") !=
        std::string::npos);
}
