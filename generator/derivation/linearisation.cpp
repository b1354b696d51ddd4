// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/linearisation.hpp"

namespace catena {

using GiNaC::ex;

namespace {

/// The turn of carried axes about their links: a sum along the chain that no equation names, but all of its changes are
/// made of.
constexpr const char* kRoll = "carried_roll";

void add(Form& form, const Basis& basis, const ex& coefficient) {
  if (coefficient.is_zero()) return;
  ex& entry = form[basis];
  entry = (entry + coefficient).expand();
  if (entry.is_zero()) form.erase(basis);
}

}  // namespace

ex entry(const Form& form, const Basis& basis) {
  const auto found = form.find(basis);
  return found == form.end() ? ex(0) : found->second;
}

Linearisation::Linearisation(Chain& chain, const Weights& weights, Moving moving)
    : chain_(chain), definitions_(chain.definitions()), weights_(weights), links_(chain.links()) {
  const auto move = [&](const ex& symbol, int component, const ex& weight) {
    moved_[definitions_[definitions_.number_of(symbol)].family] = {component, weight};
  };
  if (moving == Moving::kCoordinates) {
    equations_ = chain.residual();
    for (int k = 0; k < components(); ++k) {
      const size_t first = static_cast<size_t>(k) * static_cast<size_t>(links_);
      move(chain.coordinates()[first], k, weights_.position);
      move(chain.rates()[first], k, weights_.velocity);
      move(chain.accelerations()[first], k, weights_.acceleration);
    }
  } else {
    for (const Axis axis : chain.axes()) {
      const std::vector<ex>& forces = chain.direction_forces()[axis];
      equations_.insert(equations_.end(), forces.begin() + 1, forces.begin() + 1 + links_);
      move(chain.rate(chain.rate(chain.directions()[axis][1])), axis, weights_.acceleration);
    }
  }
  for (std::size_t i = 1; i < chain.bend_axes().size(); ++i)
    for (const Axis axis : chain.axes())
      of_axis_[definitions_.number_of(chain.bend_axes()[i].axis[axis])] = {static_cast<int>(i),
                                                                           axis};
  for (const ex& force : chain.chord_forces()) chord_forces_.insert(definitions_.number_of(force));
  for (size_t k = 0; k < chain.states().size(); ++k) {
    if (!chain.states()[k].is_equal(chain.path()))
      state_rates_[definitions_.symbols_of(chain.states()[k]).front()] = chain.state_rates()[k];
  }
  for (const auto& [state, rate] : state_rates_) {
    for (const int number : reached_from({rate})) {
      if (number != state && state_rates_.count(number))
        throw NotOfThisForm("extra states depend on each other");
      reached_.insert(number);
    }
  }
  reached_.merge(reached_from(equations_));
  if (moving == Moving::kDirections) {
    for (const ex& acceleration : chain.accelerations())
      if (reached_.contains(definitions_.number_of(acceleration)))
        throw NotOfThisForm("forces of directions depend on other accelerations than theirs");
  }
  for (const int k : reached_) {
    const Symbol& symbol = definitions_[k];
    if (symbol.is_input || symbol.index == kNoIndex) continue;
    if (of_axis_.contains(k) && !weights_.position.is_zero()) down_.insert(kRoll);
    if (of_axis_.contains(k)) continue;
    for (const int argument : definitions_.symbols_of(symbol.value)) {
      if (definitions_[argument].family != symbol.family) continue;
      if (definitions_[argument].index == symbol.index - 1) down_.insert(symbol.family);
      if (definitions_[argument].index == symbol.index + 1) up_.insert(symbol.family);
    }
  }
  for (const auto& family : down_) {
    if (up_.count(family)) throw NotOfThisForm(family + " depends on both neighbouring links");
  }
  // From the first link on. Recursion from the last of thousands of links would overflow the
  // stack.
  for (const int k : reached_) change_of_symbol(k);
}

Form Linearisation::at_link(const ex& expression, int i) {
  return at_link_of_form(change_of(expression), i);
}

Form Linearisation::at_link_of_form(Form form, int i) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& [basis, coefficient] : form) {
      const bool expand =
          (basis.kind == Basis::kCarriedDown && (basis.index >= i || basis.index == 0)) ||
          (basis.kind == Basis::kCarriedUp && (basis.index <= i || i == links_));
      if (!expand) continue;
      const ex factor = coefficient;
      const Form inner = definition_of(basis);
      form.erase(basis);
      for (const auto& [b, c] : inner) add(form, b, factor * c);
      changed = true;
      break;
    }
  }
  for (const auto& [basis, coefficient] : form) {
    const int reach = basis.index - i;
    const bool allowed = basis.kind == Basis::kChordForce     ? true
                         : basis.kind == Basis::kPerturbation ? reach >= -1 && reach <= 1
                         : basis.kind == Basis::kCarriedDown  ? reach == -1
                                                              : reach == 1;
    if (!allowed) {
      throw NotOfThisForm("link " + std::to_string(i) + " depends on " +
                          (basis.family.empty() ? "the angle" : basis.family) + " of link " +
                          std::to_string(basis.index));
    }
  }
  return form;
}

