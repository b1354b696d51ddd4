// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/condensed_rows.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "linear_algebra/decompositions.hpp"

using namespace catena;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Of windows with starts of their own: `shared` columns, then two for each window; columns differ in
/// size by powers of ten.
Residuals of_windows(const std::vector<Index>& rows, Index shared) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  Residuals residuals;
  const auto windows = static_cast<Index>(rows.size());
  Index all = 0;
  for (const Index count : rows) all += count;
  residuals.value.resize(all);
  residuals.jacobian.setZero(all, shared + 2 * windows);
  Index i = 0;
  for (Index w = 0; w < windows; ++w)
    for (Index k = 0; k < rows[static_cast<std::size_t>(w)]; ++k, ++i) {
      residuals.index.push_back({static_cast<int>(w), 0, k});
      residuals.value[i] = normal(random);
      for (Index j = 0; j < shared; ++j)
        residuals.jacobian(i, j) = std::pow(10, 2 * j) * normal(random);
      for (Index j = 0; j < 2; ++j) residuals.jacobian(i, shared + 2 * w + j) = normal(random);
    }
  return residuals;
}

VectorXd weights_of(const Residuals& residuals) {
  VectorXd weights(residuals.value.size());
  for (Index i = 0; i < weights.size(); ++i) weights[i] = 1 + static_cast<double>(i % 5);
  return weights;
}

SoftConstraints constraints_on(Index unknowns) {
  SoftConstraints constraints;
  constraints.value = VectorXd::Constant(1, 0.5);
  constraints.weight = VectorXd::Constant(1, 30);
  constraints.jacobian = MatrixXd::Zero(1, unknowns);
  constraints.jacobian(0, 0) = 1;
  constraints.jacobian(0, unknowns - 1) = -1;
  return constraints;
}

/// All rows, each times its weight, with the value as the last column.
MatrixXd all_rows(const Residuals& residuals, const VectorXd& weights,
                  const SoftConstraints& constraints) {
  const Index n = residuals.value.size(), m = constraints.value.size();
  const Index unknowns = residuals.jacobian.cols();
  MatrixXd rows(n + m, unknowns + 1);
  rows.topRows(n) << residuals.jacobian, residuals.value;
  rows.topRows(n) = weights.asDiagonal() * rows.topRows(n);
  if (m > 0) {
    rows.bottomRows(m) << constraints.jacobian, constraints.value;
    rows.bottomRows(m) = constraints.weight.asDiagonal() * rows.bottomRows(m);
  }
  return rows;
}

/// The largest difference of products of columns, over the sizes of these columns.
double difference_of_products(const LinearRows& condensed, const MatrixXd& all) {
  MatrixXd rows(condensed.value.size(), all.cols());
  rows << condensed.jacobian, condensed.value;
  const VectorXd size = all.colwise().norm().cwiseInverse();
  const MatrixXd difference = rows.transpose() * rows - all.transpose() * all;
  return (size.asDiagonal() * difference * size.asDiagonal()).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("condensed rows have the products of all rows, and the same best step") {
  const Residuals residuals = of_windows({40, 3, 25, 60}, 3);
  const VectorXd weights = weights_of(residuals);
  for (const bool constrained : {false, true}) {
    const SoftConstraints constraints =
        constrained ? constraints_on(residuals.jacobian.cols()) : SoftConstraints{};
    const LinearRows rows = condensed(residuals, weights, constraints);
    const MatrixXd all = all_rows(residuals, weights, constraints);
    CHECK(rows.value.size() == residuals.jacobian.cols() + 1);
    CHECK(difference_of_products(rows, all) < 1e-14);
    const VectorXd step = least_squares(rows.jacobian, rows.value);
    const VectorXd plain =
        least_squares(MatrixXd(all.leftCols(rows.jacobian.cols())), VectorXd(all.rightCols(1)));
    CHECK((step - plain).cwiseQuotient(plain).cwiseAbs().maxCoeff() < 1e-10);
  }
}

TEST_CASE("fewer rows than unknowns are filled up with zeros") {
  const Residuals residuals = of_windows({2, 1}, 4);
  const VectorXd weights = weights_of(residuals);
  const LinearRows rows = condensed(residuals, weights, {});
  CHECK(rows.jacobian.rows() == 9);
  CHECK(difference_of_products(rows, all_rows(residuals, weights, {})) < 1e-14);
}
