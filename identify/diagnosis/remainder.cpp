// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/remainder.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "identify/diagnosis/stacking.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/fit/error.hpp"
#include "identify/noise/cosine_spectrum.hpp"
#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::uint64_t kSeedOfRemainders = 4;
/// The relative error of a noise level from n residuals is sqrt(1.5 / n): it is three times less sure
/// than a standard deviation of n independent values (GapTest).
constexpr double kErrorOfLevel = 1.5;

double excess(const VectorXd& residuals) {
  return residuals.size() > 0 ? residuals.squaredNorm() / static_cast<double>(residuals.size()) - 1
                              : 0.0;
}

/// The spectrum of what is left beyond white noise: each frequency times the share of its power that
/// noise would not have. As many frequencies as `frames` need.
MatrixXd spectrum_beyond_noise(const MatrixXd& left, Index frames) {
  MatrixXd spectrum = cosine_spectrum(left);
  double of_noise = 0;  // power of white noise per frequency: frames were lost, and zeros added
  for (const double value : left.reshaped()) of_noise += !std::isnan(value);
  of_noise /= static_cast<double>(spectrum.rows());
  constexpr Index kOnEachSide = 4;
  VectorXd share(spectrum.rows());
  for (Index j = 0; j < spectrum.rows(); ++j) {
    const Index first = std::max<Index>(0, j - kOnEachSide);
    const Index count = std::min(spectrum.rows() - 1, j + kOnEachSide) - first + 1;
    const double power =
        spectrum.middleRows(first, count).squaredNorm() / static_cast<double>(count);
    share[j] = std::sqrt(std::max(0.0, 1 - of_noise / power));
  }
  if (share.isZero()) share.setOnes();
  spectrum.array().colwise() *= share.array();
  return stretched(spectrum, frames);
}

/// What laws get wrong in one experiment, drawn with mean square 1.
class LawErrors {
 public:
  /// `left`: of the fitted part of this experiment, or of the one that it errs like.
  LawErrors(const MatrixXd& left, Index frames)
      : frames_(frames), spectrum_(spectrum_beyond_noise(left, frames)) {
    const double size = spectrum_.norm() / std::sqrt(static_cast<double>(spectrum_.size()));
    if (size > 0) spectrum_ /= size;
  }
  MatrixXd draw(std::mt19937_64& random) const { return random_series(spectrum_, frames_, random); }

 private:
  Index frames_;
  MatrixXd spectrum_;
};

std::vector<LawErrors> law_errors(const Remainder& remainder) {
  std::vector<LawErrors> errors;
  for (std::size_t e = 0; e < remainder.fitted.size(); ++e) {
    const Index channels = std::max(remainder.fitted[e].rows(), remainder.held_out[e].rows());
    const MatrixXd& left = remainder.fitted[errs_like(remainder.fitted, e, channels)];
    const Index frames = remainder.fitted[e].cols() + remainder.held_out[e].cols();
    errors.emplace_back(channels_in_turn(left, channels), frames);
  }
  return errors;
}

void add_white(VectorXd& values, double level, std::mt19937_64& random) {
  for (double& value : values) value += level * normal_number(random);
}

}  // namespace

OfParts excess(const Remainder& remainder) {
  return {excess(stacked_where_seen(remainder.fitted, remainder.fitted)),
          excess(stacked_where_seen(remainder.held_out, remainder.held_out))};
}

OfParts chance_of_remainder(const Remainder& remainder, const OfParts& tolerated) {
  const OfParts observed = excess(remainder);
  const Index residuals = stacked_where_seen(remainder.fitted, remainder.fitted).size();
  const Index priors = remainder.fitted_along.rows() - residuals;
  if (priors < 0 || remainder.held_out_along.cols() != remainder.fitted_along.cols())
    throw std::invalid_argument("the derivatives have another size than the residuals");
  // Of J_f = Q R the range Q, and J_h R^-1: what errors along Q do to what is held out.
  MatrixXd scaled = remainder.fitted_along;
  MatrixXd later = remainder.held_out_along;
  for (Index j = 0; j < scaled.cols(); ++j) {
    const double size = scaled.col(j).norm();
    if (size > 0) {
      scaled.col(j) /= size;
      later.col(j) /= size;
    }
  }
  MatrixXd range(scaled.rows(), 0), propagated(later.rows(), 0);
  if (scaled.cols() > 0) {
    range = orthonormal_basis(scaled, 1e-10);
    propagated = later * least_squares(scaled, range);
  }

  const std::vector<LawErrors> errors = law_errors(remainder);
  const double error_of_level =
      std::sqrt(kErrorOfLevel / std::max(1.0, static_cast<double>(residuals)));
  OfParts as_large{1, 1};
  for (int draw = 0; draw < kRandomSeries; ++draw) {
    std::mt19937_64 random(kSeedOfRemainders + static_cast<std::uint64_t>(draw));
    std::vector<MatrixXd> fitted, held_out;
    for (std::size_t e = 0; e < errors.size(); ++e) {
      const MatrixXd error = errors[e].draw(random);
      fitted.emplace_back(error.leftCols(remainder.fitted[e].cols()));
      held_out.emplace_back(error.rightCols(remainder.held_out[e].cols()));
    }
    const double level = 1 + error_of_level * normal_number(random);
    VectorXd of_fitted = VectorXd::Zero(residuals + priors);
    of_fitted.head(residuals) =
        std::sqrt(tolerated.fitted) * stacked_where_seen(fitted, remainder.fitted);
    add_white(of_fitted, level, random);
    VectorXd of_held_out =
        std::sqrt(tolerated.held_out) * stacked_where_seen(held_out, remainder.held_out);
    add_white(of_held_out, level, random);
    const VectorXd along = range.transpose() * of_fitted;
    of_held_out -= propagated * along;
    of_fitted -= range * along;
    as_large.fitted += excess(VectorXd(of_fitted.head(residuals))) >= observed.fitted;
    as_large.held_out += excess(of_held_out) >= observed.held_out;
  }
  return {as_large.fitted / (1 + kRandomSeries), as_large.held_out / (1 + kRandomSeries)};
}

