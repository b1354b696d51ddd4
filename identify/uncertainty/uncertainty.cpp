// SPDX-License-Identifier: BSD-3-Clause
#include "identify/uncertainty/uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "common/in_quotes.hpp"
#include "common/normal_quantile.hpp"
#include "common/number_text.hpp"
#include "common/special_values.hpp"
#include "identify/fit/error.hpp"
#include "identify/fit/loss.hpp"
#include "identify/uncertainty/sandwich_covariance.hpp"
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

/// Singular values, descending, and directions of the scaled unknowns; the data know the first `rank`.
struct Directions {
  VectorXd singular_values;
  MatrixXd vectors;
  Index rank = 0;
};

/// Of the Jacobian with its constraints. `largest`: the largest singular value of the data alone, where there are
/// constraints.
Directions directions_of(const MatrixXd& jacobian, std::optional<double> largest) {
  const SingularDirections all = singular_directions(jacobian);
  // Sensitivities are good to about 1e-6 of their size: what is smaller is no information.
  const double smallest = 1e-6 * largest.value_or(all.values[0]);
  Index rank = 0;
  while (rank < all.values.size() && all.values[rank] > smallest) ++rank;
  return {all.values, all.vectors, rank};
}

/// (J'J)^-1; zero in the directions that the data do not know.
MatrixXd inverse_of(const Directions& directions) {
  const MatrixXd known = directions.vectors.leftCols(directions.rank);
  return known *
         directions.singular_values.head(directions.rank).cwiseAbs2().cwiseInverse().asDiagonal() *
         known.transpose();
}

/// What standard errors, intervals and verdicts come from.
struct Errors {
  const VectorXd& range;       ///< d(unknown)/d(scaled unknown)
  const MatrixXd& covariance;  ///< of the scaled unknowns
  const Directions& directions;
  bool before_fit;  ///< x is a start: none of it lies at a bound because of the data
};

double most_of(const Unknown& unknown, const VectorXd& x) {
  return unknown.at_most < 0 ? unknown.most : std::min(unknown.most, x[unknown.at_most]);
}

/// Error, interval and verdict of each unknown, and their correlations.
void fill_estimates(Uncertainty& out, const Problem& problem, const VectorXd& x,
                    const Errors& errors) {
  const Index unknowns = x.size();
  const MatrixXd null = errors.directions.vectors.rightCols(unknowns - errors.directions.rank);
  VectorXd deviation = errors.covariance.diagonal().cwiseMax(0).cwiseSqrt();
  // Of a direction of unit length: less than that takes no part in it.
  constexpr double kPart = 0.02;
  std::vector<bool> lost(static_cast<std::size_t>(unknowns), false);
  for (Index j = 0; j < unknowns; ++j)
    lost[static_cast<std::size_t>(j)] = null.cols() > 0 && null.row(j).norm() > kPart;
  out.correlation =
      MatrixXd::Constant(unknowns, unknowns, std::numeric_limits<double>::quiet_NaN());
  for (Index j = 0; j < unknowns; ++j) {
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    Estimate estimate;
    if (lost[static_cast<std::size_t>(j)]) deviation[j] = kInfinite;
    estimate.standard_error = deviation[j] * std::abs(errors.range[j]);
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
    else if (!errors.before_fit &&
             (x[j] <= unknown.least + near || x[j] >= most_of(unknown, x) - near))
      estimate.verdict = Verdict::kAtBound;
    else if (kNormalQuantile95 * deviation[j] > 1)
      estimate.verdict = Verdict::kPracticallyNot;
    out.estimates.push_back(estimate);
    for (Index i = 0; i <= j; ++i)
      if (!lost[static_cast<std::size_t>(i)] && !lost[static_cast<std::size_t>(j)])
        out.correlation(i, j) = out.correlation(j, i) =
            i == j ? 1 : errors.covariance(i, j) / (deviation[i] * deviation[j]);
  }
}

/// The directions known to no better than a scaled unit, the weakest first, and what to fix.
void fill_weak_directions(Uncertainty& out, const Problem& problem, const Directions& directions) {
  for (Index i = directions.vectors.cols(); i-- > 0;) {
    WeakDirection weak;
    weak.deviation = i >= directions.rank ? kInfinite : 1 / directions.singular_values[i];
    if (kNormalQuantile95 * weak.deviation <= 1) break;
    weak.direction = directions.vectors.col(i);
    weak.text = describe(problem, weak.direction);
    Index largest;
    weak.direction.cwiseAbs().maxCoeff(&largest);
    out.suggestions.push_back(
        "fix " + in_quotes(problem.unknowns()[static_cast<std::size_t>(largest)].name) +
        ", or measure what tells it from the others");
    out.weak.push_back(std::move(weak));
  }
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
  const Index count = residuals.value.size(), unknowns = x.size();
  if (count <= unknowns)
    throw std::runtime_error(std::to_string(count) + " fitted values cannot determine " +
                             std::to_string(unknowns) +
                             " unknowns; fewer unknowns or more frames are needed (from, to, "
                             "fit_until, every and time_unit say which are fitted)");
  const VectorXd weights = noise_of(problem, residuals).cwiseInverse();
  const VectorXd range = ranges(problem, x);
  const VectorXd r = pseudo_residuals(problem, residuals.value.cwiseProduct(weights));
  const SoftConstraints constraints = constraints_of(problem, evaluation);

  Uncertainty out;
  out.noise = expected_noise > 0
                  ? expected_noise
                  : std::sqrt(r.squaredNorm() /
                              static_cast<double>(count - unknowns + constraints.value.size()));
  if (!(out.noise > 0)) out.noise = std::numeric_limits<double>::min();
  MatrixXd jacobian = weights.asDiagonal() * residuals.jacobian * range.asDiagonal();
  jacobian /= out.noise;
  MatrixXd with_constraints(count + constraints.value.size(), unknowns);
  with_constraints << jacobian,
      constraints.weight.asDiagonal() * constraints.jacobian * range.asDiagonal() / out.noise;
  std::optional<double> largest;
  if (constraints.value.size()) largest = singular_directions(jacobian).values[0];
  const Directions directions = directions_of(with_constraints, largest);
  out.singular_values = directions.singular_values;

  MatrixXd covariance = inverse_of(directions);
  if (expected_noise <= 0) {
    const LagOne lag = lag_one(residuals, r);
    out.autocorrelation = lag.autocorrelation;
    out.autocorrelated = lag.significant;
    if (lag.significant) {
      const MatrixXd inverse = covariance;
      const MatrixXd rows = with_constraints.bottomRows(constraints.priors);
      covariance = sandwich_covariance(
          {residuals, jacobian, r / out.noise, inverse, rows.transpose() * rows},
          lag.autocorrelation);
    }
  }
  fill_estimates(out, problem, x, {range, covariance, directions, expected_noise > 0});
  fill_weak_directions(out, problem, directions);
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
