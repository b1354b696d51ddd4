// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/combination.hpp"

#include "common/as_index.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;

void set(Combination& combination, int equation, const ex& factor) {
  if (!factor.expand().is_zero()) combination.factors[equation] = factor;
}

/// The determinant of what is left without a row and a column, for n up to kMostSolvedLinks = 3.
ex minor(const GiNaC::matrix& m, unsigned row, unsigned column) {
  const unsigned n = m.rows();
  if (n == 1) return 1;
  GiNaC::matrix rest(n - 1, n - 1);
  for (unsigned i = 0; i + 1 < n; ++i)
    for (unsigned j = 0; j + 1 < n; ++j)
      rest(i, j) = m(i < row ? i : i + 1, j < column ? j : j + 1);
  return n == 2 ? rest(0, 0) : rest(0, 0) * rest(1, 1) - rest(0, 1) * rest(1, 0);
}

/// det(M) h = sum_j (adj(M) A)_j r_j, A_j = dh/dthetaddot_j.
Combination from_accelerations(const ex& hand, const ChainSymbols& chain,
                               const FlatDerivation& model) {
  const auto n = static_cast<unsigned>(chain.coordinates());
  GiNaC::matrix mass(n, n);
  for (unsigned i = 0; i < n; ++i)
    for (unsigned j = 0; j < n; ++j)
      mass(i, j) = total(model.mass(static_cast<int>(i) + 1, static_cast<int>(j) + 1));
  const auto cofactor = [&](unsigned i, unsigned j) {
    return (i + j) % 2 == 0 ? minor(mass, i, j) : ex(-minor(mass, i, j));
  };
  Combination result;
  result.divisor = 0;
  for (unsigned j = 0; j < n; ++j) result.divisor += mass(0, j) * cofactor(0, j);
  for (unsigned i = 0; i < n; ++i) {
    ex factor = 0;
    for (unsigned j = 0; j < n; ++j)
      factor += cofactor(j, i) * derivative(hand, chain.acceleration[j + 1]);
    set(result, static_cast<int>(i) + 1, factor);
  }
  return result;
}

}  // namespace

std::vector<Combination> possible_combinations(const ex& hand, const ChainSymbols& chain,
                                               const FlatDerivation& model) {
  Combination by_torque, by_inertia, by_damping, by_stiffness;
  ex damping_sum = 0, stiffness_sum = 0;
  for (int j = 1; j <= chain.coordinates(); ++j)
    set(by_torque, j, -derivative(hand, chain.torque[as_index(j)]));
  for (int j = 1; j <= chain.links; ++j) {
    set(by_inertia, j,
        derivative(derivative(hand, chain.inertia[as_index(j)]), chain.acceleration[as_index(j)]));
    damping_sum +=
        derivative(derivative(hand, chain.damping[as_index(j)]), chain.rate[as_index(j)]);
    set(by_damping, j, damping_sum);
    stiffness_sum +=
        derivative(derivative(hand, chain.stiffness[as_index(j)]), chain.angle[as_index(j)]);
    set(by_stiffness, j, stiffness_sum);
  }
  std::vector<Combination> result{by_torque, by_inertia, by_damping, by_stiffness};
  if (chain.coordinates() <= kMostSolvedLinks)
    result.push_back(from_accelerations(hand, chain, model));
  std::erase_if(result, [](const Combination& combination) { return combination.factors.empty(); });
  return result;
}

}  // namespace catena::checking
