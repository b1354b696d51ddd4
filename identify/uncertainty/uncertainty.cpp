// SPDX-License-Identifier: BSD-3-Clause
#include "identify/uncertainty/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/in_quotes.hpp"
#include "common/normal_quantile.hpp"
#include "common/number_text.hpp"
#include "common/special_values.hpp"
#include "identify/fit/error.hpp"
#include "identify/fit/loss.hpp"
#include "linear_algebra/decompositions.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// d(unknown)/d(scaled unknown).
VectorXd ranges(const Problem& problem, const VectorXd& x) {
  VectorXd range(x.size());
  for (Index j = 0; j < x.size(); ++j) {
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    const double width = unknown.upper - unknown.lower;
    range[j] = unknown.scale == Scale::kLogarithmic ? x[j]
               : std::isfinite(width)               ? width
                                                    : std::max(std::abs(x[j]), 1.0);
  }
  return range;
}

/// Sum of products of residuals one frame apart over the sum of squares, and the number of pairs.
std::pair<double, Index> lag_one(const Residuals& residuals, const VectorXd& r) {
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
  return {products / r.squaredNorm(), pairs};
}

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

/// Under a robust loss, residuals that err as least squares of them would: with psi = r rho'(r^2),
/// psi over the mean of psi' (Huber 1981, section 7.6). Without a loss, the residuals.
VectorXd pseudo_residuals(const Problem& problem, const VectorXd& r) {
  const ErrorSpec& error = problem.the_case().error;
  if (error.loss == Loss::kNone) return r;
  VectorXd psi(r.size());
  double slope = 0;
  for (Index i = 0; i < r.size(); ++i) {
    const LossValue loss = loss_of(error, r[i] * r[i]);
    psi[i] = r[i] * loss.slope;
    slope += loss.slope + 2 * r[i] * r[i] * loss.curvature;
  }
  return psi / (slope / static_cast<double>(r.size()));
}

std::string describe(const Problem& problem, const VectorXd& direction) {
  std::string text;
  for (Index j = 0; j < direction.size(); ++j) {
    if (std::abs(direction[j]) < 0.1) continue;
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    text += text.empty() ? (direction[j] < 0 ? "-" : "") : (direction[j] < 0 ? " - " : " + ");
    text += number_text(std::round(100 * std::abs(direction[j])) / 100) + " " +
            (unknown.scale == Scale::kLogarithmic ? "ln " : "") + unknown.name;
  }
  return text;
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kIdentifiable:
      return "identifiable";
    case Verdict::kPracticallyNot:
      return "practically_not";
    case Verdict::kStructurallyNot:
      return "structurally_not";
    case Verdict::kAtBound:
      return "at_bound";
  }
  return "identifiable";
}

