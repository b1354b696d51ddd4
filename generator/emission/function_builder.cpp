// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/function_builder.hpp"

namespace catena {

using GiNaC::ex;

namespace {

std::string differential_family(const std::string& family) { return "d_" + family; }

// An effect is off while all numbers are zero that are so at its neutral values.
std::vector<Switch> switches_of(const Description& description) {
  std::vector<Switch> switches;
  for (const Effect& effect : description.effects) {
    Switch off;
    if (effect.held_end.holds()) continue;  // it holds at all values
    for (const EffectParameter& parameter : effect.parameters)
      if (parameter.neutral == 0 && parameter.scope == Scope::kModel)
        off.families.insert(effect.id + "_" + parameter.name);
    if (!off.families.empty()) switches.push_back(std::move(off));
  }
  return switches;
}

}  // namespace

FunctionBuilder::FunctionBuilder(const Description& description, int links, Layout layout,
                                 FunctionSet set)
    : description_(description),
      links_(links),
      layout_(layout),
      chain_(description, links, "",
             set == FunctionSet::kFits ? EffectForces::kApart : EffectForces::kMerged),
      definitions_(chain_.definitions()),
      tangent_(definitions_, differential_family),
      at_(inputs_of(description, links, "at", false, Type::kScalar)),
      at_and_along_(at_) {
  at_and_along_.merge(inputs_of(description, links, "along", true, Type::kDifferential));
  for (const char* weight : {"ca", "cv", "cq"}) at_and_along_[weight] = at_[weight] = std::nullopt;
  result_.set = set;
  if (!has_all()) switches_ = switches_of(description);
}

ModelFunctions FunctionBuilder::build() {
  const ModelTable table = model_table(description_, links_);
  ModelSummary& s = result_.summary;
  s.name = model_name(description_, links_);
  s.links = links_;
  s.layout = layout_;
  s.coordinates = static_cast<int>(table.coordinates.size());
  s.constraints = chain_.constraints();
  s.border = chain_.border();
  s.states = static_cast<int>(table.states.size());
  s.signals = static_cast<int>(table.signals.size());
  s.parameters = static_cast<int>(table.parameters.size());
  set_tangent_directions();
  residual();
  if (has_all()) terms();
  if (s.states > 0) state_rates();
  mass_and_acceleration();
  newton();
  if (has_all()) energy();
  positions();
  if (has_all()) internal_forces();
  if (has_all()) reactions();
  if (chain_.constraints() > 0) gap();
  s.events = has_all() ? static_cast<int>(table.events.size()) : 0;
  if (s.events > 0) events();
  if (chain_.sensor().given) sensor();
  if (has_all()) adjoint();
  result_.space = description_.space;
  if (has_all()) result_.energies = chain_.energies();
  for (const Function& function : result_.functions) {
    if (!function.statements.empty())
      s.functions.push_back({function.name, operations_of(function.statements)});
  }
  return std::move(result_);
}

// The differential of every input is an input of its own, "d_<family>".
void FunctionBuilder::set_tangent_directions() {
  for (int k = 0, count = definitions_.size(); k < count; ++k) {
    const Symbol symbol = definitions_[k];
    if (symbol.is_input && symbol.family != "pi") {
      tangent_.set(symbol.symbol, definitions_.input("d_" + symbol.family, symbol.index));
    } else if (symbol.family == "sine" || symbol.family == "cosine") {
      const bool sine = symbol.family == "sine";
      const ex angle = symbol.value.op(0);
      const ex other = sine ? ex(definitions_.define("cosine", symbol.index, GiNaC::cos(angle)))
                            : ex(definitions_.define("sine", symbol.index, GiNaC::sin(angle)));
      const ex change = definitions_.input("d_theta", symbol.index) * other;
      tangent_.set(symbol.symbol, sine ? change : ex(-change));
    }
  }
}

// The derivatives of outputs, each under its name with a "d" before it.
std::vector<Output> FunctionBuilder::tangents_of(std::vector<Output> outputs) {
  for (Output& output : outputs) {
    output.array.name = "d" + output.array.name;
    output.value = tangent_.of(output.value);
  }
  return outputs;
}

Substitution FunctionBuilder::without_acceleration(Chain& chain) {
  Substitution substitution(chain.definitions(), "_bias");
  for (const ex& a : chain.accelerations()) substitution.set(a, 0);
  return substitution;
}

}  // namespace catena
