// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/condensed_rows.hpp"

#include <algorithm>

#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// What is left of an experiment's rows: columns of the Jacobian that are not zero there, and these
/// with the value as the last.
struct OfExperiment {
  std::vector<Index> columns;
  MatrixXd rows;
};

OfExperiment rows_of_experiment(const Residuals& residuals, const VectorXd& weights, Index first,
                                Index count) {
  const MatrixXd& jacobian = residuals.jacobian;
  OfExperiment result;
  for (Index j = 0; j < jacobian.cols(); ++j)
    if (!jacobian.col(j).segment(first, count).isZero(0)) result.columns.push_back(j);
  const auto own = static_cast<Index>(result.columns.size());
  result.rows.resize(count, own + 1);
  result.rows.leftCols(own) = jacobian.middleRows(first, count)(Eigen::all, result.columns);
  result.rows.col(own) = residuals.value.segment(first, count);
  result.rows.array().colwise() *= weights.segment(first, count).array();
  if (count > own + 1) result.rows = triangle_of(result.rows);
  return result;
}

}  // namespace

LinearRows condensed(const Residuals& residuals, const VectorXd& weights,
                     const SoftConstraints& constraints) {
  std::vector<OfExperiment> parts;
  const Index all = residuals.value.size(), unknowns = residuals.jacobian.cols();
  Index left = 0;
  for (Index first = 0, last = 0; first < all; first = last) {
    const auto experiment_of = [&](Index i) {
      return residuals.index[static_cast<std::size_t>(i)].experiment;
    };
    while (last < all && experiment_of(last) == experiment_of(first)) ++last;
    parts.push_back(rows_of_experiment(residuals, weights, first, last - first));
    left += parts.back().rows.rows();
  }
  // The value as the last column. Rows of zeros if there are fewer than in the end.
  const Index more = constraints.value.size();
  MatrixXd together = MatrixXd::Zero(std::max(left + more, unknowns + 1), unknowns + 1);
  if (more > 0) {
    together.topLeftCorner(more, unknowns) = constraints.weight.asDiagonal() * constraints.jacobian;
    together.col(unknowns).head(more) = constraints.weight.cwiseProduct(constraints.value);
  }
  Index used = more;
  for (OfExperiment& part : parts) {
    part.columns.push_back(unknowns);
    together.middleRows(used, part.rows.rows())(Eigen::all, part.columns) = part.rows;
    used += part.rows.rows();
  }
  together = triangle_of(together);
  return {together.col(unknowns), together.leftCols(unknowns)};
}

}  // namespace catena
