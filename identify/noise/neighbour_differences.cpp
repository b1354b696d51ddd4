// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/neighbour_differences.hpp"

#include <cmath>
#include <complex>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Share of the noise's power that must be missing: as much as the band of frequencies that show the
/// noise may have of misfit (kCoherent in noise_band.cpp).
constexpr double kMissing = 1.0 / 3;
/// Standard deviations, up to which the data do not decide.
constexpr double kDecided = 3;
/// The lowest frequencies lack the straight line that was taken out of every segment.
constexpr Index kFirst = 3;

/// One row for every channel between two others, so scaled that white noise gives it variance 1.
MatrixXd differences_of(const VectorXd& sigma, const std::vector<int>& direction) {
  MatrixXd rows(0, sigma.size());
  for (const int d : {-1, 0, 1}) {
    std::vector<Index> group;
    for (Index c = 0; c < sigma.size(); ++c)
      if (direction[static_cast<std::size_t>(c)] == d) group.push_back(c);
    for (std::size_t i = 1; i + 1 < group.size(); ++i) {
      VectorXd row = VectorXd::Zero(sigma.size());
      row[group[i - 1]] = row[group[i + 1]] = -0.5;
      row[group[i]] = 1;
      rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
      rows.bottomRows(1) = row.transpose() / row.cwiseProduct(sigma).norm();
    }
  }
  return rows;
}

}  // namespace

bool neighbours_refute(const Segments& segments, const VectorXd& sigma,
                       const std::vector<int>& direction, const VectorXd& noise_power) {
  const MatrixXd differences = differences_of(sigma, direction);
  if (differences.rows() == 0) return false;
  const auto rows = static_cast<double>(differences.rows());
  const Index frequencies = segments.motion_power.cols();
  VectorXd power = VectorXd::Zero(frequencies);
  for (const MatrixXcd& x : segments.residual)
    power += (differences * x).cwiseAbs2().colwise().sum().transpose();
  power /= static_cast<double>(segments.residual.size()) * rows;
  // Independent complex values behind the power at one frequency: differences next to each other share channels,
  // segments overlap.
  const MatrixXd correlation =
      differences * sigma.cwiseAbs2().asDiagonal() * differences.transpose();
  const double apart = rows * rows / correlation.squaredNorm();
  const double frames = segments.values / static_cast<double>(sigma.size());
  const double at_one = apart * frames / (2 * static_cast<double>(frequencies - 1));

  const Index used = frequencies - 1 - kFirst;
  const auto claimed = noise_power.segment(kFirst, used);
  const double missing = 1 - power.segment(kFirst, used).sum() / claimed.sum();
  const double values = at_one * std::pow(claimed.sum(), 2) / claimed.squaredNorm();
  return missing > kMissing && missing * std::sqrt(values) > kDecided;
}

}  // namespace catena