Evaluation evaluated_with_derivatives(const FittedModel& model) {
  Evaluation evaluation = evaluate(*model.problem, model.x, true, true);
  if (!evaluation.ok)
    throw std::runtime_error("what a model leaves cannot be tested: " + evaluation.message);
  return evaluation;
}

Remainder remainder_of(const FittedModel& model, const std::vector<NoiseModel>& noise) {
  return remainder_of(model, noise, evaluated_with_derivatives(model));
}

Remainder remainder_of(const FittedModel& model, const std::vector<NoiseModel>& noise,
                       const Evaluation& evaluation) {
  const Problem& problem = *model.problem;
  Remainder remainder;
  const auto split = [&](std::size_t e, const MatrixXd& residual, MatrixXd& fitted,
                         MatrixXd& held_out) {
    const Index first = model.fit_residual[e].cols();
    if (first > 0) fitted = noise[e].whitened(residual.leftCols(first));
    if (residual.cols() > first)
      held_out = noise[e].whitened(residual.rightCols(residual.cols() - first), first);
  };
  const std::size_t count = model.predicted.size();
  remainder.fitted.resize(count);
  remainder.held_out.resize(count);
  for (std::size_t e = 0; e < count; ++e) {
    const MatrixXd residual = model.predicted[e] - problem.experiments()[e].recording.measured;
    split(e, residual, remainder.fitted[e], remainder.held_out[e]);
  }

  const auto unknowns = static_cast<Index>(problem.unknowns().size());
  const SoftConstraints known = constraints_of(problem, evaluation);
  const Index residuals = stacked_where_seen(remainder.fitted, remainder.fitted).size();
  remainder.fitted_along = MatrixXd::Zero(residuals + known.priors, unknowns);
  remainder.held_out_along =
      MatrixXd::Zero(stacked_where_seen(remainder.held_out, remainder.held_out).size(), unknowns);
  for (Index j = 0; j < unknowns; ++j) {
    std::vector<MatrixXd> fitted(count), held_out(count);
    for (std::size_t e = 0; e < count; ++e) {
      // Where nothing was measured there is no derivative either; no matrix stands for zeros.
      const MatrixXd& measured = problem.experiments()[e].recording.measured;
      MatrixXd along = evaluation.predictions[e].sensitivity[static_cast<std::size_t>(j)];
      if (along.size() == 0) along = MatrixXd::Zero(measured.rows(), measured.cols());
      along = measured.array().isNaN().select(measured, along).eval();
      split(e, along, fitted[e], held_out[e]);
    }
    remainder.fitted_along.col(j).head(residuals) = stacked_where_seen(fitted, remainder.fitted);
    remainder.held_out_along.col(j) = stacked_where_seen(held_out, remainder.held_out);
  }
  if (known.priors > 0)
    remainder.fitted_along.bottomRows(known.priors) =
        known.weight.tail(known.priors).asDiagonal() * known.jacobian.bottomRows(known.priors);
  return remainder;
}

GapTest tested_held_out_gap(const FittedModel& model, const std::vector<NoiseModel>& noise) {
  GapTest gap = held_out_gap(model, noise);
  gap.present = false;
  if (gap.count == 0 || gap.good_enough || gap.size <= 0) return gap;
  const Remainder remainder = remainder_of(model, noise);
  const double no_gap = std::pow(kThresholds.gap_misfit, 2);
  gap.present = chance_of_remainder(remainder, {no_gap, no_gap}).held_out <= kThresholds.chance;
  return gap;
}

bool leaves_no_more(const FittedModel& model, const std::vector<NoiseModel>& noise,
                    const OfParts& tolerated) {
  const GapTest fit = fit_gap(model, noise), held_out = held_out_gap(model, noise);
  const bool in_held_out = held_out.count > 0 && !held_out.good_enough;
  if (!fit.present && !in_held_out) return true;
  const OfParts chance = chance_of_remainder(remainder_of(model, noise), tolerated);
  return (!fit.present || chance.fitted > kThresholds.chance) &&
         (!in_held_out || chance.held_out > kThresholds.chance);
}

bool only_errors_of_laws(const Remainder& left, const Remainder& without_laws, GapIn gap) {
  if (!gap.fitted && !gap.held_out) return true;
  const OfParts with = excess(left), without = excess(without_laws);
  const auto error = [](double before, double after) {
    return std::pow(kThresholds.law_error, 2) * std::max(0.0, before - after);
  };
  const OfParts chance = chance_of_remainder(
      left, {error(without.fitted, with.fitted), error(without.held_out, with.held_out)});
  return (!gap.fitted || chance.fitted > kThresholds.chance) &&
         (!gap.held_out || chance.held_out > kThresholds.chance);
}

bool closes_gap(const FittedModel& model, const FittedModel& without_laws,
                const std::vector<NoiseModel>& noise) {
  const GapIn gap{fit_gap(model, noise).present, tested_held_out_gap(model, noise).present};
  if (!gap.fitted && !gap.held_out) return true;
  return only_errors_of_laws(remainder_of(model, noise), remainder_of(without_laws, noise), gap);
}

bool nearly_closes(const GapTest& fit, const GapTest& before) {
  return !fit.present || fit.misfit <= kThresholds.law_error * before.misfit;
}

}  // namespace catena
