// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/stacking.hpp"

#include <algorithm>
#include <cmath>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd stacked_where_seen(const std::vector<MatrixXd>& parts, const std::vector<MatrixXd>& seen) {
  std::vector<double> values;
  for (std::size_t r = 0; r < seen.size(); ++r)
    for (Index i = 0; i < seen[r].size(); ++i)
      if (!std::isnan(seen[r].data()[i])) values.push_back(parts[r].data()[i]);
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

std::vector<MatrixXd> unstacked(const VectorXd& stacked, const std::vector<MatrixXd>& seen) {
  std::vector<MatrixXd> parts = seen;
  Index next = 0;
  for (MatrixXd& part : parts)
    for (double& value : part.reshaped())
      if (!std::isnan(value)) value = stacked[next++];
  return parts;
}

std::size_t errs_like(const std::vector<MatrixXd>& fitted, std::size_t e, Index channels) {
  if (fitted[e].cols() > 0) return e;
  const auto is_fitted = [](const MatrixXd& part) { return part.cols() > 0; };
  const auto alike = std::ranges::find_if(
      fitted, [&](const MatrixXd& part) { return is_fitted(part) && part.rows() == channels; });
  return static_cast<std::size_t>(
      (alike != fitted.end() ? alike : std::ranges::find_if(fitted, is_fitted)) - fitted.begin());
}

MatrixXd channels_in_turn(const MatrixXd& series, Index channels) {
  MatrixXd turned(channels, series.cols());
  for (Index c = 0; c < channels; ++c) turned.row(c) = series.row(c % series.rows());
  return turned;
}

}  // namespace catena
