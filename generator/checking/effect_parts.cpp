// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/effect_parts.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "description/description.hpp"
#include "generator/derivation/chain.hpp"
#include "generator/derivation/written_out.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;

/// The chain with some effects, written out in the symbols of a derivation.
class ChainWithEffects {
 public:
  ChainWithEffects(const Description& description, const ChainSymbols& symbols)
      : chain_(description, symbols.links), written_out_(chain_.definitions()) {
    const std::map<std::string, const std::vector<ex>*> families = {
        {"theta", &symbols.angle},
        {"theta_dot", &symbols.rate},
        {"theta_ddot", &symbols.acceleration},
        {"length", &symbols.length},
        {"mass", &symbols.mass},
        {"inertia", &symbols.inertia},
        {"stiffness", &symbols.stiffness},
        {"damping", &symbols.damping},
        {"torque", &symbols.torque}};
    const Definitions& definitions = chain_.definitions();
    for (int number = 0; number < definitions.size(); ++number) {
      const Symbol symbol = definitions[number];
      if (!symbol.is_input) continue;
      const auto index = static_cast<std::size_t>(std::max(symbol.index, 0));
      const auto family = families.find(symbol.family);
      const auto effect = symbols.effects.find(symbol.family);
      if (family != families.end())
        replaced_[symbol.symbol] = (*family->second)[index];
      else if (effect != symbols.effects.end())
        replaced_[symbol.symbol] = effect->second[index];
      else if (symbol.family == "load_mass")
        replaced_[symbol.symbol] = symbols.load_mass;
      else if (symbol.family == "gravity")
        replaced_[symbol.symbol] = symbols.gravity;
      else
        unknown_.emplace_back(symbol.family, symbol.symbol);
    }
  }

  ex kinetic() { return sum_of(chain_.energy_functions().kinetic); }
  ex potential() { return sum_of(chain_.energy_functions().potential); }
  ex dissipation() { return sum_of(chain_.energy_functions().dissipation); }
  /// Left side of equation i.
  ex equation(int i) { return sum_of({chain_.residual()[static_cast<std::size_t>(i) - 1]}); }

 private:
  ex sum_of(const std::vector<ex>& parts) {
    ex sum = 0;
    for (const ex& part : parts) sum += written_out_.of(part);
    for (const auto& [name, symbol] : unknown_)
      if (sum.has(symbol))
        throw InputError("--effect: " + in_quotes(name) +
                         " has no symbol in a derivation; only effects without coordinates, "
                         "states, signals and the time can be checked");
    return sum.subs(replaced_, GiNaC::subs_options::no_pattern);
  }

  Chain chain_;
  WrittenOut written_out_;
  GiNaC::exmap replaced_;
  std::vector<std::pair<std::string, ex>> unknown_;
};

}  // namespace

EffectParts parts_of_effects(const std::vector<Effect>& effects, const ChainSymbols& symbols) {
  EffectParts parts;
  parts.equation.resize(symbols.angle.size());
  if (effects.empty()) return parts;
  for (const Effect& effect : effects)
    if (!effect.coordinates.empty())
      throw InputError("--effect: " + effect.id +
                       " has coordinates, which have no symbols in a derivation");
  Description description = plain_chain();
  auto before = std::make_unique<ChainWithEffects>(description, symbols);
  for (const Effect& effect : effects) {
    description.effects.push_back(effect);
    auto with = std::make_unique<ChainWithEffects>(description, symbols);
    const auto add = [&](Contributions& to, const ex& now, const ex& then) {
      const ex more = (now - then).expand();
      if (!more.is_zero()) to.push_back({"the effect " + effect.id, more});
    };
    add(parts.kinetic, with->kinetic(), before->kinetic());
    add(parts.potential, with->potential(), before->potential());
    add(parts.dissipation, with->dissipation(), before->dissipation());
    for (int i = 1; i <= symbols.links; ++i)
      add(parts.equation[static_cast<std::size_t>(i)], with->equation(i), before->equation(i));
    before = std::move(with);
  }
  return parts;
}

}  // namespace catena::checking
