// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/function_body.hpp"

#include <algorithm>

#include "generator/emission/families.hpp"
#include "generator/emission/guards.hpp"
#include "generator/emission/polynomial.hpp"
#include "generator/emission/sweeps.hpp"

namespace catena {
namespace {

class Body {
 public:
  Body(Families families, const std::vector<Switch>& switches)
      : families_(std::move(families)), switches_(switches) {
    guard_families(families_, switches_);
    for (const Family& family : families_.all)
      if (!family.adds_to.empty()) added_to_.insert(family.adds_to);
  }

  Statements straight() {
    declare_inputs();
    std::vector<const Item*> items;
    for (const Family& family : families_.all) {
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
      const Symbol& symbol = families_.definitions()[number];
      if (!families_.given(symbol)) return {name_of(symbol), {}};
      std::optional<ArrayPlace> place;
      if (symbol.index != kNoIndex) place = {{}, false, symbol.index};
      return entry(symbol, place);
    };
    for (const Item* item : items) {
      Sum value = polynomial(families_.definitions(), item->value, item->index, read);
      if (item->output != nullptr) {
        body_.push_back(at_link(assignment(*item, std::move(value)), item->index));
      } else {
        body_.push_back(NamedValue{type_of(*item), name_of(families_.definitions()[item->number]),
                                   std::move(value)});
      }
    }
    return std::move(body_);
  }

  Statements loops(Layout layout) {
    declare_inputs();
    for (const Sweep& sweep : schedule(families_, layout)) write_sweep(sweep);
    return std::move(body_);
  }

 private:
  static Type type_of(const Family& family) {
    return family.along ? Type::kDifferential : Type::kScalar;
  }
  Type type_of(const Item& item) const { return type_of(families_.named(item.family)); }

  void declare_inputs() {
    std::set<std::string> declared;  // sines and cosines are brought in together
    for (const auto& [rank, family] : families_.used_inputs()) {
      const std::optional<Input>& input = families_.input(family);
      if (input && declared.insert(input->name).second) body_.push_back(*input);
    }
  }

  // Of a symbol that is given.
  Read entry(const Symbol& symbol, std::optional<ArrayPlace> place) const {
    const std::optional<Input>& input = families_.input(symbol.family);
    return {symbol.family, std::move(place), input && input->kind == InputKind::kArray};
  }

  Assignment assignment(const Item& item, Sum value, bool adds = false) {
    // In a function of differentials what depends on none is a constant, mostly zero.
    return {item.output->array, item.output->place, std::move(value),
            families_.has_differentials() && !families_.along(item.value), adds};
  }

  // Whether a family without an index is more than a name for one value.
  bool is_changed(const Family& family) const {
    return !family.guard.empty() || added_to_.contains(family.name);
  }

  static Statement at_link(Statement statement, int link) {
    if (link == kNoIndex) return statement;
    return std::move(at_step({std::move(statement)}, link).front());
  }

  // The statement of an item of a sweep, relative to its link.
  Statement statement(const Item& item, const ReadSymbol& read, bool adds) {
    Sum value = polynomial(families_.definitions(), item.value, item.index, read);
    if (item.output != nullptr) return assignment(item, std::move(value), adds);
    const Family& family = families_.named(item.family);
    if (item.index != kNoIndex && !family.local && !family.carried && family.kept == nullptr)
      return Assignment{{"", family.name, {}},
                        ArrayPlace{{}, true, 0},
                        std::move(value),
                        family.along && !families_.along(item.value),
                        adds};
    if (item.index == kNoIndex && is_changed(family))
      return Assignment{{"", family.name, {}},
                        {},
                        std::move(value),
                        family.along && !families_.along(item.value),
                        adds};
    return NamedValue{type_of(family), family.name, std::move(value)};
  }

  // Statements of one link, relative to it.
  Statements of_link(const Sweep& sweep, int link) {
    const ReadSymbol read = [&](int number) -> Read {
      const Symbol& symbol = families_.definitions()[number];
      std::optional<ArrayPlace> place;
      if (symbol.index != kNoIndex && link != kNoIndex) place = {{}, true, symbol.index - link};
      if (symbol.index != kNoIndex && link == kNoIndex) place = {{}, false, symbol.index};
      if (families_.given(symbol)) return entry(symbol, place);
      if (symbol.index == kNoIndex) return {symbol.family, {}};
      const Family& family = families_.named(symbol.family);
      if (family.carried) {
        const bool here = symbol.index == link && sweep.has(families_.position(symbol.family));
        return {symbol.family + (here ? "" : "_last"), {}};
      }
      if (family.local) return {symbol.family, {}};
      if (family.kept == nullptr) return {symbol.family, place};
      if (sweep.has(families_.position(symbol.family))) return {symbol.family, {}};
      return {symbol.family, place, true};
    };
    Statements statements;
    for (const size_t k : sweep.families) {
      const auto item = families_.all[k].items.find(link);
      if (item != families_.all[k].items.end())
        statements.push_back(statement(item->second, read, !families_.all[k].adds_to.empty()));
    }
    for (const size_t k : sweep.families) {
      const Family& family = families_.all[k];
      if (family.carried && family.items.count(link))
        statements.push_back(Assignment{
            {"", family.name + "_last", {}}, {}, {{false, {{Read{family.name, {}}}}, {}}}});
    }
    return statements;
  }

  void write_sweep(const Sweep& sweep) {
    const std::set<int>& guard = families_.all[sweep.families.front()].guard;
    Statements statements;
    write_statements(sweep, guard.empty() ? body_ : statements);
    for (const size_t k : sweep.families) {
      const Family& family = families_.all[k];
      if (family.kept == nullptr) continue;
      Affine first = family.kept->place->base;
      first += family.kept->place->at;
      first += 1;
      body_.push_back(
          Input{InputKind::kArray, type_of(family), family.name, family.kept->array, first});
    }
    if (!guard.empty())
      add_block({std::move(statements), inputs_of_guard(families_, switches_, guard)});
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
        if (is_changed(families_.all[k]) && !families_.all[k].is_output)
          body_.push_back(Variable{
              type_of(families_.all[k]), families_.all[k].name, {}, families_.all[k].zero});
      for (Statement& one : of_link(sweep, kNoIndex)) out.push_back(std::move(one));
      return;
    }
    int first = 1'000'000, last = -1;
    bool any_local = false;
    for (const size_t k : sweep.families) {
      const Family& family = families_.all[k];
      const int largest = family.items.rbegin()->first;
      first = std::min(first, family.items.begin()->first);
      last = std::max(last, largest);
      if (family.carried) {
        body_.push_back(Variable{type_of(family), family.name + "_last", {}});
      } else if (!family.is_output && !family.local && family.kept == nullptr) {
        body_.push_back(Variable{type_of(family), family.name, largest + 1, family.zero});
      }
      any_local = any_local || family.carried ||
                  (!family.is_output && (family.local || family.kept != nullptr));
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

  Families families_;
  const std::vector<Switch>& switches_;
  std::set<std::string> added_to_;  // families to which others add
  Statements body_;
};

}  // namespace

Statements function_body(const Definitions& definitions, const std::vector<Output>& outputs,
                         const Inputs& inputs, Layout layout, const std::vector<Switch>& switches) {
  const std::vector<Switch> none;
  Families families(definitions, outputs, inputs);
  if (layout == Layout::kStraight) return Body(std::move(families), none).straight();
  return Body(std::move(families), switches).loops(layout);
}

}  // namespace catena
