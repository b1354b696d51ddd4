// SPDX-License-Identifier: GPL-3.0-or-later
//
// Expressions as C++ text in an order that is ours, not GiNaC's: the same on every run, and the
// same relative to the link for every link, so that equal work at each link becomes a loop.
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <string>

#include "generator/derivation/definitions.hpp"

namespace catena {

/// Text of a symbol as seen from the link at hand.
using SymbolText = std::function<std::string(int number)>;

/// C++: a template on the scalar type T. C: C99 in double precision.
enum class Language { kCpp, kC };

struct OperationCount {
  long additions = 0, multiplications = 0, divisions = 0, functions = 0;
  OperationCount& operator+=(const OperationCount& other);
};

/// Text of a definition's right-hand side: a polynomial in symbols, factored where factors are
/// shared, or one function of a symbol. Symbols are ordered by family and by index - link.
/// In C++ every number is written as a value of the scalar type T. Counts what it costs, if asked.
std::string expression_text(const Definitions& definitions, const GiNaC::ex& expression, int link,
                            const SymbolText& symbol_text, Language language = Language::kCpp,
                            OperationCount* count = nullptr);

}  // namespace catena
