// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/latex_monomials.hpp"

#include <algorithm>
#include <vector>

namespace catena {

using GiNaC::numeric;

namespace {

MonomialFactor cosine(int i, int j = 0) { return {Role::kCosine, i, j}; }
MonomialFactor sine(int i, int j = 0) { return {Role::kSine, i, j}; }

std::vector<Powers> monomials(const MonomialSum& sum) {
  std::vector<Powers> all;
  for (const auto& [powers, value] : sum) all.push_back(powers);
  return all;
}

numeric coefficient(const MonomialSum& sum, const Powers& powers) {
  const auto found = sum.find(powers);
  return found == sum.end() ? numeric(0) : found->second;
}

// Takes one power of a factor away; false if there is none.
bool take(Powers& powers, const MonomialFactor& factor) {
  const auto found = powers.find(factor);
  if (found == powers.end() || found->second < 1) return false;
  if (--found->second == 0) powers.erase(found);
  return true;
}

// rest (ab + sign cd) -> rest together, as much of it as both monomials have. True if any had.
bool combine(MonomialSum& sum, const Powers& ab, const Powers& cd, int sign,
             const Powers& together) {
  bool any = false;
  for (const Powers& powers : monomials(sum)) {
    Powers rest = powers;
    bool has = true;
    for (const auto& [factor, power] : ab) {
      for (int k = 0; k < power; ++k) has = has && take(rest, factor);
    }
    if (!has) continue;
    Powers other = rest, merged = rest;
    for (const auto& [factor, power] : cd) other[factor] += power;
    for (const auto& [factor, power] : together) merged[factor] += power;
    const numeric here = coefficient(sum, powers);
    const numeric there = coefficient(sum, other) * numeric(sign);
    if (!(here * there).is_positive()) continue;
    const numeric common = GiNaC::abs(here) < GiNaC::abs(there) ? here : there;
    add_monomial(sum, powers, -common);
    add_monomial(sum, other, -common * numeric(sign));
    add_monomial(sum, merged, common);
    any = true;
  }
  return any;
}

int largest_link(const MonomialSum& sum) {
  int largest = 0;
  for (const auto& [powers, value] : sum) {
    for (const auto& [factor, power] : powers) {
      if (factor.role == Role::kCosine || factor.role == Role::kSine) {
        largest = std::max(largest, factor.first);
      }
    }
  }
  return largest;
}

}  // namespace

void add_monomial(MonomialSum& sum, const Powers& powers, const numeric& coefficient) {
  if (coefficient.is_zero()) return;
  const auto [at, is_new] = sum.emplace(powers, coefficient);
  if (!is_new) at->second = at->second + coefficient;
  if (at->second.is_zero()) sum.erase(at);
}

void combine_trigonometry(MonomialSum& sum) {
  const int n = largest_link(sum);
  // Each combination makes the sum of the sizes of the coefficients smaller: it ends.
  for (bool again = true; again;) {
    again = false;
    for (int i = 1; i <= n; ++i) {
      again = combine(sum, {{sine(i), 2}}, {{cosine(i), 2}}, 1, {}) || again;
      for (int j = i + 1; j <= n; ++j) {
        again = combine(sum, {{cosine(i), 1}, {cosine(j), 1}}, {{sine(i), 1}, {sine(j), 1}}, 1,
                        {{cosine(i, j), 1}}) ||
                again;
        again = combine(sum, {{sine(i), 1}, {cosine(j), 1}}, {{cosine(i), 1}, {sine(j), 1}}, -1,
                        {{sine(i, j), 1}}) ||
                again;
      }
    }
  }
  for (int i = 1; i <= n; ++i) {
    // Only where all of a monomial goes: half a versine helps nobody.
    for (const Powers& powers : monomials(sum)) {
      Powers rest = powers;
      if (powers.contains(cosine(i)) && powers.at(cosine(i)) == 1 && take(rest, cosine(i)) &&
          (coefficient(sum, rest) + coefficient(sum, powers)).is_zero()) {
        Powers versine = rest;
        ++versine[{Role::kVersine, i, 0}];
        const numeric value = coefficient(sum, rest);
        sum.erase(powers);
        sum.erase(rest);
        add_monomial(sum, versine, value);
      }
    }
  }
}

}  // namespace catena
