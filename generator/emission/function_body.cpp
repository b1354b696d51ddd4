// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/function_body.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace catena {

using GiNaC::ex;

namespace {

// A statement: a definition or an output.
struct Item {
  std::string family;  // of an output: before + after
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

// Where to break: before the last sum in reach outside brackets, or else the last product.
size_t break_of(const std::string& text, size_t from, size_t width) {
  size_t sum = std::string::npos, product = std::string::npos;
  int brackets = 0;
  for (size_t k = 0; k + 2 < width; ++k) {
    if (text[k] == '[') ++brackets;
    if (text[k] == ']') --brackets;
    if (k <= from || brackets > 0 || text[k] != ' ' || text[k + 2] != ' ') continue;
    if (text[k + 1] == '+' || text[k + 1] == '-') sum = k;
    if (text[k + 1] == '*') product = k;
  }
  return sum != std::string::npos && sum > from + width / 3 ? sum
         : product != std::string::npos                     ? product
                                                            : sum;
}

class Body {
 public:
  Body(const Definitions& definitions, const std::vector<Output>& outputs,
       const InputDeclarations& inputs, Layout layout, Language language)
      : definitions_(definitions),
        outputs_(outputs),
        inputs_(inputs),
        layout_(layout),
        language_(language),
        scalar_(language == Language::kC ? "double" : "T"),
        differential_(language == Language::kC ? "double" : "D") {
    collect();
    for (const auto& [family, input] : inputs) result_.along = result_.along || input.along;
  }

  FunctionBody straight() {
    declare_inputs();
    std::vector<const Item*> items;
    for (const Family& family : families_) {
      for (const auto& [index, item] : family.items) items.push_back(&item);
    }
    std::stable_sort(items.begin(), items.end(), [](const Item* a, const Item* b) {
      if ((a->output == nullptr) != (b->output == nullptr)) return a->output == nullptr;
      return a->output == nullptr ? a->number < b->number : a->output < b->output;
    });
    const SymbolText text = [&](int number) {
      const Symbol& symbol = definitions_[number];
      if (given(symbol)) return input_text(symbol, std::to_string(symbol.index + shift(symbol)));
      return symbol.index == kNoIndex ? symbol.family
                                      : symbol.family + "_" + std::to_string(symbol.index);
    };
    for (const Item* item : items) {
      line(statement(*item, std::to_string(item->index), text, true), 1);
      ++result_.statements;
    }
    return std::move(result_);
  }