Form Linearisation::of_no_link(const ex& expression) {
  Form form = change_of(expression);
  for (const auto& [basis, coefficient] : form)
    if (basis.kind == Basis::kCarriedUp || basis.kind == Basis::kChordForce)
      throw NotOfThisForm("what belongs to no link depends on " + basis.family);
  return form;
}

std::map<Basis, Form> Linearisation::chord_forces() {
  std::map<Basis, Form> changes;
  for (const int number : chord_forces_) {
    const Form itself = change_of_symbol(number);
    if (!itself.empty()) changes[itself.begin()->first] = of_no_link(definitions_[number].value);
  }
  return changes;
}

Form Linearisation::along_links(const ex& expression) {
  Form form = change_of(expression);
  for (const auto& [basis, coefficient] : form)
    if (basis.kind != Basis::kPerturbation)
      throw NotOfThisForm("a state of the whole chain depends on " + basis.family);
  return form;
}

int Linearisation::components() const {
  return (static_cast<int>(chain_.coordinates().size()) - chain_.border()) / links_;
}

ex Linearisation::one_name(const std::string& family, int index, const ex& value) {
  constexpr size_t kShort = 4;  // terms
  if (GiNaC::is_a<GiNaC::symbol>(value) || GiNaC::is_a<GiNaC::numeric>(value)) return value;
  GiNaC::exmap inside;
  for (const int number : definitions_.symbols_of(value)) {
    const auto found = short_forms_.find(number);
    if (found != short_forms_.end()) inside[definitions_[number].symbol] = found->second;
  }
  const ex short_form = value.subs(inside, GiNaC::subs_options::no_pattern).expand();
  if (GiNaC::is_a<GiNaC::add>(short_form) && short_form.nops() > kShort)
    return definitions_.define(family, index, value);
  const auto [known, is_new] = names_.emplace(definitions_.canonical_key(short_form), 0);
  if (is_new) {
    known->second = definitions_.define(family, index, value);
    if (GiNaC::is_a<GiNaC::symbol>(known->second))
      short_forms_[definitions_.number_of(known->second)] = short_form;
  }
  return known->second;
}

Form Linearisation::carried(const std::string& family, int i) {
  if (family == kRoll) return at_link_of_form(change_of_roll(i), i);
  for (const Basis::Kind kind : {Basis::kCarriedDown, Basis::kCarriedUp}) {
    const auto found = numbers().find({kind, family, i});
    if (found != numbers().end()) return at_link(definitions_[found->second].value, i);
  }
  return {};
}

std::set<int> Linearisation::reached_from(const std::vector<ex>& expressions) {
  std::set<int> reached;
  std::vector<int> open;
  const auto reach = [&](const ex& expression) {
    for (const int number : definitions_.symbols_of(expression)) {
      if (reached.insert(number).second) open.push_back(number);
    }
  };
  for (const ex& expression : expressions) reach(expression);
  while (!open.empty()) {
    const int number = open.back();
    open.pop_back();
    if (!moved_.contains(definitions_[number].family)) reach(definitions_[number].value);
  }
  return reached;
}

const std::map<Basis, int>& Linearisation::numbers() {
  if (numbers_.empty()) {
    for (const int k : reached_) {
      const Symbol& symbol = definitions_[k];
      if (symbol.is_input) continue;
      if (down_.count(symbol.family))
        numbers_[{Basis::kCarriedDown, symbol.family, symbol.index}] = k;
      if (up_.count(symbol.family)) numbers_[{Basis::kCarriedUp, symbol.family, symbol.index}] = k;
    }
  }
  return numbers_;
}

Form Linearisation::definition_of(const Basis& basis) {
  if (basis.family == kRoll) return change_of_roll(basis.index);
  return change_of(definitions_[numbers().at(basis)].value);
}

Form Linearisation::change_of(const ex& expression) {
  Form form;
  for (const int number : definitions_.symbols_of(expression)) {
    const Form inner = change_of_symbol(number);
    if (inner.empty()) continue;
    const ex partial = expression.diff(GiNaC::ex_to<GiNaC::symbol>(definitions_[number].symbol));
    for (const auto& [basis, coefficient] : inner) add(form, basis, partial * coefficient);
  }
  return form;
}