Uncertainty uncertainty_of(const Problem& problem, const VectorXd& x, double expected_noise) {
  const Evaluation evaluation = evaluate(problem, x, false, true);
  if (!evaluation.ok) throw std::runtime_error(evaluation.message);
  const Residuals residuals = fitted_residuals(problem, evaluation);
  const VectorXd weights = noise_of(problem, residuals).cwiseInverse();
  const VectorXd range = ranges(problem, x);
  MatrixXd jacobian = weights.asDiagonal() * residuals.jacobian * range.asDiagonal();
  const Index count = residuals.value.size(), unknowns = x.size();
  if (count <= unknowns)
    throw std::runtime_error(std::to_string(count) + " fitted values cannot determine " +
                             std::to_string(unknowns) +
                             " unknowns; fewer unknowns or more frames are needed (from, to, "
                             "fit_until, every and time_unit say which are fitted)");
  const VectorXd r = pseudo_residuals(problem, residuals.value.cwiseProduct(weights));
  const SoftConstraints constraints = constraints_of(problem, evaluation);

  Uncertainty out;
  out.noise = expected_noise > 0
                  ? expected_noise
                  : std::sqrt(r.squaredNorm() /
                              static_cast<double>(count - unknowns + constraints.value.size()));
  if (!(out.noise > 0)) out.noise = std::numeric_limits<double>::min();
  jacobian /= out.noise;
  MatrixXd with_constraints(count + constraints.value.size(), unknowns);
  with_constraints << jacobian,
      constraints.weight.asDiagonal() * constraints.jacobian * range.asDiagonal() / out.noise;
  const SingularDirections all = singular_directions(with_constraints);
  out.singular_values = all.values;
  // Sensitivities are good to about 1e-6 of their size: what is smaller is no information.
  const double largest =
      constraints.value.size() ? singular_directions(jacobian).values[0] : out.singular_values[0];
  const double smallest = 1e-6 * largest;
  Index rank = 0;
  while (rank < unknowns && out.singular_values[rank] > smallest) ++rank;

  const MatrixXd known = all.vectors.leftCols(rank);
  const MatrixXd inverse = known *
                           out.singular_values.head(rank).cwiseAbs2().cwiseInverse().asDiagonal() *
                           known.transpose();
  MatrixXd covariance = inverse;
  if (expected_noise <= 0) {
    const auto [autocorrelation, pairs] = lag_one(residuals, r);
    out.autocorrelation = autocorrelation;
    out.autocorrelated =
        pairs > 0 && std::abs(autocorrelation) > 2.58 / std::sqrt(static_cast<double>(pairs));
    if (out.autocorrelated) {
      const double rho = std::clamp(autocorrelation, -0.97, 0.97);
      const MatrixXd known_before = with_constraints.bottomRows(constraints.priors);
      const MatrixXd of_priors = known_before.transpose() * known_before;
      covariance =
          inverse * (autoregressive_middle(residuals, jacobian, rho) + of_priors) * inverse;
      const VectorXd robust =
          (inverse * (robust_middle(residuals, jacobian, r / out.noise, rho) + of_priors) * inverse)
              .diagonal();
      // The robust estimate scatters; where it is far above, markers are correlated or autocorrelation
      // lasts longer than AR(1) knows.
      constexpr double kFarAbove = 2;
      VectorXd stretch = VectorXd::Ones(unknowns);
      for (Index j = 0; j < unknowns; ++j)
        if (robust[j] > kFarAbove * covariance(j, j))
          stretch[j] = std::sqrt(robust[j] / covariance(j, j));
      covariance = stretch.asDiagonal() * covariance * stretch.asDiagonal();
    }
  }

  const MatrixXd null = all.vectors.rightCols(unknowns - rank);
  VectorXd deviation = covariance.diagonal().cwiseMax(0).cwiseSqrt();
  out.correlation =
      MatrixXd::Constant(unknowns, unknowns, std::numeric_limits<double>::quiet_NaN());
  std::vector<bool> lost(static_cast<std::size_t>(unknowns), false);
  constexpr double kPart =
      0.02;  // of a direction of unit length: less than that takes no part in it
  for (Index j = 0; j < unknowns; ++j)
    lost[static_cast<std::size_t>(j)] = null.cols() > 0 && null.row(j).norm() > kPart;
  for (Index j = 0; j < unknowns; ++j) {
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    Estimate estimate;
    if (lost[static_cast<std::size_t>(j)]) deviation[j] = kInfinite;
    estimate.standard_error = deviation[j] * std::abs(range[j]);
    if (unknown.scale == Scale::kLogarithmic) {
      estimate.lower = x[j] * std::exp(-kNormalQuantile95 * deviation[j]);
      estimate.upper = x[j] * std::exp(kNormalQuantile95 * deviation[j]);
    } else {
      estimate.lower = x[j] - kNormalQuantile95 * estimate.standard_error;
      estimate.upper = x[j] + kNormalQuantile95 * estimate.standard_error;
    }
    const double near = 1e-6 * std::abs(x[j]);
    if (lost[static_cast<std::size_t>(j)])
      estimate.verdict = Verdict::kStructurallyNot;
    else if (expected_noise <= 0 && (x[j] <= unknown.least + near || x[j] >= unknown.most - near))
      estimate.verdict = Verdict::kAtBound;
    else if (kNormalQuantile95 * deviation[j] > 1)
      estimate.verdict = Verdict::kPracticallyNot;
    out.estimates.push_back(estimate);
    for (Index i = 0; i <= j; ++i)
      if (!lost[static_cast<std::size_t>(i)] && !lost[static_cast<std::size_t>(j)])
        out.correlation(i, j) = out.correlation(j, i) =
            i == j ? 1 : covariance(i, j) / (deviation[i] * deviation[j]);
  }
  for (Index i = unknowns; i-- > 0;) {  // the weakest first
    WeakDirection weak;
    weak.deviation = i >= rank ? kInfinite : 1 / out.singular_values[i];
    if (kNormalQuantile95 * weak.deviation <= 1) break;
    weak.direction = all.vectors.col(i);
    weak.text = describe(problem, weak.direction);
    Index largest;
    weak.direction.cwiseAbs().maxCoeff(&largest);
    out.suggestions.push_back(
        "fix " + in_quotes(problem.unknowns()[static_cast<std::size_t>(largest)].name) +
        ", or measure what tells it from the others");
    out.weak.push_back(std::move(weak));
  }
  return out;
}

Estimate noise_estimate(const ChannelNoise& channel, const Uncertainty& uncertainty) {
  // The squares of an AR(1) process are correlated by the square of its correlation.
  const double square =
      uncertainty.autocorrelated
          ? std::min(uncertainty.autocorrelation * uncertainty.autocorrelation, 0.94)
          : 0;
  const double relative =
      std::sqrt((1 + square) / (1 - square) / (2 * static_cast<double>(channel.count)));
  return {channel.deviation * relative, channel.deviation * std::exp(-kNormalQuantile95 * relative),
          channel.deviation * std::exp(kNormalQuantile95 * relative), Verdict::kIdentifiable};
}

}  // namespace catena
