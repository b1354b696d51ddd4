// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/guards.hpp"

#include <algorithm>
#include <map>

namespace catena {

using GiNaC::ex;

namespace {

/// The switch of an input; -1: it has none.
int switch_of(const std::vector<Switch>& switches, const std::string& family) {
  const std::string plain = family.starts_with("d_") ? family.substr(2) : family;
  for (size_t k = 0; k < switches.size(); ++k)
    if (switches[k].families.contains(plain)) return static_cast<int>(k);
  return -1;
}

std::vector<ex> products_of(const ex& sum) {
  if (!GiNaC::is_a<GiNaC::add>(sum)) return {sum};
  return {sum.begin(), sum.end()};
}

class Guards {
 public:
  Guards(Families& families, const std::vector<Switch>& switches)
      : families_(families), definitions_(families.definitions()), switches_(switches) {}

  // Finds which families matter only where a switch is on.
  void guard() {
    std::vector<const Item*> items;  // in the order of their numbers, outputs last
    for (const Family& family : families_.all)
      for (const auto& [index, item] : family.items) items.push_back(&item);
    std::stable_sort(items.begin(), items.end(), [](const Item* a, const Item* b) {
      return static_cast<unsigned>(a->number) < static_cast<unsigned>(b->number);
    });
    for (const Item* item : items) {
      for (const int number : definitions_.symbols_of(item->value)) {
        const Symbol& symbol = definitions_[number];
        if (const int k = switch_of(switches_, symbol.family); families_.given(symbol) && k >= 0)
          needs_[number] = {k};
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
    for (Family& family : families_.all) {
      bool is_always = family.is_output;
      for (const auto& [index, item] : family.items) {
        is_always = is_always || always.contains(item.number);
        family.guard.insert(guards[item.number].begin(), guards[item.number].end());
      }
      if (is_always) family.guard.clear();
    }
    split();
    for (const Family& reader : families_.all)
      for (const Dependency& d : reader.dependencies) {
        Family& read = families_.named(d.family);
        const bool only_there =
            !reader.guard.empty() && std::includes(read.guard.begin(), read.guard.end(),
                                                   reader.guard.begin(), reader.guard.end());
        if (!read.guard.empty() && !only_there) read.zero = true;
      }
  }

 private:
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

  // What a family adds up only where a switch is on becomes a family of its own, which adds it.
  void split() {
    const size_t count = families_.all.size();
    for (size_t k = 0; k < count; ++k) {
      const std::string name = families_.all[k].name;
      const bool chained =
          std::any_of(families_.all[k].dependencies.begin(), families_.all[k].dependencies.end(),
                      [&](const Dependency& d) { return d.family == name; });
      if (chained) continue;
      std::map<std::set<int>, Family> parts;
      for (auto& [index, item] : families_.all[k].items) {
        ex rest = 0;
        std::map<std::set<int>, ex> sums;
        for (const ex& product : products_of(item.value)) {
          const std::set<int> needs = product_needs(product);
          const std::set<int>& guard = families_.all[k].guard;
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
      families_.all[k].dependencies.clear();
      families_.depend(families_.all[k]);
      for (auto& [needs, part] : parts) {
        part.name = name + "+" + std::to_string(families_.all.size());
        part.adds_to = name;
        part.guard = needs;
        part.is_output = true;
        part.dependencies.insert({name, 0});
        families_.depend(part);
        adding_[name].push_back(part.name);
        families_.add(std::move(part));
      }
    }
    // Who reads a sum reads all of it.
    for (Family& family : families_.all) {
      const std::set<Dependency> direct = family.dependencies;
      for (const Dependency& d : direct) {
        if (d.family == family.adds_to) continue;
        if (const auto found = adding_.find(d.family); found != adding_.end())
          for (const std::string& part : found->second)
            family.dependencies.insert({part, d.offset});
      }
    }
  }

  Families& families_;
  const Definitions& definitions_;
  const std::vector<Switch>& switches_;
  std::map<int, std::set<int>> needs_;  // number -> it is zero unless one of these is on
  std::map<std::string, std::vector<std::string>> adding_;  // family -> those that add to it
};

}  // namespace

void guard_families(Families& families, const std::vector<Switch>& switches) {
  if (!switches.empty()) Guards(families, switches).guard();
}

std::vector<std::string> inputs_of_guard(const Families& families,
                                         const std::vector<Switch>& switches,
                                         const std::set<int>& guard) {
  std::vector<std::string> names;
  for (const auto& [rank, family] : families.used_inputs())
    if (guard.contains(switch_of(switches, family))) names.push_back(family);
  return names;
}

}  // namespace catena
