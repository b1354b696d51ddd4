// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_effect.hpp"

#include <fmt/format.h>

#include <cmath>
#include <vector>

#include "common/number_text.hpp"
#include "common/toml_quoted.hpp"

namespace catena {

namespace {

/// Bounds: amplitudes are at most so many times the one found, others so many deviations from the
/// value found. A fit that goes there has lost its way.
constexpr double kBound = 1000;
/// m, of the step by which a link takes over the place from its neighbour. Both put it at the same
/// point but for so much.
constexpr double kStepWidth = 1e-5;

}  // namespace

std::string effect_of(const ForceLaw& law, const std::string& id, double arc_length,
                      double length) {
  const PlaceLaw::Formula& formula = law.formula;
  const bool load = at_end(arc_length, length), support = arc_length == 0;
  const bool inside = !load && !support;
  const std::string title =
      fmt::format("{} against {}{}", law.force, law.variable,
                  support ? std::string()
                          : " at " + (load ? std::string("the load")
                                           : fmt::format("arc length {:.3g} m", arc_length)));
  const std::string words = fmt::format(
      "Found in recordings, declared by nobody: {}; {}. Chosen of {} pairs of a force and a "
      "variable in the first half of the frames, it explained {:.0f} % of what a force can explain "
      "in the second; of random forces {:.2g} did as well.",
      title, formula.text, law.candidates, 100 * law.confirmed, law.chance);
  std::string text =
      fmt::format("format = 1\nkind = \"effect\"\nid = \"{}\"\ntitle = {}\ndescription = {}\n", id,
                  toml_quoted("Discovered: " + title), toml_quoted(words));

  const auto parameter = [&](const PlaceLaw::Constant& of, double lower, double upper) {
    text += fmt::format("\n[parameters.{}]\nunit = \"{}\"\nlower = {}\nupper = {}\n{} = {}\n",
                        of.name, of.unit, shortest_number(lower), shortest_number(upper),
                        of.amplitude ? "neutral" : "default",
                        shortest_number(of.amplitude ? 0 : of.value));
    text += fmt::format("description = \"Found: {:.6g} +- {:.2g}\"\n", of.value, of.deviation);
  };
  for (const PlaceLaw::Constant& constant : formula.constants) {
    const double bound = kBound * std::abs(constant.value);
    if (constant.amplitude)
      // A force against a velocity must give no energy.
      parameter(constant, formula.dissipation ? 0.0 : -bound, bound);
    else
      parameter(constant, constant.value - kBound * constant.deviation,
                constant.value + kBound * constant.deviation);
  }
  if (inside) parameter({kLawPlace, "m", arc_length, law.place_deviation, false}, 0, length);

  std::vector<PlaceLaw::Constant> fixed = formula.fixed;
  if (inside) fixed.push_back({"width", "m", kStepWidth});
  if (load && formula.energy.find("offset") != std::string::npos)
    fixed.push_back({"offset", "m", 0});
  for (const PlaceLaw::Constant& constant : fixed)
    text += fmt::format("\n[constants.{}]\nvalue = {}\nunit = \"{}\"\n", constant.name,
                        shortest_number(constant.value), constant.unit);
  const auto define = [&](const char* name, const char* value) {
    text += fmt::format("\n[[definition]]\nname = \"{}\"\nat = \"link_centre\"\nvalue = \"{}\"\n",
                        name, value);
  };
  if (inside) {
    define("offset", "place - arc");
    define("here", "(tanh((offset + length/2)/width) - tanh((offset - length/2)/width))/2");
  }
  text += fmt::format("\n[[{}]]\nat = \"{}\"\nvalue = \"{}\"\n",
                      formula.dissipation ? "dissipation" : "potential",
                      load      ? "load"
                      : support ? "pivot"
                                : "link_centre",
                      inside ? fmt::format("here*({})", formula.energy) : formula.energy);
  return text;
}

}  // namespace catena
