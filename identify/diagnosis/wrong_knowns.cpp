// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/wrong_knowns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace catena {
namespace {

/// Units in which a person thinks of small deviations.
struct Shown {
  double factor;
  const char* unit;
};
Shown shown_in(const std::string& unit) {
  if (unit == "1") return {100, " %"};
  if (unit == "rad") return {180 / std::numbers::pi, " degrees"};
  if (unit == "m") return {1e3, " mm"};
  if (unit == "s") return {1e3, " ms"};
  return {1, ""};
}

}  // namespace

std::vector<std::string> wrong_knowns(const Effect& effect,
                                      const std::vector<FinalParameter>& parameters, double load) {
  std::vector<std::string> sentences;
  for (const EffectParameter& parameter : effect.parameters) {
    const auto found =
        std::find_if(parameters.begin(), parameters.end(), [&](const FinalParameter& each) {
          return each.effect == effect.id && each.name == effect.id + "." + parameter.name;
        });
    if (found == parameters.end()) continue;
    const double difference = found->value - parameter.neutral;
    const double error = found->half_width();
    std::string sentence = difference > 0 ? parameter.above : parameter.below;
    if (sentence.empty() || !(std::abs(difference) > error)) continue;
    Shown shown = shown_in(parameter.unit);
    if (effect.kinematics.load_mass.text == parameter.name && load > 0) shown = {100 / load, " %"};
    const std::string unit =
        shown.factor == 1 ? fmt::format(" {}", parameter.unit) : std::string(shown.unit);
    const double size = std::abs(difference);
    sentence.replace(sentence.find("{}"), 2,
                     fmt::format("{:.3g}{} ({:.3g} to {:.3g})", shown.factor * size, unit,
                                 shown.factor * (size - error), shown.factor * (size + error)));
    sentences.push_back(std::move(sentence));
  }
  return sentences;
}

}  // namespace catena
