// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/neutral_proof.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

#include "common/number_text.hpp"
#include "common/toml_reader.hpp"
#include "generator/derivation/chain.hpp"
#include "generator/derivation/effect_expression.hpp"
#include "generator/derivation/entry_comparison.hpp"
#include "generator/derivation/written_out.hpp"

namespace catena {

using GiNaC::ex;

namespace {

// The expressions of the model with neutral values inserted, in the symbols of the plain chain.
class AtNeutral {
 public:
  AtNeutral(const Description& description, Chain& model, Chain& plain)
      : definitions_(model.definitions()),
        neutral_(model.definitions(), "_neutral"),
        written_out_(model.definitions()) {
    for (const Effect& effect : description.effects) {
      for (const EffectParameter& parameter : effect.parameters) {
        if (std::isnan(parameter.neutral)) continue;
        const ex value = exact_number(shortest_number(parameter.neutral));
        const std::string family = effect.id + "_" + parameter.name;
        if (parameter.scope == Scope::kModel) {
          neutral_.set(definitions_.input(family), value);
          continue;
        }
        for (int i = 1; i <= model.links(); ++i) {
          neutral_.set(definitions_.input(family, i), value);
        }
      }
    }
    for (int k = 0, count = plain.definitions().size(); k < count; ++k) {
      const Symbol symbol = plain.definitions()[k];
      if (symbol.is_input) {
        shared_[definitions_.input(symbol.family, symbol.index)] = symbol.symbol;
      }
    }
  }

  ex of(const ex& expression) {
    return written_out_.of(neutral_.of(expression)).subs(shared_, GiNaC::subs_options::no_pattern);
  }

  // The sum of those of `symbols` that the expression is made of, which need not be written out for it: the
  // equations of a body's attitude would fill the memory.
  ex uses(const ex& expression, const std::vector<ex>& symbols) {
    std::set<int> seen;
    std::vector<int> waiting = definitions_.symbols_of(neutral_.of(expression));
    while (!waiting.empty()) {
      const int number = waiting.back();
      waiting.pop_back();
      if (!seen.insert(number).second) continue;
      for (const int below : definitions_.symbols_of(definitions_[number].value))
        waiting.push_back(below);
    }
    ex sum = 0;
    for (const ex& symbol : symbols)
      if (seen.contains(definitions_.number_of(symbol))) sum += symbol;
    return sum;
  }

 private:
  Definitions& definitions_;
  Substitution neutral_;
  WrittenOut written_out_;
  GiNaC::exmap shared_;
};

ex sum_of(const std::vector<ex>& parts) {
  ex sum = 0;
  for (const ex& part : parts) sum += part;
  return sum;
}

}  // namespace

NeutralProofs prove_neutral(const Description& description, int links) {
  NeutralProofs result;
  bool has_neutral = false;
  for (const Effect& effect : description.effects) {
    bool own = false;
    for (const EffectParameter& parameter : effect.parameters) {
      if (std::isinf(parameter.neutral)) {
        result.why_not = effect.id + "." + parameter.name + " vanishes only in the limit";
        return result;
      }
      own = own || !std::isnan(parameter.neutral);
    }
    const bool stretches =
        std::any_of(effect.coordinates.begin(), effect.coordinates.end(),
                    [](const Coordinate& coordinate) { return coordinate.at == Place::kLink; });
    if (stretches || effect.held_end.holds()) {
      result.why_not = effect.id + " has coordinates that the plain chain does not have";
    } else if (!own) {
      result.why_not = effect.id + " has no parameter with a neutral value";
    }
    if (!result.why_not.empty()) return result;
    has_neutral = true;
  }
  if (!has_neutral) return result;

  Description without = plain_chain();
  without.space = description.space;
  Chain model(description, links), plain(without, links);
  AtNeutral at_neutral(description, model, plain);
  WrittenOut written_out(plain.definitions());
  const auto difference = [&](const ex& of_model, const ex& of_plain) {
    return at_neutral.of(of_model) - written_out.of(of_plain);
  };

  // What a load with coordinates of its own has beyond the plain chain must not see the chain.
  std::vector<ex> of_links;
  for (const std::vector<ex>* symbols :
       {&model.coordinates(), &model.rates(), &model.accelerations()}) {
    of_links.insert(of_links.end(), symbols->begin(),
                    symbols->begin() + static_cast<std::ptrdiff_t>(plain.coordinates().size()));
  }
  EntryComparison residual("residual");
  for (std::size_t i = 0; i < model.residual().size(); ++i) {
    const bool of_load = i >= plain.residual().size();
    residual.entry("(" + std::to_string(i + 1) + ")",
                   of_load ? at_neutral.uses(model.residual()[i], of_links)
                           : difference(model.residual()[i], plain.residual()[i]));
  }
  result.proofs.push_back(residual.proof());

  EntryComparison energies("energies and powers");
  for (const EnergyItem& item : model.energies()) {
    ex expected = 0;
    for (const EnergyItem& other : plain.energies()) {
      if (other.name == item.name && other.kind == item.kind) expected = sum_of(other.parts);
    }
    const bool of_load = std::any_of(
        description.effects.begin(), description.effects.end(),
        [&](const Effect& effect) { return effect.id == item.name && effect.moves_load(); });
    energies.entry(" of " + item.name, of_load ? at_neutral.uses(sum_of(item.parts), of_links)
                                               : difference(sum_of(item.parts), expected));
  }
  result.proofs.push_back(energies.proof());

  EntryComparison forces("joint moments and tensions");
  for (std::size_t i = 0; i < static_cast<std::size_t>(links); ++i) {
    forces.entry(" of joint " + std::to_string(i + 1),
                 difference(model.moments()[i], plain.moments()[i]));
    forces.entry(" of link " + std::to_string(i + 1),
                 difference(model.tensions()[i], plain.tensions()[i]));
  }
  result.proofs.push_back(forces.proof());

  if (model.sensor().given) {
    const Chain::Sensor& ours = model.sensor();
    const Chain::Sensor& none = plain.sensor();
    EntryComparison sensor("what sensors report");
    for (std::size_t k = 0; k < ours.reported.size(); ++k)
      sensor.entry(" of " + ours.seen[k], difference(ours.reported[k], none.reported[k]));
    sensor.entry(" of time", difference(ours.clock, none.clock));
    result.proofs.push_back(sensor.proof());
  }
  return result;
}

}  // namespace catena
