// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/function_body.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "generator/emission/polynomial.hpp"

namespace catena {

using GiNaC::ex;

namespace {

// A statement: a definition or an output.
struct Item {
  std::string family;  // of an output: that of its array
  int index;
  ex value;
  int number = -1;  // of a definition
  const Output* output = nullptr;
};

struct Dependency {
  std::string family;
  int offset;
  auto operator<=>(const Dependency&) const = default;
};

struct Family {
  std::string name;
  std::map<int, Item> items;          // by index
  std::set<Dependency> dependencies;  // on other definitions; inputs are left out
  bool is_output = false;
  bool along = false;  // depends on a differential
  int sweep = -1;
  std::string adds_to;   // the family whose values this one adds to; empty: it has its own
  std::set<int> guard;   // switches of which one must be on; empty: always computed
  bool zero = false;     // read where it was not computed
  bool local = true;     // read only at the same link in the same sweep
  bool carried = false;  // or at the one before, and elsewhere at the sweep's last: see carry()
};

struct Sweep {
  int direction;  // +1 towards the tip, -1 towards the support, 0: not over links
  std::vector<size_t> families;

  bool has(size_t family) const {
    return std::find(families.begin(), families.end(), family) != families.end();
  }
};

// Outputs to one part of an array are a family.
std::string family_of(const Output& output) {
  const Array& array = output.array;
  std::string name = "=" + array.owner + "." + array.name;
  if (array.row) name += "[" + std::to_string(*array.row) + "]";
  if (output.place) {
    const ArrayPlace& place = *output.place;
    name += "[" + std::to_string((place.of_link ? place.base : place.at).constant) + "]";
  }
  return name;
}

class Body {
 public:
  Body(const Definitions& definitions, const std::vector<Output>& outputs, const Inputs& inputs,
       Layout layout, std::vector<Switch> switches)
      : definitions_(definitions),
        outputs_(outputs),
        inputs_(inputs),
        layout_(layout),
        switches_(std::move(switches)) {
    collect();
    if (!switches_.empty()) guard();
    for (const auto& [family, input] : inputs)
      has_differentials_ = has_differentials_ || is_differential(input);
  }

  Statements straight() {
    declare_inputs();
    std::vector<const Item*> items;
    for (const Family& family : families_) {
      for (const auto& [index, item] : family.items) items.push_back(&item);
    }
    std::stable_sort(items.begin(), items.end(), [](const Item* a, const Item* b) {
      if ((a->output == nullptr) != (b->output == nullptr)) return a->output == nullptr;
      return a->output == nullptr ? a->number < b->number : a->output < b->output;
    });
    const auto name_of = [](const Symbol& symbol) {
      return symbol.index == kNoIndex ? symbol.family
                                      : symbol.family + "_" + std::to_string(symbol.index);
    };
    const ReadSymbol read = [&](int number) -> Read {
      const Symbol& symbol = definitions_[number];
      if (!given(symbol)) return {name_of(symbol), {}};
      std::optional<ArrayPlace> place;
      if (symbol.index != kNoIndex) place = {{}, false, symbol.index};
      return entry(symbol, place);
    };
    for (const Item* item : items) {
      Sum value = polynomial(definitions_, item->value, item->index, read);
      if (item->output != nullptr) {
        body_.push_back(at_link(assignment(*item, std::move(value)), item->index));
      } else {
        body_.push_back(
            NamedValue{type_of(*item), name_of(definitions_[item->number]), std::move(value)});
      }
    }
    return std::move(body_);
  }

  Statements loops() {
    declare_inputs();
    schedule();
    for (const Sweep& sweep : sweeps_) write_sweep(sweep);
    return std::move(body_);
  }

