// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_effect.hpp"

#include <fmt/format.h>

#include <cmath>

#include "common/number_text.hpp"
#include "common/toml_quoted.hpp"

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Share of the cable below which a place is at its end.
constexpr double kAtEnd = 1e-6;
/// Bounds: amplitudes are at most so many times the one found, others so many deviations from the
/// value found. A fit that goes there has lost its way.
constexpr double kBound = 1000;

bool used(const std::string& name, const std::string& energy) {
  return energy.find(name) != std::string::npos;
}

}  // namespace

LawEffect effect_of(const ForceLaw& law, const std::string& id, double arc_length,
                    const VectorXd& lengths) {
  LawEffect effect;
  const PlaceLaw::Formula& formula = law.formula;
  const bool end = arc_length > lengths.sum() * (1 - kAtEnd);
  double length = 0;
  if (!end) {
    double begin = 0;
    Index k = 0;
    while (k + 1 < lengths.size() && arc_length > begin + lengths[k]) begin += lengths[k++];
    length = lengths[k];
    effect.link = static_cast<int>(k) + 1;
    effect.offset = arc_length - begin - 0.5 * length;
    effect.has_offset = used("offset", formula.energy);
  }
  const std::string title =
      fmt::format("{} against {} at {}", law.force, law.variable,
                  end ? std::string("the load") : fmt::format("arc length {:.3g} m", arc_length));
  std::string words = fmt::format(
      "Found in recordings, declared by nobody: {}; {}. Chosen of {} pairs of a force and a "
      "variable in the first half of the frames, it explained {:.0f} % of what a force can explain "
      "in the second; of random forces {:.2g} did as well.",
      title, formula.text, law.candidates, 100 * law.confirmed, law.chance);
  if (effect.link > 0)
    words += fmt::format(" It acts on link {} of {}: give no other link an amplitude.", effect.link,
                         lengths.size());
  effect.text =
      fmt::format("format = 1\nkind = \"effect\"\nid = \"{}\"\ntitle = {}\ndescription = {}\n", id,
                  toml_quoted("Discovered: " + title), toml_quoted(words));

  const auto parameter = [&](const PlaceLaw::Constant& of, double lower, double upper) {
    effect.text += fmt::format(
        "\n[parameters.{}]\nunit = \"{}\"\n{}lower = {}\nupper = {}\n{} = {}\n", of.name, of.unit,
        of.amplitude && !end ? "scope = \"link\"\n" : "", shortest_number(lower),
        shortest_number(upper), of.amplitude ? "neutral" : "default",
        shortest_number(of.amplitude ? 0 : of.value));
    effect.text +=
        fmt::format("description = \"Found: {:.6g} +- {:.2g}\"\n", of.value, of.deviation);
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
  const PlaceLaw::Constant offset{"offset", "m", effect.offset, law.place_deviation, false};
  if (effect.has_offset) parameter(offset, -0.5 * length, 0.5 * length);
  std::vector<PlaceLaw::Constant> fixed = formula.fixed;
  if (!effect.has_offset && used("offset", formula.energy)) fixed.push_back(offset);
  for (const PlaceLaw::Constant& constant : fixed)
    effect.text += fmt::format("\n[constants.{}]\nvalue = {}\nunit = \"{}\"\n", constant.name,
                               shortest_number(constant.value), constant.unit);
  effect.text += fmt::format("\n[[{}]]\nat = \"{}\"\nvalue = \"{}\"\n",
                             formula.dissipation ? "dissipation" : "potential",
                             end ? "load" : "link_centre", formula.energy);
  return effect;
}

}  // namespace catena
