// SPDX-License-Identifier: GPL-3.0-or-later
//
// Walks over expressions that hold the same parts many times, as eliminations by hand do: written
// out they double with every step, but each distinct part is visited once here.
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <utility>
#include <vector>

namespace catena::checking {

/// Calls `visit` once for each distinct part, the whole included. Parts for which it returns false
/// are not entered.
void for_each_part(const GiNaC::ex& expression, const std::function<bool(const GiNaC::ex&)>& visit);

/// The functions and roots of which the rest of the expressions is rational.
std::vector<GiNaC::ex> transcendental_parts(const std::vector<GiNaC::ex>& expressions);

/// The expression with parts replaced, whole parts before what is in them.
class Replacement {
 public:
  explicit Replacement(GiNaC::exmap replaced) : known_(std::move(replaced)) {}
  GiNaC::ex operator()(const GiNaC::ex& expression);

 private:
  GiNaC::exmap known_;
};

/// numerator / denominator, nothing expanded and common factors of denominators taken once.
struct Quotient {
  GiNaC::ex numerator;
  GiNaC::ex denominator;
};
Quotient cleared(const GiNaC::ex& expression);

/// About how many products appear on the way when the expression is expanded, its sines and cosines
/// of sums too, and its denominators are cleared.
double expanded_size(const GiNaC::ex& expression);

}  // namespace catena::checking