 private:
  void collect() {
    std::set<int> needed;
    std::vector<int> open;
    const auto need = [&](const ex& value) {
      for (const int number : definitions_.symbols_of(value)) {
        if (needed.insert(number).second) open.push_back(number);
      }
    };
    for (const Output& output : outputs_) need(output.value);
    while (!open.empty()) {
      const int number = open.back();
      open.pop_back();
      if (!given(definitions_[number])) need(definitions_[number].value);
    }
    for (const int number : needed) {  // a symbol's number is larger than those its value reads
      const Symbol& symbol = definitions_[number];
      if (given(symbol) ? is_differential(inputs_.at(symbol.family)) : along(symbol.value))
        along_.insert(number);
    }
    std::map<std::string, size_t> position;
    const auto family_named = [&](const std::string& name) -> Family& {
      const auto [found, is_new] = position.emplace(name, families_.size());
      if (is_new) {
        families_.emplace_back();
        families_.back().name = name;
      }
      return families_[found->second];
    };
    for (const int number : needed) {
      const Symbol& symbol = definitions_[number];
      if (given(symbol)) {
        used_inputs_.insert({symbol.family_rank, symbol.family});
        continue;
      }
      // A definition of no link is a family of its own.
      family_named(symbol.family).items[symbol.index] = {symbol.family, symbol.index, symbol.value,
                                                         number, nullptr};
    }
    // Families in the order of their first appearance in the derivation.
    std::stable_sort(families_.begin(), families_.end(), [&](const Family& a, const Family& b) {
      return definitions_[a.items.begin()->second.number].family_rank <
             definitions_[b.items.begin()->second.number].family_rank;
    });
    position.clear();
    for (size_t k = 0; k < families_.size(); ++k) position[families_[k].name] = k;
    for (const Output& output : outputs_) {
      const std::string name = family_of(output);
      Family& family = family_named(name);
      family.is_output = true;
      family.items[output.index] = {name, output.index, output.value, -1, &output};
    }
    for (Family& family : families_) depend(family);
    for (Family& family : families_) {
      for (const auto& [index, item] : family.items)
        family.along = family.along || along(item.value);
    }
    position_ = std::move(position);
  }

  void depend(Family& family) const {
    for (const auto& [index, item] : family.items) {
      for (const int number : definitions_.symbols_of(item.value)) {
        const Symbol& symbol = definitions_[number];
        if (symbol.is_input && !given(symbol)) {
          throw std::logic_error("input not declared: " + symbol.family);
        }
        if (given(symbol)) continue;
        const bool relative = index != kNoIndex && symbol.index != kNoIndex;
        family.dependencies.insert({symbol.family, relative ? symbol.index - index : kUnrelated});
      }
    }
  }

  // ---- switches -------------------------------------------------------------------------------

  // The switch of an input; -1: it has none.
  int switch_of(const std::string& family) const {
    const std::string plain = family.starts_with("d_") ? family.substr(2) : family;
    for (size_t k = 0; k < switches_.size(); ++k)
      if (switches_[k].families.contains(plain)) return static_cast<int>(k);
    return -1;
  }

  static std::vector<ex> products_of(const ex& sum) {
    if (!GiNaC::is_a<GiNaC::add>(sum)) return {sum};
    return {sum.begin(), sum.end()};
  }

  // The switches of which one must be on for a product not to be zero; empty: it needs none.
  std::set<int> product_needs(const ex& product) const {
    std::set<int> fewest;
    const auto factor = [&](const ex& f) {
      if (!GiNaC::is_a<GiNaC::symbol>(f)) return;
      const auto found = needs_.find(definitions_.number_of(f));
      if (found != needs_.end() && (fewest.empty() || found->second.size() < fewest.size()))
        fewest = found->second;
    };
    const auto power = [&](const ex& f) {
      if (!GiNaC::is_a<GiNaC::power>(f))
        factor(f);
      else if (f.op(1).info(GiNaC::info_flags::posint))
        factor(f.op(0));
    };
    if (GiNaC::is_a<GiNaC::mul>(product))
      for (const ex& f : product) power(f);
    else
      power(product);
    return fewest;
  }

  // The same for a sum.
  std::set<int> needs(const ex& sum) const {
    std::set<int> all;
    for (const ex& product : products_of(sum)) {
      const std::set<int> one = product_needs(product);
      if (one.empty()) return {};
      all.insert(one.begin(), one.end());
    }
    return all;
  }

