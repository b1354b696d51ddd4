// SPDX-License-Identifier: BSD-3-Clause
#include "identify/uncertainty/sandwich_covariance.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// J'WJ for residuals that follow AR(1) in every channel: W_kl = autocorrelation^|k - l|.
MatrixXd autoregressive_middle(const Residuals& residuals, const MatrixXd& jacobian,
                               double autocorrelation) {
  const Index unknowns = jacobian.cols();
  MatrixXd middle = MatrixXd::Zero(unknowns, unknowns);
  struct Tail {
    Index frame = -1;
    VectorXd sum;  // of autocorrelation^(k - l) J_l over the earlier frames l of the channel
  };
  std::vector<std::vector<Tail>> tails;  // by experiment and channel
  for (std::size_t i = 0; i < residuals.index.size(); ++i) {
    const ResidualIndex& index = residuals.index[i];
    const auto e = static_cast<std::size_t>(index.experiment);
    const auto c = static_cast<std::size_t>(index.channel);
    if (tails.size() <= e) tails.resize(e + 1);
    if (tails[e].size() <= c) tails[e].resize(c + 1);
    Tail& tail = tails[e][c];
    const VectorXd row = jacobian.row(static_cast<Index>(i)).transpose();
    middle += row * row.transpose();
    if (tail.frame >= 0) {
      tail.sum *= std::pow(autocorrelation, static_cast<double>(index.frame - tail.frame));
      middle += row * tail.sum.transpose() + tail.sum * row.transpose();
      tail.sum += row;
    } else {
      tail.sum = row;
    }
    tail.frame = index.frame;
  }
  return middle;
}

/// J'WJ: the covariance of the sums J'r over frames, with Bartlett's weights.
MatrixXd robust_middle(const Residuals& residuals, const MatrixXd& jacobian, const VectorXd& r,
                       double autocorrelation) {
  const Index unknowns = jacobian.cols();
  std::vector<Index> frames;  // of each experiment
  for (const ResidualIndex& index : residuals.index) {
    const auto e = static_cast<std::size_t>(index.experiment);
    if (frames.size() <= e) frames.resize(e + 1, 0);
    frames[e] = std::max<Index>(frames[e], index.frame + 1);
  }
  std::vector<MatrixXd> sums;  // of each experiment: a frame a row
  sums.reserve(frames.size());
  for (const Index count : frames) sums.push_back(MatrixXd::Zero(count, unknowns));
  for (std::size_t i = 0; i < residuals.index.size(); ++i) {
    const ResidualIndex& index = residuals.index[i];
    sums[static_cast<std::size_t>(index.experiment)].row(index.frame) +=
        jacobian.row(static_cast<Index>(i)) * r[static_cast<Index>(i)];
  }
  const double alpha = 4 * autocorrelation * autocorrelation /
                       std::pow((1 - autocorrelation) * (1 + autocorrelation), 2);
  MatrixXd middle = MatrixXd::Zero(unknowns, unknowns);
  for (const MatrixXd& series : sums) {
    const Index count = series.rows();
    const Index bandwidth = std::min<Index>(
        static_cast<Index>(1.1447 * std::cbrt(alpha * static_cast<double>(count))), count / 4);
    MatrixXd neighbours = series;  // weighted sums over the frames within the bandwidth
    for (Index lag = 1; lag <= bandwidth; ++lag) {
      const double weight = 1 - static_cast<double>(lag) / static_cast<double>(bandwidth + 1);
      neighbours.bottomRows(count - lag) += weight * series.topRows(count - lag);
      neighbours.topRows(count - lag) += weight * series.bottomRows(count - lag);
    }
    middle += series.transpose() * neighbours;
  }
  return middle;
}

}  // namespace

LagOne lag_one(const Residuals& residuals, const VectorXd& r) {
  // by experiment and channel, the place of the last frame seen
  std::vector<std::vector<Index>> last;
  double products = 0;
  Index pairs = 0;
  for (std::size_t i = 0; i < residuals.index.size(); ++i) {
    const ResidualIndex& index = residuals.index[i];
    const auto e = static_cast<std::size_t>(index.experiment);
    const auto c = static_cast<std::size_t>(index.channel);
    if (last.size() <= e) last.resize(e + 1);
    if (last[e].size() <= c) last[e].resize(c + 1, -1);
    const Index before = last[e][c];
    if (before >= 0 && residuals.index[static_cast<std::size_t>(before)].frame + 1 == index.frame) {
      products += r[static_cast<Index>(i)] * r[before];
      ++pairs;
    }
    last[e][c] = static_cast<Index>(i);
  }
  const double autocorrelation = products / r.squaredNorm();
  constexpr double kNormalQuantile99 = 2.58;
  return {autocorrelation,
          pairs > 0 && std::abs(autocorrelation) >
                           kNormalQuantile99 / std::sqrt(static_cast<double>(pairs))};
}

MatrixXd sandwich_covariance(const LeastSquaresErrors& errors, double autocorrelation) {
  const auto& [residuals, jacobian, r, inverse, priors] = errors;
  const double rho = std::clamp(autocorrelation, -0.97, 0.97);
  const MatrixXd covariance =
      inverse * (autoregressive_middle(residuals, jacobian, rho) + priors) * inverse;
  const VectorXd robust =
      (inverse * (robust_middle(residuals, jacobian, r, rho) + priors) * inverse).diagonal();
  // The robust estimate scatters; where it is far above, markers are correlated or autocorrelation
  // lasts longer than AR(1) knows.
  constexpr double kFarAbove = 2;
  VectorXd stretch = VectorXd::Ones(covariance.rows());
  for (Index j = 0; j < stretch.size(); ++j)
    if (robust[j] > kFarAbove * covariance(j, j))
      stretch[j] = std::sqrt(robust[j] / covariance(j, j));
  return stretch.asDiagonal() * covariance * stretch.asDiagonal();
}

}  // namespace catena
