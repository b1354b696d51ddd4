// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/ordered_unknowns.hpp"

#include <algorithm>

namespace catena {
namespace {

/// Calls `visit` with the indices of the lesser and the greater one of each order.
template <class Visit>
void for_each_order(const std::vector<Unknown>& unknowns, const Visit& visit) {
  for (std::size_t j = 0; j < unknowns.size(); ++j)
    if (unknowns[j].at_most >= 0)
      visit(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(unknowns[j].at_most));
}

}  // namespace

UnknownBounds bounds_apart(const std::vector<Unknown>& unknowns) {
  const auto count = static_cast<Eigen::Index>(unknowns.size());
  UnknownBounds bounds{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (Eigen::Index j = 0; j < count; ++j) {
    bounds.lower[j] = unknowns[static_cast<std::size_t>(j)].least;
    bounds.upper[j] = unknowns[static_cast<std::size_t>(j)].most;
  }
  for_each_order(unknowns, [&](Eigen::Index lesser, Eigen::Index greater) {
    bounds.upper[lesser] = std::min(bounds.upper[lesser], bounds.upper[greater]);
    bounds.upper[greater] -= bounds.lower[lesser];
    bounds.lower[greater] = 0;
  });
  return bounds;
}

Eigen::VectorXd apart(const std::vector<Unknown>& unknowns, Eigen::VectorXd x) {
  for_each_order(unknowns, [&](Eigen::Index lesser, Eigen::Index greater) {
    x[greater] = std::max(0.0, x[greater] - x[lesser]);
  });
  return x;
}

Eigen::VectorXd together(const std::vector<Unknown>& unknowns, Eigen::VectorXd y) {
  for_each_order(unknowns, [&](Eigen::Index lesser, Eigen::Index greater) {
    y[greater] = std::min(y[greater] + y[lesser], unknowns[static_cast<std::size_t>(greater)].most);
  });
  return y;
}

Eigen::VectorXd changes_together(const std::vector<Unknown>& unknowns, Eigen::VectorXd change) {
  for_each_order(unknowns, [&](Eigen::Index lesser, Eigen::Index greater) {
    change[greater] += change[lesser];
  });
  return change;
}

void differentiate_apart(const std::vector<Unknown>& unknowns, Eigen::MatrixXd& columns) {
  for_each_order(unknowns, [&](Eigen::Index lesser, Eigen::Index greater) {
    columns.col(lesser) += columns.col(greater);
  });
}

}  // namespace catena