  // Finds which families matter only where a switch is on.
  void guard() {
    std::vector<const Item*> items;  // in the order of their numbers, outputs last
    for (const Family& family : families_)
      for (const auto& [index, item] : family.items) items.push_back(&item);
    std::stable_sort(items.begin(), items.end(), [](const Item* a, const Item* b) {
      return static_cast<unsigned>(a->number) < static_cast<unsigned>(b->number);
    });
    for (const Item* item : items) {
      for (const int number : definitions_.symbols_of(item->value)) {
        const Symbol& symbol = definitions_[number];
        if (const int k = switch_of(symbol.family); given(symbol) && k >= 0) needs_[number] = {k};
      }
    }
    for (const Item* item : items) {
      if (item->output != nullptr) continue;
      if (std::set<int> needs = this->needs(item->value); !needs.empty())
        needs_[item->number] = std::move(needs);
    }
    // From the outputs back: a product that is zero asks for none of its factors.
    std::map<int, std::set<int>> guards;
    std::set<int> always;
    for (auto it = items.rbegin(); it != items.rend(); ++it) {
      const Item& item = **it;
      const bool is_always = item.output != nullptr || always.contains(item.number);
      for (const ex& product : products_of(item.value)) {
        const std::set<int> asked = product_needs(product);
        for (const int number : definitions_.symbols_of(product)) {
          if (!asked.empty())
            guards[number].insert(asked.begin(), asked.end());
          else if (is_always)
            always.insert(number);
          else
            guards[number].insert(guards[item.number].begin(), guards[item.number].end());
        }
      }
    }
    for (Family& family : families_) {
      bool is_always = family.is_output;
      for (const auto& [index, item] : family.items) {
        is_always = is_always || always.contains(item.number);
        family.guard.insert(guards[item.number].begin(), guards[item.number].end());
      }
      if (is_always) family.guard.clear();
    }
    split();
    for (const Family& reader : families_)
      for (const Dependency& d : reader.dependencies) {
        Family& read = families_[position_.at(d.family)];
        const bool only_there =
            !reader.guard.empty() && std::includes(read.guard.begin(), read.guard.end(),
                                                   reader.guard.begin(), reader.guard.end());
        if (!read.guard.empty() && !only_there) read.zero = true;
      }
  }

  // What a family adds up only where a switch is on becomes a family of its own, which adds it.
  void split() {
    const size_t count = families_.size();
    for (size_t k = 0; k < count; ++k) {
      const std::string name = families_[k].name;
      const bool chained =
          std::any_of(families_[k].dependencies.begin(), families_[k].dependencies.end(),
                      [&](const Dependency& d) { return d.family == name; });
      if (chained) continue;
      std::map<std::set<int>, Family> parts;
      for (auto& [index, item] : families_[k].items) {
        ex rest = 0;
        std::map<std::set<int>, ex> sums;
        for (const ex& product : products_of(item.value)) {
          const std::set<int> needs = product_needs(product);
          const std::set<int>& guard = families_[k].guard;
          const bool apart = !needs.empty() && needs != guard &&
                             (guard.empty() || std::includes(guard.begin(), guard.end(),
                                                             needs.begin(), needs.end()));
          (apart ? sums[needs] : rest) += product;
        }
        item.value = rest;
        for (auto& [needs, sum] : sums) {
          Item& part = parts[needs].items[index];
          part = item;
          part.value = sum;
        }
      }
      if (parts.empty()) continue;
      families_[k].dependencies.clear();
      depend(families_[k]);
      for (auto& [needs, part] : parts) {
        part.name = name + "+" + std::to_string(families_.size());
        part.adds_to = name;
        part.guard = needs;
        part.is_output = true;
        part.dependencies.insert({name, 0});
        depend(part);
        adding_[name].push_back(part.name);
        position_[part.name] = families_.size();
        families_.push_back(std::move(part));
      }
    }
    // Who reads a sum reads all of it.
    for (Family& family : families_) {
      const std::set<Dependency> direct = family.dependencies;
      for (const Dependency& d : direct) {
        if (d.family == family.adds_to) continue;
        if (const auto found = adding_.find(d.family); found != adding_.end())
          for (const std::string& part : found->second)
            family.dependencies.insert({part, d.offset});
      }
    }
  }

  // The inputs of a guard that this function has.
  std::vector<std::string> numbers_of(const std::set<int>& guard) const {
    std::vector<std::string> names;
    for (const auto& [rank, family] : used_inputs_)
      if (guard.contains(switch_of(family))) names.push_back(family);
    return names;
  }

  bool along(const ex& value) {
    const auto symbols = definitions_.symbols_of(value);
    return std::any_of(symbols.begin(), symbols.end(),
                       [&](int number) { return along_.count(number) > 0; });
  }

  static bool is_differential(const std::optional<Input>& input) {
    return input && input->type == Type::kDifferential;
  }

  static Type type_of(const Family& family) {
    return family.along ? Type::kDifferential : Type::kScalar;
  }
  Type type_of(const Item& item) const { return type_of(families_[position_.at(item.family)]); }

  // Inputs, and what a declaration brings in ready-made (sines and cosines).
  bool given(const Symbol& symbol) const { return inputs_.count(symbol.family) > 0; }

