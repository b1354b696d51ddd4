// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/redrawn_noise.hpp"

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/remainder.hpp"
#include "identify/diagnosis/stacking.hpp"
#include "identify/noise/drawn_noise.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Of what is left, the share of its mean square that noise of this level has; 1 where nothing is left.
double share_of_noise(const MatrixXd& left, double level) {
  double squares = 0, count = 0;
  for (const double value : left.reshaped())
    if (!std::isnan(value)) squares += value * value, count += 1;
  return squares > 0 ? std::min(1.0, level * level * count / squares) : 1.0;
}

}  // namespace

RedrawnNoise::RedrawnNoise(const std::vector<FittedModel>& models,
                           const std::vector<NoiseModel>& noise)
    : models_(models), noise_(noise) {
  for (const FittedModel& model : models) {
    evaluations_.push_back(evaluated_with_derivatives(model));
    MatrixXd along = remainder_of(model, noise, evaluations_.back()).fitted_along;
    rows_.push_back(along.rows());
    fits_.emplace_back(*model.problem, model.x, std::move(along));
  }
  const FittedModel& last = models.back();
  for (std::size_t e = 0; e < noise.size(); ++e) {
    const double in_fitted = share_of_noise(last.fit_residual[e], noise[e].level);
    const double later = share_of_noise(last.held_out_residual[e], noise[e].level);
    MatrixXd& lacking = lacking_.emplace_back(last.predicted[e].rows(), last.predicted[e].cols());
    lacking << std::sqrt(1 - in_fitted) * last.fit_residual[e],
        std::sqrt(1 - later) * last.held_out_residual[e];
  }
}

RedrawnNoise::Residuals RedrawnNoise::draw(std::uint64_t seed) const {
  std::mt19937_64 random(seed);
  const FittedModel& last = models_.back();
  std::vector<MatrixXd> error, fitted;
  for (std::size_t e = 0; e < noise_.size(); ++e) {
    error.push_back(
        drawn_noise(noise_[e], last.predicted[e].rows(), last.predicted[e].cols(), random));
    fitted.emplace_back(error.back().leftCols(last.fit_residual[e].cols()));
  }
  const VectorXd white = stacked(fitted, last.fit_residual, noise_);
  std::vector<VectorXd> steps;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    VectorXd to_fit = VectorXd::Zero(rows_[m]);
    to_fit.head(white.size()) = white;
    steps.push_back(fits_[m](to_fit));
  }
  return left(error, steps);
}

RedrawnNoise::Residuals RedrawnNoise::without_noise() const {
  std::vector<MatrixXd> none;
  std::vector<VectorXd> steps;
  for (const MatrixXd& predicted : models_.back().predicted)
    none.emplace_back(MatrixXd::Zero(predicted.rows(), predicted.cols()));
  for (const FittedModel& model : models_) steps.emplace_back(VectorXd::Zero(model.x.size()));
  return left(none, steps);
}

RedrawnNoise::Residuals RedrawnNoise::left(const std::vector<MatrixXd>& error,
                                           const std::vector<VectorXd>& step) const {
  const FittedModel& last = models_.back();
  Residuals residuals;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const FittedModel& model = models_[m];
    auto& fitted = residuals.fitted.emplace_back();
    auto& held_out = residuals.held_out.emplace_back();
    for (std::size_t e = 0; e < error.size(); ++e) {
      MatrixXd here = model.predicted[e] - last.predicted[e] + lacking_[e] + error[e];
      const auto& along = evaluations_[m].predictions[e].sensitivity;
      for (Index j = 0; j < step[m].size(); ++j)
        if (along[static_cast<std::size_t>(j)].size() > 0)
          here -= step[m][j] * along[static_cast<std::size_t>(j)];
      const MatrixXd& measured = model.problem->experiments()[e].recording.measured;
      here = measured.array().isNaN().select(measured, here).eval();
      const Index first = model.fit_residual[e].cols();
      fitted.emplace_back(here.leftCols(first));
      held_out.emplace_back(here.rightCols(here.cols() - first));
    }
  }
  return residuals;
}

}  // namespace catena
