// SPDX-License-Identifier: GPL-3.0-or-later
//
// Traverses expressions that contain the same parts many times, as eliminations by hand do. Written
// out they double with every step; here each distinct part is visited once.
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <utility>
#include <vector>

namespace catena::checking {

/// Calls `visit` once for each distinct part, the whole included. Parts for which it returns false
/// are not entered.
void for_each_part(const GiNaC::ex& expression, const std::function<bool(const GiNaC::ex&)>& visit);

/// The functions and roots in the expressions, which are rational in them.
std::vector<GiNaC::ex> transcendental_parts(const std::vector<GiNaC::ex>& expressions);

/// Replaces parts of expressions; a part is replaced before the parts inside it.
class Replacement {
 public:
  explicit Replacement(GiNaC::exmap replaced) : known_(std::move(replaced)) {}
  GiNaC::ex operator()(const GiNaC::ex& expression);

 private:
  GiNaC::exmap known_;
};

/// numerator / denominator, not expanded; common factors of denominators are taken once.
struct Quotient {
  GiNaC::ex numerator;
  GiNaC::ex denominator;
};
/// The expression as one quotient.
Quotient cleared(const GiNaC::ex& expression);

/// Approximate number of products when the expression is expanded, with sines and cosines of sums
/// written out and denominators cleared.
double expanded_size(const GiNaC::ex& expression);

}  // namespace catena::checking
