// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/prediction_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/parallel.hpp"
#include "common/special_values.hpp"
#include "identify/diagnosis/bounded_fit.hpp"
#include "identify/diagnosis/fitted_errors.hpp"
#include "identify/diagnosis/remainder.hpp"
#include "identify/diagnosis/stacking.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/fit/estimated_noise.hpp"
#include "identify/noise/cosine_spectrum.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::uint64_t kSeedOfPredictions = 5;

/// Sums of the squares of errors where something was measured, by part.
struct Squares {
  double held_out = 0, sealed = 0, held_out_count = 0, sealed_count = 0;
};

/// `error`: of every experiment, channels x frames.
Squares squares_of(const FittedModel& model, const std::vector<MatrixXd>& error) {
  Squares sum;
  for (std::size_t e = 0; e < error.size(); ++e) {
    const Experiment& experiment = model.problem->experiments()[e];
    if (starts_as_it_fits(experiment)) continue;
    const MatrixXd& measured = experiment.recording.measured;
    const MatrixXd& sealed = experiment.recording.sealed;
    const Index first = model.fit_residual[e].cols();
    for (Index k = first; k < error[e].cols(); ++k)
      for (Index c = 0; c < error[e].rows(); ++c) {
        const double square = error[e](c, k) * error[e](c, k);
        if (!std::isnan(measured(c, k))) {
          sum.held_out += square;
          sum.held_out_count += 1;
        } else if (sealed.size() > 0 && !std::isnan(sealed(c, k))) {
          sum.sealed += square;
          sum.sealed_count += 1;
        }
      }
  }
  return sum;
}

/// What was measured, the sealed part too.
MatrixXd everything_measured(const Recording& recording) {
  if (recording.sealed.size() == 0) return recording.measured;
  return recording.measured.array().isNaN().select(recording.sealed, recording.measured);
}

/// Of what a model leaves.
Squares squares_left(const FittedModel& model) {
  std::vector<MatrixXd> left;
  for (std::size_t e = 0; e < model.predicted.size(); ++e)
    left.push_back(model.predicted[e] -
                   everything_measured(model.problem->experiments()[e].recording));
  return squares_of(model, left);
}

/// Recordings that the model itself makes, with errors like those it leaves where it was fitted, fitted again.
class DrawnFits {
 public:
  DrawnFits(const FittedModel& model, const std::vector<NoiseModel>& noise,
            DiagnosisContext& context)
      : model_(model),
        noise_(noise),
        context_(context),
        remainder_(remainder_of(model, noise)),
        linear_(*model.problem, model.x, remainder_.fitted_along) {
    const auto values = static_cast<double>(stacked_fitted(remainder_.fitted).size());
    const double freedom = std::max(1.0, values - static_cast<double>(model.x.size()));
    errors_ = fitted_errors(model, noise, std::sqrt(values / freedom));
    doubt_of_size_ =
        std::sqrt(autocorrelation_factor(white_residuals(model, noise)) / (2 * freedom));
  }

  /// What the model that is fitted to such a recording gets wrong of it, channels x frames of every experiment;
  /// infinite where no simulation succeeds.
  std::vector<MatrixXd> error(std::size_t draw) const {
    std::mt19937_64 random(kSeedOfPredictions + draw);
    std::vector<MatrixXd> error;
    const double size = std::exp(doubt_of_size_ * normal_number(random));
    for (const FittedErrors& each : errors_) error.push_back(size * each.draw(random));
    VectorXd drawn = white(error);
    for (double& prior : drawn.tail(priors())) prior = normal_number(random);

    const VectorXd step = linear_(drawn);
    Evaluation moved = evaluated(model_.x + step);
    const double should_leave = linear_.left(drawn);
    const double leaves = moved.ok ? white(without(error, moved)).squaredNorm() : kInfinite;
    // More than derivatives say, by what an error of one standard deviation of each unknown leaves.
    if (leaves > should_leave + static_cast<double>(model_.x.size()))
      moved = evaluated(refitted(error, leaves < drawn.squaredNorm() ? step : 0 * step));
    if (moved.ok) return without(error, moved);
    for (MatrixXd& each : error) each.setConstant(kInfinite);
    return error;
  }

 private:
  Index priors() const {
    return remainder_.fitted_along.rows() - stacked_fitted(remainder_.fitted).size();
  }
  VectorXd stacked_fitted(const std::vector<MatrixXd>& parts) const {
    return stacked_where_seen(parts, remainder_.fitted);
  }

  /// The fitted part, white, and zeros for the priors.
  VectorXd white(const std::vector<MatrixXd>& error) const {
    std::vector<MatrixXd> parts(error.size());
    for (std::size_t e = 0; e < error.size(); ++e)
      if (const Index fitted = remainder_.fitted[e].cols(); fitted > 0)
        parts[e] = noise_[e].whitened(error[e].leftCols(fitted));
    VectorXd stacked = VectorXd::Zero(remainder_.fitted_along.rows());
    const VectorXd values = stacked_fitted(parts);
    stacked.head(values.size()) = values;
    return stacked;
  }

