// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/weighted_gradient.hpp"

#include <utility>

namespace catena {

using GiNaC::ex;

WeightedGradient::WeightedGradient(Definitions& definitions, std::string prefix)
    : definitions_(definitions), prefix_(std::move(prefix)) {}

void WeightedGradient::add(const ex& expression, const ex& weight, int link) {
  pass_on(expression, weight, link);
}

void WeightedGradient::accumulate() {
  while (!open_.empty()) {
    const auto [number, parts] = *open_.begin();
    open_.erase(open_.begin());
    const Symbol symbol = definitions_[number];
    const ex arrived = total(number, parts);
    done_[number] = arrived;
    if (symbol.is_input) continue;
    if (symbol.family == "sine" || symbol.family == "cosine") {
      // The derivatives of sine and cosine have names already.
      const bool sine = symbol.family == "sine";
      const ex angle = symbol.value.op(0);
      const ex other = sine ? ex(definitions_.define("cosine", symbol.index, GiNaC::cos(angle)))
                            : ex(definitions_.define("sine", symbol.index, GiNaC::sin(angle)));
      open_[definitions_.number_of(angle)][symbol.index] +=
          sine ? arrived * other : -arrived * other;
    } else {
      pass_on(symbol.value, arrived, symbol.index);
    }
  }
}

ex WeightedGradient::of(const ex& symbol) const {
  const auto found = done_.find(definitions_.number_of(symbol));
  return found == done_.end() ? ex(0) : found->second;
}

void WeightedGradient::pass_on(const ex& expression, const ex& arrived, int link) {
  for (const int number : definitions_.symbols_of(expression)) {
    const auto& symbol = GiNaC::ex_to<GiNaC::symbol>(definitions_[number].symbol);
    open_[number][link] += arrived * expression.diff(symbol);
  }
}

// A symbol that belongs to no link has parts from all links. They are summed link by link, as in a
// loop.
ex WeightedGradient::total(int number, const std::map<int, ex>& parts) {
  const Symbol symbol = definitions_[number];
  const bool link_by_link = symbol.index == kNoIndex && parts.size() > 1;
  ex sum = 0, of_no_link = 0;
  for (const auto& [link, part] : parts) {
    if (link == kNoIndex) {
      of_no_link = part;
    } else if (link_by_link) {
      sum = definitions_.define(prefix_ + symbol.family + "_sum", link, sum + part);
    } else {
      sum += part;
    }
  }
  if (link_by_link && of_no_link.is_zero()) return sum;
  return definitions_.define(prefix_ + symbol.family, symbol.index, sum + of_no_link);
}

}  // namespace catena
