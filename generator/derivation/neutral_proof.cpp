// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/neutral_proof.hpp"

#include <algorithm>
#include <cmath>

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
      : neutral_(model.definitions(), "_neutral"), written_out_(model.definitions()) {
    Definitions& definitions = model.definitions();
    for (const Effect& effect : description.effects) {
      for (const EffectParameter& parameter : effect.parameters) {
        if (std::isnan(parameter.neutral)) continue;
        const ex value = exact_number(shortest_number(parameter.neutral));
        const std::string family = effect.id + "_" + parameter.name;
        if (parameter.scope == Scope::kModel) {
          neutral_.set(definitions.input(family), value);
          continue;
        }
        for (int i = 1; i <= model.links(); ++i) {
          neutral_.set(definitions.input(family, i), value);
        }
      }
    }
    for (int k = 0, count = plain.definitions().size(); k < count; ++k) {
      const Symbol symbol = plain.definitions()[k];
      if (symbol.is_input) {
        shared_[definitions.input(symbol.family, symbol.index)] = symbol.symbol;
      }
    }
  }

  ex of(const ex& expression) {
    return written_out_.of(neutral_.of(expression)).subs(shared_, GiNaC::subs_options::no_pattern);
  }

 private:
  Substitution neutral_;
  WrittenOut written_out_;
  GiNaC::exmap shared_;
};

// What a load with coordinates of its own has beyond the plain chain must not see the chain: the same with
// other coordinates of the links, and rates and accelerations, is the same expression.
class OtherLinks {
 public:
  explicit OtherLinks(const Chain& plain) {
    const auto replace = [&](const std::vector<ex>& symbols) {
      for (std::size_t k = 0; k < plain.coordinates().size(); ++k)
        other_[symbols[k]] = GiNaC::realsymbol("other_" + std::to_string(other_.size()));
    };
    replace(plain.coordinates()), replace(plain.rates()), replace(plain.accelerations());
  }

  ex of(const ex& expression) const {
    return expression.subs(other_, GiNaC::subs_options::no_pattern);
  }

 private:
  GiNaC::exmap other_;
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

  const OtherLinks other_links(plain);
  const auto change_with_links = [&](const ex& of_model) {
    const ex at_these = at_neutral.of(of_model);
    return at_these - other_links.of(at_these);
  };
  EntryComparison residual("residual");
  for (std::size_t i = 0; i < model.residual().size(); ++i) {
    const bool of_load = i >= plain.residual().size();
    residual.entry("(" + std::to_string(i + 1) + ")",
                   of_load ? change_with_links(model.residual()[i])
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
    energies.entry(" of " + item.name, of_load ? change_with_links(sum_of(item.parts))
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
    sensor.entry(" of side", difference(ours.side, none.side));
    sensor.entry(" of down", difference(ours.down, none.down));
    sensor.entry(" of angles", difference(ours.angle, none.angle));
    sensor.entry(" of time", difference(ours.clock, none.clock));
    result.proofs.push_back(sensor.proof());
  }
  return result;
}

}  // namespace catena
