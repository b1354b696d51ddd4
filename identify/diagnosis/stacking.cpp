// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/stacking.hpp"

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

}  // namespace catena