  // ---- sweeps ---------------------------------------------------------------------------------

  bool done(const std::string& family) const { return families_[position_.at(family)].sweep >= 0; }

  bool ready(const Family& family) const {
    return std::all_of(family.dependencies.begin(), family.dependencies.end(),
                       [&](const Dependency& d) { return done(d.family); });
  }

  std::vector<size_t> sweep_in(int direction, const std::set<int>& guard) const {
    std::vector<size_t> included;
    std::set<std::string> names;
    for (bool grown = true; grown;) {
      grown = false;
      for (size_t k = 0; k < families_.size(); ++k) {
        const Family& family = families_[k];
        if (family.sweep >= 0 || names.count(family.name) || family.items.count(kNoIndex) ||
            family.guard != guard)
          continue;
        const bool fits = std::all_of(
            family.dependencies.begin(), family.dependencies.end(), [&](const Dependency& d) {
              if (done(d.family)) return true;
              if (d.offset == kUnrelated) return false;
              const bool before = d.offset * direction < 0;
              if (d.family == family.name) return before;
              return names.count(d.family) > 0 && (before || d.offset == 0);
            });
        if (!fits) continue;
        included.push_back(k);
        names.insert(family.name);
        grown = true;
      }
    }
    return included;
  }

  void add_sweep(int direction, std::vector<size_t> members) {
    for (const size_t k : members) families_[k].sweep = static_cast<int>(sweeps_.size());
    sweeps_.push_back({direction, std::move(members)});
  }

  // A sweep as up to three: what needs no neighbour's result, what does, and what follows from
  // that. Only the middle one has to go link by link; of the others, upwards in memory, the
  // compiler makes vectors.
  void add_sweeps(int direction, const std::vector<size_t>& members) {
    std::map<size_t, std::set<size_t>> needs;  // within the sweep, directly or not
    for (const size_t k : members) {
      std::vector<size_t> open{k};
      while (!open.empty()) {
        const Family& family = families_[open.back()];
        open.pop_back();
        for (const Dependency& d : family.dependencies) {
          const size_t read = position_.at(d.family);
          if (families_[read].sweep < 0 && needs[k].insert(read).second) open.push_back(read);
        }
      }
    }
    std::set<size_t> chained;  // needs itself, of the link before
    for (const size_t k : members) {
      if (needs[k].count(k)) chained.insert(k);
    }
    std::vector<size_t> before, between, after;
    for (const size_t k : members) {
      const auto leads_to = [&](size_t other) { return needs[other].count(k) > 0; };
      const auto comes_of = [&](size_t other) { return needs[k].count(other) > 0; };
      if (std::none_of(chained.begin(), chained.end(), comes_of)) {
        before.push_back(k);
      } else if (std::any_of(chained.begin(), chained.end(), leads_to)) {
        between.push_back(k);
      } else {
        after.push_back(k);
      }
    }
    for (const auto& part : {before, between, after}) {
      if (!part.empty()) add_sweep(in_any_order(part) ? 1 : direction, part);
    }
  }

  // Whether no family of a sweep reads another's neighbour.
  bool in_any_order(const std::vector<size_t>& members) const {
    return std::all_of(members.begin(), members.end(), [&](size_t k) {
      return std::all_of(families_[k].dependencies.begin(), families_[k].dependencies.end(),
                         [&](const Dependency& d) { return d.offset == 0 || done(d.family); });
    });
  }

  // Of the families that have no sweep yet; what is always computed first.
  std::set<std::set<int>> open_guards() const {
    std::set<std::set<int>> guards;
    for (const Family& family : families_)
      if (family.sweep < 0) guards.insert(family.guard);
    return guards;
  }

  void schedule() {
    for (;;) {
      bool open = false, alone = false;
      for (size_t k = 0; k < families_.size(); ++k) {
        if (families_[k].sweep >= 0) continue;
        open = true;
        if (families_[k].items.count(kNoIndex) && ready(families_[k])) {
          add_sweep(0, {k});
          alone = true;
        }
      }
      if (!open) break;
      if (alone) continue;
      std::vector<size_t> forward, backward;
      for (const std::set<int>& guard : open_guards()) {
        forward = sweep_in(1, guard);
        backward = sweep_in(-1, guard);
        if (!forward.empty() || !backward.empty()) break;
      }
      if (forward.empty() && backward.empty()) throw std::logic_error("no order of statements");
      const int direction = forward.size() >= backward.size() ? 1 : -1;
      const auto& members = direction > 0 ? forward : backward;
      if (layout_ == Layout::kWholeSweeps) {
        add_sweep(direction, members);
      } else {
        add_sweeps(direction, members);
      }
    }
    for (const Family& family : families_) {
      for (const Dependency& d : family.dependencies) {
        Family& read = families_[position_.at(d.family)];
        if (d.offset != 0 || read.sweep != family.sweep) read.local = false;
      }
    }
    if (layout_ == Layout::kWholeSweeps) carry();
  }

