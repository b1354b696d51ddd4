// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/tridiagonal.hpp"

#include <cstdlib>
#include <map>

#include "generator/derivation/written_out.hpp"

namespace catena {

using GiNaC::ex;

bool is_constant_tridiagonal(Chain& chain, const std::vector<ex>& variables) {
  const int n = static_cast<int>(variables.size());
  if (n != chain.links()) return false;
  const Definitions& definitions = chain.definitions();
  std::map<int, int> column;  // number of the variable's symbol -> j
  for (int j = 0; j < n; ++j) column[definitions.number_of(variables[static_cast<size_t>(j)])] = j;
  std::map<std::pair<int, int>, ex> entries;
  WrittenOut written_out(definitions);
  for (int i = 0; i < n; ++i) {
    const ex row = written_out.of(chain.residual()[static_cast<size_t>(i)]);
    for (const int number : definitions.symbols_of(row)) {
      const auto found = column.find(number);
      if (found == column.end()) continue;
      const int j = found->second;
      if (std::abs(i - j) > 1) return false;
      const ex entry =
          row.diff(GiNaC::ex_to<GiNaC::symbol>(variables[static_cast<size_t>(j)])).expand();
      for (const int inner : definitions.symbols_of(entry)) {
        const std::string& family = definitions[inner].family;
        if (family != "stiffness" && family != "damping") return false;
      }
      entries[{i, j}] = entry;
    }
  }
  for (const auto& [at, entry] : entries) {
    const auto mirrored = entries.find({at.second, at.first});
    if (mirrored == entries.end() || !(mirrored->second - entry).expand().is_zero()) return false;
  }
  return true;
}

}  // namespace catena