  FunctionBody loops() {
    declare_inputs();
    schedule();
    for (const Sweep& sweep : sweeps_) write_sweep(sweep);
    return std::move(result_);
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
      if (given(symbol) ? inputs_.at(symbol.family).along : along(symbol.value))
        along_.insert(number);
    }
    std::map<std::string, size_t> position;
    const auto family_of = [&](const std::string& name) -> Family& {
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
      family_of(symbol.family).items[symbol.index] = {symbol.family, symbol.index, symbol.value,
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
      const std::string name = "=" + output.before + output.after;
      Family& family = family_of(name);
      family.is_output = true;
      family.items[output.index] = {name, output.index, output.value, -1, &output};
    }
    for (Family& family : families_) {
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
    for (Family& family : families_) {
      for (const auto& [index, item] : family.items)
        family.along = family.along || along(item.value);
    }
    position_ = std::move(position);
  }

  bool along(const ex& value) {
    const auto symbols = definitions_.symbols_of(value);
    return std::any_of(symbols.begin(), symbols.end(),
                       [&](int number) { return along_.count(number) > 0; });
  }

  const std::string& type_of(const Family& family) const {
    return family.along ? differential_ : scalar_;
  }

  // Inputs, and what a declaration brings in ready-made (sines and cosines).
  bool given(const Symbol& symbol) const { return inputs_.count(symbol.family) > 0; }

  // ---- sweeps ---------------------------------------------------------------------------------

  bool done(const std::string& family) const { return families_[position_.at(family)].sweep >= 0; }

  bool ready(const Family& family) const {
    return std::all_of(family.dependencies.begin(), family.dependencies.end(),
                       [&](const Dependency& d) { return done(d.family); });
  }

  std::vector<size_t> sweep_in(int direction) const {
    std::vector<size_t> included;
    std::set<std::string> names;
    for (bool grown = true; grown;) {
      grown = false;
      for (size_t k = 0; k < families_.size(); ++k) {
        const Family& family = families_[k];
        if (family.sweep >= 0 || names.count(family.name) || family.items.count(kNoIndex)) continue;
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
      const auto forward = sweep_in(1), backward = sweep_in(-1);
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

  // ---- text -----------------------------------------------------------------------------------

  void line(const std::string& text, int depth) {
    result_.text += std::string(static_cast<size_t>(2 * depth), ' ') + text + "\n";
  }

  void declare_inputs() {
    // Sines and cosines are brought in by one and the same declaration.
    std::set<std::string> written;
    for (const auto& [rank, family] : used_inputs_) {
      std::string statements = inputs_.at(family).text;
      if (statements.empty() || !written.insert(statements).second) continue;
      statements += "\n";
      indented(statements, 1);
    }
  }

  // Arrays of inputs count from 0 in C; in C++ FromOne lets them count from 1, as links do.
  int shift(const Symbol& symbol) const {
    return language_ == Language::kC && symbol.is_input ? -1 : 0;
  }

  static std::string input_text(const Symbol& symbol, const std::string& index) {
    return symbol.index == kNoIndex ? symbol.family : symbol.family + "[" + index + "]";
  }

  std::string statement(const Item& item, const std::string& index, const SymbolText& text,
                        bool straight) {
    const auto value = [&] {
      const std::string plain = expression_text(definitions_, item.value, item.index, text,
                                                language_, &result_.operations);
      // In a function of differentials what depends on none is a constant, mostly zero.
      const bool constant = item.output != nullptr && result_.along && !along(item.value);
      return constant && language_ == Language::kCpp ? differential_ + "(" + plain + ")" : plain;
    };
    if (item.output != nullptr) {
      std::string place = item.output->before;
      if (item.index != kNoIndex) {
        const int shift = item.output->shift;
        const bool number = std::isdigit(static_cast<unsigned char>(index[0])) != 0;
        if (number) {
          place += std::to_string(std::stoi(index) + shift);
        } else {
          place += index + (shift == 0  ? ""
                            : shift > 0 ? " + " + std::to_string(shift)
                                        : " - " + std::to_string(-shift));
        }
      }
      return place + item.output->after + " = " + value() + ";";
    }
    const Symbol& symbol = definitions_[item.number];
    const Family& family = families_[position_.at(item.family)];
    std::string name = symbol.family;
    if (symbol.index != kNoIndex) {
      if (straight) {
        name += "_" + index;
      } else if (!family.local && !family.carried) {
        return name + "[" + index + "] = " + value() + ";";
      }
    }
    return "const " + type_of(family) + " " + name + " = " + value() + ";";
  }

  // Statements of one link; `index` is the text of its number ("i" or digits).
  std::string link_text(const Sweep& sweep, int link, const std::string& index) {
    const SymbolText text = [&](int number) {
      const Symbol& symbol = definitions_[number];
      std::string at = index;
      const int offset = symbol.index - link + shift(symbol);
      if (symbol.index == kNoIndex) {
        // of no link
      } else if (index != "i") {
        at = std::to_string(symbol.index + shift(symbol));
      } else if (offset != 0) {
        at += (offset > 0 ? " + " : " - ") + std::to_string(std::abs(offset));
      }
      if (given(symbol)) return input_text(symbol, at);
      if (symbol.index == kNoIndex) return symbol.family;
      const Family& family = families_[position_.at(symbol.family)];
      if (family.carried) {
        const bool here = symbol.index == link && sweep.has(position_.at(symbol.family));
        return symbol.family + (here ? "" : "_last");
      }
      return family.local ? symbol.family : symbol.family + "[" + at + "]";
    };
    std::string statements;
    for (const size_t k : sweep.families) {
      const auto item = families_[k].items.find(link);
      if (item == families_[k].items.end()) continue;
      statements += statement(item->second, index, text, false) + "\n";
    }
    for (const size_t k : sweep.families) {
      const Family& family = families_[k];
      if (family.carried && family.items.count(link))
        statements += family.name + "_last = " + family.name + ";\n";
    }
    return statements;
  }

  void indented(const std::string& statements, int depth) {
    size_t begin = 0;
    while (begin < statements.size()) {
      const size_t end = statements.find('\n', begin);
      line(statements.substr(begin, end - begin), depth);
      ++result_.statements;
      begin = end + 1;
    }
  }

  void write_sweep(const Sweep& sweep) {
    if (sweep.direction == 0) {
      indented(link_text(sweep, kNoIndex, ""), 1);
      return;
    }
    int first = 1'000'000, last = -1;
    for (const size_t k : sweep.families) {
      const Family& family = families_[k];
      first = std::min(first, family.items.begin()->first);
      last = std::max(last, family.items.rbegin()->first);
      if (family.carried) {
        line(type_of(family) + " " + family.name + "_last;", 1);
      } else if (!family.is_output && !family.local) {
        line(type_of(family) + " " + family.name + "[" +
                 std::to_string(family.items.rbegin()->first + 1) + "];",
             1);
      }
    }
    bool any_local = false;
    for (const size_t k : sweep.families) {
      any_local =
          any_local || families_[k].carried || (!families_[k].is_output && families_[k].local);
    }
    const int step = sweep.direction;
    for (int link = step > 0 ? first : last; link >= first && link <= last;) {
      const std::string text = counted(sweep, link, "i");
      int end = link + step;
      while (end >= first && end <= last && uncounted(sweep, end, "i") == text) end += step;
      const int run = std::abs(end - link);
      if (run >= 3) {
        const std::string start = std::to_string(link), stop = std::to_string(end - step);
        line(step > 0 ? "for (int i = " + start + "; i <= " + stop + "; ++i) {"
                      : "for (int i = " + start + "; i >= " + stop + "; --i) {",
             1);
        indented(text, 2);
        line("}", 1);
        result_.operations += times(last_count_, run - 1);
      } else {
        for (int k = link; k != end; k += step) {
          const std::string one = k == link ? uncounted(sweep, k, std::to_string(k))
                                            : counted(sweep, k, std::to_string(k));
          if (one.empty()) continue;
          if (any_local) line("{", 1);
          indented(one, any_local ? 2 : 1);
          if (any_local) line("}", 1);
        }
      }
      link = end;
    }
  }

  std::string counted(const Sweep& sweep, int link, const std::string& index) {
    const OperationCount before = result_.operations;
    std::string text = link_text(sweep, link, index);
    last_count_ = result_.operations;
    last_count_ += times(before, -1);
    return text;
  }

  std::string uncounted(const Sweep& sweep, int link, const std::string& index) {
    const OperationCount before = result_.operations;
    std::string text = link_text(sweep, link, index);
    result_.operations = before;
    return text;
  }

  static OperationCount times(OperationCount count, long factor) {
    return {count.additions * factor, count.multiplications * factor, count.divisions * factor,
            count.functions * factor};
  }

  static constexpr int kUnrelated = 1'000'000;

  const Definitions& definitions_;
  const std::vector<Output>& outputs_;
  const InputDeclarations& inputs_;
  Layout layout_;
  Language language_;
  std::string scalar_, differential_;  // types
  std::vector<Family> families_;
  std::map<std::string, size_t> position_;
  std::set<std::pair<int, std::string>> used_inputs_;
  std::set<int> along_;  // symbols that depend on a differential
  std::vector<Sweep> sweeps_;
  FunctionBody result_;
  OperationCount last_count_;
};

}  // namespace

std::string page_text(const std::string& statements) {
  constexpr size_t kWidth = 100;
  std::string page;
  for (size_t begin = 0; begin < statements.size();) {
    const size_t end = statements.find('\n', begin);
    std::string rest = statements.substr(begin, end - begin);
    const std::string indent(rest.find_first_not_of(' ') + 4, ' ');
    while (rest.size() > kWidth) {
      const size_t at = break_of(rest, indent.size(), kWidth);
      if (at == std::string::npos) break;
      page += rest.substr(0, at) + "\n";
      rest = indent + rest.substr(at + 1);
    }
    page += rest + "\n";
    begin = end + 1;
  }
  return page;
}

FunctionBody function_body(const Definitions& definitions, const std::vector<Output>& outputs,
                           const InputDeclarations& inputs, Layout layout, Language language) {
  Body body(definitions, outputs, inputs, layout, language);
  return layout == Layout::kStraight ? body.straight() : body.loops();
}

}  // namespace catena