Form Linearisation::change_of_symbol(int number) {
  const auto found = known_.find(number);
  if (found != known_.end()) return found->second;
  const Symbol symbol = definitions_[number];
  Form form;
  if (state_rates_.count(number)) {
    form = change_of_state(number);
  } else if (const auto moved = moved_.find(symbol.family); moved != moved_.end()) {
    add(form, {Basis::kPerturbation, "", symbol.index, moved->second.component},
        moved->second.weight);
  } else if (const auto axis = of_axis_.find(number); axis != of_axis_.end()) {
    form = change_of_axis(number, axis->second.link, axis->second.component);
  } else if (symbol.family == "sine") {
    add(form, {Basis::kPerturbation, "", symbol.index},
        weights_.position *
            definitions_.define("cosine", symbol.index, GiNaC::cos(symbol.value.op(0))));
  } else if (symbol.family == "cosine") {
    add(form, {Basis::kPerturbation, "", symbol.index},
        -weights_.position *
            definitions_.define("sine", symbol.index, GiNaC::sin(symbol.value.op(0))));
  } else if (!symbol.is_input) {
    const Form inner = change_of(symbol.value);
    if (inner.empty()) {
      // no change
    } else if (chord_forces_.count(number)) {
      form[{Basis::kChordForce, symbol.family, symbol.index}] = 1;
    } else if (down_.count(symbol.family)) {
      form[{Basis::kCarriedDown, symbol.family, symbol.index}] = 1;
    } else if (up_.count(symbol.family)) {
      form[{Basis::kCarriedUp, symbol.family, symbol.index}] = 1;
    } else {
      for (const auto& [basis, coefficient] : inner) {
        add(form, basis, slope(number, basis, coefficient));
      }
    }
  }
  known_[number] = form;
  return form;
}

// The coefficient of a definition's change. Functions and roots in it get names; the slope of a force
// apart is apart. Of several components each coefficient has a name, lest sums be multiplied out.
ex Linearisation::slope(int number, const Basis& basis, const ex& coefficient) {
  const Symbol symbol = definitions_[number];
  if (components() > 1) return one_name(slope_family(symbol, basis), symbol.index, coefficient);
  if (chain_.is_effect_force(number))
    return definitions_.define(slope_family(symbol, basis), symbol.index, coefficient);
  return definitions_.named(coefficient, symbol.family + "_slope", symbol.index);
}

// A name that is the same at every link.
std::string Linearisation::slope_family(const Symbol& symbol, const Basis& basis) const {
  const std::string by = !basis.family.empty() ? basis.family
                         : components() == 1   ? "angle"
                                               : "component_" + std::to_string(basis.component);
  if (symbol.index == kNoIndex || basis.index == symbol.index)
    return symbol.family + "_slope_by_" + by;
  return symbol.family + "_slope_by_" + by + (basis.index < symbol.index ? "_before" : "_after");
}

// The roll of a carried axis is that of the one before less turning . (change of e_{i-1} + change of e_i).
Form Linearisation::change_of_roll(int link) {
  Form form, change;
  const auto i = static_cast<std::size_t>(link);
  if (i == 0 || i >= chain_.bend_axes().size()) return form;
  if (i > 1) form[{Basis::kCarriedDown, kRoll, link - 1}] = 1;
  for (const Axis axis : chain_.axes())
    for (const std::size_t of : {i - 1, i}) {
      for (const auto& [basis, coefficient] : change_of(chain_.directions()[axis][of]))
        add(change, basis, -chain_.bend_axes()[i].turning[axis] * coefficient);
    }
  for (const auto& [basis, coefficient] : change)
    form[basis] =
        one_name(std::string(kRoll) + "_slope_by_component_" + std::to_string(basis.component) +
                     (basis.index < link ? "_before" : ""),
                 link, coefficient);
  return form;
}

// It goes along link x axis with its roll, and leans with its link.
Form Linearisation::change_of_axis(int number, int link, Axis component) {
  Form change, form;
  if (weights_.position.is_zero()) return form;
  const auto i = static_cast<std::size_t>(link);
  const Chain::CarriedAxis& carried = chain_.bend_axes()[i];
  add(change, {Basis::kCarriedDown, kRoll, link}, carried.crossing[component]);
  for (const Axis axis : chain_.axes())
    for (const auto& [basis, coefficient] : change_of(chain_.directions()[axis][i]))
      add(change, basis, -chain_.directions()[component][i] * carried.axis[axis] * coefficient);
  for (const auto& [basis, coefficient] : change) form[basis] = slope(number, basis, coefficient);
  return form;
}

// delta z = cv (f' u + df/dz delta z), f' the change of the rate f with z held.
Form Linearisation::change_of_state(int number) {
  if (weights_.velocity.is_zero()) return {};
  const Basis itself{Basis::kPerturbation, "", -1};
  // Within a rate, other definitions depend on z than outside.
  std::map<int, Form> outside{{number, {{itself, 1}}}};
  known_.swap(outside);
  Form rate = change_of(state_rates_.at(number));
  known_.swap(outside);
  const Symbol symbol = definitions_[number];
  const ex slope = rate.count(itself) ? rate.at(itself) : ex(0);
  rate.erase(itself);
  const ex gain = definitions_.define(symbol.family + "_gain", symbol.index,
                                      weights_.velocity / (1 - weights_.velocity * slope));
  Form form;
  for (const auto& [basis, coefficient] : rate) {
    add(form, basis,
        gain * definitions_.named(coefficient, symbol.family + "_rate_slope", symbol.index));
  }
  return form;
}

}  // namespace catena
