// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/segments.hpp"

#include <cmath>
#include <complex>
#include <numbers>

#include "identify/noise/filling.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Without a straight line in each channel.
MatrixXd without_line(MatrixXd values) {
  const Index n = values.cols();
  const VectorXd slope = VectorXd::LinSpaced(n, -1, 1);
  for (Index c = 0; c < values.rows(); ++c) {
    VectorXd row = values.row(c);
    row.array() -= row.mean();
    row -= row.dot(slope) / slope.squaredNorm() * slope;
    values.row(c) = row;
  }
  return values;
}
}  // namespace

Segments::Segments(const std::vector<MatrixXd>& residuals, const std::vector<MatrixXd>& predictions,
                   const NoiseShape& shape, const MatrixXd& tapers) {
  const auto length = static_cast<int>(tapers.rows());
  Filler filled(shape);
  double all = 0, seen = 0;
  const int bins = length / 2 + 1;
  MatrixXcd waves(length, bins);
  for (int k = 0; k < length; ++k)
    for (int j = 0; j < bins; ++j)
      waves(k, j) = std::polar(1.0, -2 * std::numbers::pi * j * k / length);
  const VectorXd weight_in_segment = tapers.rowwise().squaredNorm();
  for (std::size_t w = 0; w < residuals.size(); ++w) {
    const Index frames = residuals[w].cols();
    if (frames < length) continue;
    const Index steps = (2 * (frames - length) + length - 1) / length;
    double seen_here = 0;
    VectorXd weight = VectorXd::Zero(frames);
    MatrixXd full(residuals[w].rows(), frames), motion = full;
    for (Index c = 0; c < full.rows(); ++c) {
      full.row(c) = filled(residuals[w].row(c));
      motion.row(c) = filled(predictions[w].row(c));
      seen_here +=
          static_cast<double>((residuals[w].row(c).array() == residuals[w].row(c).array()).count());
    }
    all += static_cast<double>(full.size());
    seen += seen_here;
    for (Index s = 0; s <= steps; ++s) {
      const Index first = steps > 0 ? s * (frames - length) / steps : 0;
      weight.segment(first, length) += weight_in_segment;
      const MatrixXd of_full = without_line(full.middleCols(first, length));
      const MatrixXd of_motion = without_line(motion.middleCols(first, length));
      for (const auto& taper : tapers.colwise()) {
        residual.push_back(of_full * taper.asDiagonal() * waves);
        const MatrixXd p = (of_motion * taper.asDiagonal() * waves).cwiseAbs2();
        if (motion_power.size() == 0) motion_power = MatrixXd::Zero(p.rows(), p.cols());
        motion_power += p;
      }
    }
    // Summed over the frequencies, a power is a sum of squares over the frames with these weights.
    values +=
        seen_here / static_cast<double>(frames) * std::pow(weight.sum(), 2) / weight.squaredNorm();
  }
  motion_power /= static_cast<double>(residual.size());
  // What was filled lacks what its neighbours do not tell.
  const double lacks = (1 - seen / all) * shape.unpredictable();
  for (MatrixXcd& x : residual) x /= std::sqrt(1 - lacks);
}

MatrixXd Segments::power() const {
  MatrixXd sum = MatrixXd::Zero(motion_power.rows(), motion_power.cols());
  for (const MatrixXcd& x : residual) sum += x.cwiseAbs2();
  return sum / static_cast<double>(residual.size());
}

}  // namespace catena
