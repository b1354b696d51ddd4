// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/families.hpp"

#include <algorithm>
#include <stdexcept>

namespace catena {

using GiNaC::ex;

namespace {

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

bool is_differential(const std::optional<Input>& input) {
  return input && input->type == Type::kDifferential;
}

}  // namespace

Families::Families(const Definitions& definitions, const std::vector<Output>& outputs,
                   const Inputs& inputs)
    : definitions_(definitions), inputs_(inputs) {
  std::set<int> needed;
  std::vector<int> open;
  const auto need = [&](const ex& value) {
    for (const int number : definitions_.symbols_of(value)) {
      if (needed.insert(number).second) open.push_back(number);
    }
  };
  for (const Output& output : outputs) need(output.value);
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
    const auto [found, is_new] = position.emplace(name, all.size());
    if (is_new) {
      all.emplace_back();
      all.back().name = name;
    }
    return all[found->second];
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
  std::stable_sort(all.begin(), all.end(), [&](const Family& a, const Family& b) {
    return definitions_[a.items.begin()->second.number].family_rank <
           definitions_[b.items.begin()->second.number].family_rank;
  });
  position.clear();
  for (size_t k = 0; k < all.size(); ++k) position[all[k].name] = k;
  for (const Output& output : outputs) {
    const std::string name = family_of(output);
    Family& family = family_named(name);
    family.is_output = true;
    family.items[output.index] = {name, output.index, output.value, -1, &output};
  }
  for (Family& family : all) depend(family);
  for (Family& family : all) {
    for (const auto& [index, item] : family.items) family.along = family.along || along(item.value);
  }
  position_ = std::move(position);
}

void Families::add(Family family) {
  position_[family.name] = all.size();
  all.push_back(std::move(family));
}

void Families::depend(Family& family) const {
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

bool Families::along(const ex& value) const {
  const auto symbols = definitions_.symbols_of(value);
  return std::any_of(symbols.begin(), symbols.end(),
                     [&](int number) { return along_.count(number) > 0; });
}

bool Families::has_differentials() const {
  return std::any_of(inputs_.begin(), inputs_.end(),
                     [](const auto& each) { return is_differential(each.second); });
}

}  // namespace catena