  Evaluation evaluated(const VectorXd& x) const {
    return evaluate(*model_.problem, x, true, false,
                    [this](double) { return !context_.stopped(); });
  }

  /// How far `moved` is from the model's prediction with this error.
  std::vector<MatrixXd> without(std::vector<MatrixXd> error, const Evaluation& moved) const {
    for (std::size_t e = 0; e < error.size(); ++e)
      error[e] = moved.predictions[e].simulated - model_.predicted[e] - error[e];
    return error;
  }

  /// The unknowns, fitted to the model's prediction with this error, beginning at a step from its own.
  VectorXd refitted(const std::vector<MatrixXd>& error, const VectorXd& step) const {
    std::vector<Experiment> experiments = model_.problem->experiments();
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      MatrixXd& measured = experiments[e].recording.measured;
      measured = measured.array().isNaN().select(measured, model_.predicted[e] + error[e]).eval();
    }
    const Problem problem(model_.problem->the_case(), model_.problem->model(),
                          std::move(experiments));
    FitOptions options;
    options.start = model_.x + step;
    options.stop = context_.stop;
    const FitResult result = context_.least_squares(with_noise(problem, noise_), options);
    return result.x.size() > 0 ? result.x : model_.x;
  }

  const FittedModel& model_;
  const std::vector<NoiseModel>& noise_;
  DiagnosisContext& context_;
  Remainder remainder_;
  BoundedFit linear_;
  std::vector<FittedErrors> errors_;
  double doubt_of_size_ = 0;  ///< standard deviation of its logarithm
};

}  // namespace

double PredictionError::high_with_errors_of_laws() const {
  return std::hypot(high, kThresholds.law_error * explained);
}

PredictionErrors prediction_errors(const FittedModel& model, const FittedModel& without_laws,
                                   const std::vector<NoiseModel>& noise,
                                   DiagnosisContext& context) {
  const Squares left = squares_left(model), left_without_laws = squares_left(without_laws);
  if (left.held_out_count + left.sealed_count == 0) return {};

  const DrawnFits fits(model, noise, context);
  const auto draws =
      static_cast<std::size_t>(std::lround(2 / (1 - kThresholds.prediction_level)) - 1);
  std::vector<Squares> drawn(draws);
  context.begin("drawing what predictions may leave", draws);
  in_parallel(draws, context.threads, [&](std::size_t draw) {
    drawn[draw] = squares_of(model, fits.error(draw));
    context.end_task();
  });
  context.stop_if_asked();
  const auto error_of = [&](double Squares::*sum, double count) {
    if (count == 0) return PredictionError{};
    std::vector<double> sums;
    sums.reserve(draws);
    for (const Squares& squares : drawn) sums.push_back(squares.*sum);
    const auto [least, largest] = std::minmax_element(sums.begin(), sums.end());
    const double explained = std::max(0.0, left_without_laws.*sum - left.*sum);
    return PredictionError{std::sqrt(left.*sum / count), std::sqrt(*least / count),
                           std::sqrt(*largest / count), std::sqrt(explained / count)};
  };
  return {error_of(&Squares::held_out, left.held_out_count),
          error_of(&Squares::sealed, left.sealed_count)};
}

std::vector<std::string> words_of(const PredictionErrors& errors, double fitted,
                                  const std::string& milli_unit) {
  std::vector<std::string> words;
  for (const auto& [part, error] : {std::pair("The part held out", &errors.held_out),
                                    std::pair("The sealed part", &errors.sealed)}) {
    const bool expected = error->observed <= error->high;
    const bool of_laws = !expected && error->observed <= error->high_with_errors_of_laws();
    const bool far = error->observed > kThresholds.undetermined * fitted;
    if (std::isnan(error->observed) || (!far && (expected || of_laws))) continue;
    std::string sentence =
        fmt::format("{} is predicted {:.3g} {} off; {:.3g} to {:.3g} {} are expected ({:.0f} %)",
                    part, 1e3 * error->observed, milli_unit, 1e3 * error->low, 1e3 * error->high,
                    milli_unit, 100 * kThresholds.prediction_level);
    if (of_laws)
      sentence +=
          fmt::format(", but laws that are {:.2g} % off there leave as much",
                      100 * std::sqrt(std::pow(error->observed, 2) - std::pow(error->high, 2)) /
                          error->explained);
    words.push_back(sentence + (expected || of_laws
                                    ? ": the fitted part does not determine this motion."
                                    : ": the model lacks something there."));
  }
  return words;
}

}  // namespace catena
