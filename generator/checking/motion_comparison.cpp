// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/motion_comparison.hpp"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "generator/checking/numeric_state.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// The sources each of which, set to zero in a state, makes both sides agree.
std::vector<std::string> sources_without_which(
    const ChainSymbols& chain, const NumericState& state,
    const std::function<bool(const NumericState&)>& agrees) {
  const auto without = [&](const std::string& source, const std::vector<ex>& symbols) {
    NumericState changed = state;
    changed.assignments.push_back("without " + source);
    for (const ex& symbol : symbols)
      if (changed.values.count(symbol) != 0) changed.values[symbol] = 0;
    return agrees(changed);
  };
  std::vector<std::string> result;
  const auto look_at = [&](const std::string& source, const std::vector<ex>& symbols) {
    if (without(source, symbols)) result.push_back(source);
  };
  look_at("gravity", {chain.gravity});
  look_at("the centrifugal terms or the dampers", chain.rate);
  for (const auto& [source, family] :
       {std::pair<std::string, const std::vector<ex>&>{"spring of joint ", chain.stiffness},
        {"damper of joint ", chain.damping},
        {"torque T_", chain.torque},
        {"rotational energy of link ", chain.inertia}}) {
    if (!without("any " + source, family)) continue;  // saves looking at each
    for (std::size_t j = 1; j < family.size(); ++j)
      look_at(source + std::to_string(j), {family[j]});
  }
  for (std::size_t j = 1; j < chain.mass.size(); ++j)
    look_at("link " + std::to_string(j), {chain.mass[j], chain.inertia[j]});
  look_at("the load", {chain.load_mass});
  for (const auto& [name, symbols] : chain.effects) look_at(name, symbols);
  return result;
}

}  // namespace

void compare_with_motion(const ex& expression, int k, ChainMotion& motion,
                         const ChainSymbols& chain, std::uint64_t seed, Finding& finding) {
  using Values = std::pair<numeric, numeric>;  // by hand, the chain's
  const auto values_at = [&](const NumericState& state) -> std::optional<Values> {
    const std::optional<ChainMotion::Vector>& there = motion.accelerations(state);
    if (!there) return std::nullopt;
    GiNaC::exmap moving = state.values;
    for (std::size_t j = 0; j < there->size(); ++j) moving[chain.acceleration[j + 1]] = (*there)[j];
    const std::optional<numeric> yours = Evaluation(moving)(expression);
    if (!yours) return std::nullopt;
    return Values(*yours, k == 0 ? 0 : (*there)[static_cast<std::size_t>(k) - 1]);
  };
  const auto agree = [](const Values& values) {
    return GiNaC::abs(values.first - values.second) <=
           closeness() * (1 + GiNaC::abs(values.first) + GiNaC::abs(values.second));
  };
  int real = 0;
  for (std::uint64_t attempt = 0; attempt < kStates; ++attempt) {
    const NumericState state = random_state(motion.symbols(), seed + attempt);
    const std::optional<Values> values = values_at(state);
    if (!values) continue;
    ++real;
    if (agree(*values)) continue;
    finding.verdict = Verdict::kDifferent;
    finding.state = state.assignments;
    finding.value = twelve_digits(values->first);
    finding.expected = twelve_digits(values->second);
    finding.origins = sources_without_which(chain, state, [&](const NumericState& without) {
      const std::optional<Values> left = values_at(without);
      return left && agree(*left);
    });
    return;
  }
  if (real == 0) {
    finding.remark += "; no state tried gave real numbers";
  } else if (finding.verdict == Verdict::kUndecided) {
    finding.remark += "; both agree to 40 digits at " + std::to_string(real) + " random states";
  }
}

}  // namespace catena::checking
