// SPDX-License-Identifier: GPL-3.0-or-later
//
// From GiNaC's expressions to ours (program.hpp), in an order that does not depend on GiNaC's: the
// same on every run, and the same relative to the link for every link, so that equal work at each
// link becomes a loop.
#pragma once

#include <ginac/ginac.h>

#include <functional>

#include "generator/derivation/definitions.hpp"
#include "generator/emission/program.hpp"

namespace catena {

/// How a symbol, given by its number, is read.
using ReadSymbol = std::function<Read(int number)>;

/// A definition's right-hand side: a polynomial in symbols, factored where factors are shared, or
/// one function of a symbol.
/// `link`: symbols are ordered by family and by index - link.
/// Throws std::logic_error if the expression is neither, or has a number that is not rational.
Sum polynomial(const Definitions& definitions, const GiNaC::ex& expression, int link,
               const ReadSymbol& read);

}  // namespace catena
