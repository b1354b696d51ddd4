// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "generator/checking/lexer.hpp"
#include "generator/checking/names.hpp"

namespace catena::checking {

/// The meaning of names at a place of a derivation.
struct Scope {
  struct Stored {
    GiNaC::ex value;
    Location at;
    std::vector<Location> overwritten;
  };

  std::string file;
  std::unique_ptr<ChainSymbols> chain;            ///< null in a scalar derivation
  std::map<std::string, GiNaC::ex> free_symbols;  ///< of a scalar derivation
  std::map<std::string, int> indices;             ///< of the enclosing loops and sums
  std::map<Reference, Stored> values;             ///< assigned so far
  std::vector<std::string> notes;                 ///< remarks that are not errors
  std::set<std::pair<int, int>> noted;            ///< places (line, column) that have their note

  [[nodiscard]] int links() const { return chain ? chain->links : 0; }
  [[nodiscard]] int coordinates() const { return chain ? chain->coordinates() : 0; }
  [[noreturn]] void fail(Location at, const std::string& message) const {
    throw error_at(file, at, message);
  }
};

}  // namespace catena::checking