  // What is read at the same link and the one before, and after the sweep at its last link, needs
  // no array: `name` and `name_last` do.
  void carry() {
    std::set<size_t> stored;
    for (const Family& reader : families_) {
      for (const auto& [index, item] : reader.items) {
        for (const int number : definitions_.symbols_of(item.value)) {
          const Symbol& symbol = definitions_[number];
          if (given(symbol)) continue;
          const size_t k = position_.at(symbol.family);
          const Family& family = families_[k];
          const int direction = sweeps_[static_cast<size_t>(family.sweep)].direction;
          const int last =
              direction > 0 ? family.items.rbegin()->first : family.items.begin()->first;
          const bool near = reader.sweep == family.sweep
                                ? symbol.index == index || symbol.index == index - direction
                                : symbol.index == last;
          if (direction == 0 || !near) stored.insert(k);
        }
      }
    }
    for (size_t k = 0; k < families_.size(); ++k)
      families_[k].carried = !families_[k].is_output && !families_[k].local && !stored.count(k);
  }

  // ---- statements -----------------------------------------------------------------------------

  void declare_inputs() {
    std::set<std::string> declared;  // sines and cosines are brought in together
    for (const auto& [rank, family] : used_inputs_) {
      const std::optional<Input>& input = inputs_.at(family);
      if (input && declared.insert(input->name).second) body_.push_back(*input);
    }
  }

  // Of a symbol that is given.
  Read entry(const Symbol& symbol, std::optional<ArrayPlace> place) const {
    const std::optional<Input>& input = inputs_.at(symbol.family);
    return {symbol.family, std::move(place), input && input->kind == InputKind::kArray};
  }

  Assignment assignment(const Item& item, Sum value, bool adds = false) {
    // In a function of differentials what depends on none is a constant, mostly zero.
    return {item.output->array, item.output->place, std::move(value),
            has_differentials_ && !along(item.value), adds};
  }

  // Whether a family without an index is more than a name for one value.
  bool is_changed(const Family& family) const {
    return !family.guard.empty() || adding_.contains(family.name);
  }

  static Statement at_link(Statement statement, int link) {
    if (link == kNoIndex) return statement;
    return std::move(at_step({std::move(statement)}, link).front());
  }

  // The statement of an item of a sweep, relative to its link.
  Statement statement(const Item& item, const ReadSymbol& read, bool adds) {
    Sum value = polynomial(definitions_, item.value, item.index, read);
    if (item.output != nullptr) return assignment(item, std::move(value), adds);
    const Family& family = families_[position_.at(item.family)];
    if (item.index != kNoIndex && !family.local && !family.carried)
      return Assignment{{"", family.name, {}},
                        ArrayPlace{{}, true, 0},
                        std::move(value),
                        family.along && !along(item.value),
                        adds};
    if (item.index == kNoIndex && is_changed(family))
      return Assignment{
          {"", family.name, {}}, {}, std::move(value), family.along && !along(item.value), adds};
    return NamedValue{type_of(family), family.name, std::move(value)};
  }

  // Statements of one link, relative to it.
  Statements of_link(const Sweep& sweep, int link) {
    const ReadSymbol read = [&](int number) -> Read {
      const Symbol& symbol = definitions_[number];
      std::optional<ArrayPlace> place;
      if (symbol.index != kNoIndex && link != kNoIndex) place = {{}, true, symbol.index - link};
      if (symbol.index != kNoIndex && link == kNoIndex) place = {{}, false, symbol.index};
      if (given(symbol)) return entry(symbol, place);
      if (symbol.index == kNoIndex) return {symbol.family, {}};
      const Family& family = families_[position_.at(symbol.family)];
      if (family.carried) {
        const bool here = symbol.index == link && sweep.has(position_.at(symbol.family));
        return {symbol.family + (here ? "" : "_last"), {}};
      }
      if (family.local) return {symbol.family, {}};
      return {symbol.family, place};
    };
    Statements statements;
    for (const size_t k : sweep.families) {
      const auto item = families_[k].items.find(link);
      if (item != families_[k].items.end())
        statements.push_back(statement(item->second, read, !families_[k].adds_to.empty()));
    }
    for (const size_t k : sweep.families) {
      const Family& family = families_[k];
      if (family.carried && family.items.count(link))
        statements.push_back(Assignment{
            {"", family.name + "_last", {}}, {}, {{false, {{Read{family.name, {}}}}, {}}}});
    }
    return statements;
  }

  void write_sweep(const Sweep& sweep) {
    const std::set<int>& guard = families_[sweep.families.front()].guard;
    Statements statements;
    write_statements(sweep, guard.empty() ? body_ : statements);
    if (!guard.empty()) add_block({std::move(statements), numbers_of(guard)});
  }

  // Blocks of one guard become one; declarations go before it.
  void add_block(Block block) {
    auto declared = body_.end();
    while (declared != body_.begin() && std::holds_alternative<Variable>(*(declared - 1)))
      --declared;
    Block* last = declared == body_.begin() ? nullptr : std::get_if<Block>(&*(declared - 1));
    if (last == nullptr || last->unless_zero != block.unless_zero) {
      body_.emplace_back(std::move(block));
      return;
    }
    last->body.insert(last->body.end(), std::make_move_iterator(block.body.begin()),
                      std::make_move_iterator(block.body.end()));
    std::rotate(declared - 1, declared, body_.end());
  }

  // Declarations go to the body of the function.
  void write_statements(const Sweep& sweep, Statements& out) {
    if (sweep.direction == 0) {
      for (const size_t k : sweep.families)
        if (is_changed(families_[k]) && !families_[k].is_output)
          body_.push_back(
              Variable{type_of(families_[k]), families_[k].name, {}, families_[k].zero});
      for (Statement& one : of_link(sweep, kNoIndex)) out.push_back(std::move(one));
      return;
    }
    int first = 1'000'000, last = -1;
    bool any_local = false;
    for (const size_t k : sweep.families) {
      const Family& family = families_[k];
      const int largest = family.items.rbegin()->first;
      first = std::min(first, family.items.begin()->first);
      last = std::max(last, largest);
      if (family.carried) {
        body_.push_back(Variable{type_of(family), family.name + "_last", {}});
      } else if (!family.is_output && !family.local) {
        body_.push_back(Variable{type_of(family), family.name, largest + 1, family.zero});
      }
      any_local = any_local || family.carried || (!family.is_output && family.local);
    }
    const int step = sweep.direction;
    const int begin = step > 0 ? first : last, behind = step > 0 ? last + 1 : first - 1;
    Statements here = of_link(sweep, begin), next;
    for (int link = begin; link != behind; here = std::move(next)) {
      int end = link + step;
      for (; end != behind; end += step) {
        next = of_link(sweep, end);
        if (next != here) break;
      }
      if (std::abs(end - link) >= 3) {
        out.push_back(Loop{link, end - step, step, std::move(here)});
      } else if (!here.empty()) {
        for (int k = link; k != end; k += step) {
          Statements one = at_step(here, k);
          if (any_local) {
            out.push_back(Block{std::move(one)});
          } else {
            for (Statement& statement : one) out.push_back(std::move(statement));
          }
        }
      }
      link = end;
    }
  }

  static constexpr int kUnrelated = 1'000'000;

  const Definitions& definitions_;
  const std::vector<Output>& outputs_;
  const Inputs& inputs_;
  Layout layout_;
  std::vector<Switch> switches_;
  std::map<int, std::set<int>> needs_;  // number -> it is zero unless one of these is on
  std::map<std::string, std::vector<std::string>> adding_;  // family -> those that add to it
  bool has_differentials_ = false;
  std::vector<Family> families_;
  std::map<std::string, size_t> position_;
  std::set<std::pair<int, std::string>> used_inputs_;
  std::set<int> along_;  // symbols that depend on a differential
  std::vector<Sweep> sweeps_;
  Statements body_;
};

}  // namespace

Statements function_body(const Definitions& definitions, const std::vector<Output>& outputs,
                         const Inputs& inputs, Layout layout, const std::vector<Switch>& switches) {
  Body body(definitions, outputs, inputs, layout,
            layout == Layout::kStraight ? std::vector<Switch>{} : switches);
  return layout == Layout::kStraight ? body.straight() : body.loops();
}

}  // namespace catena
