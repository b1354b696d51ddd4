// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/redrawn_errors.hpp"

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

/// What is left beyond noise of this level, root mean square.
double size_beyond(double level, const MatrixXd& left) {
  return std::sqrt(std::max(0.0, mean_square(left) - level * level));
}

}  // namespace

RedrawnErrors::RedrawnErrors(const std::vector<FittedModel>& models,
                             const std::vector<NoiseModel>& noise)
    : models_(models), noise_(noise), laws_(fitted_errors(models.back(), noise, 1)) {
  for (const FittedModel& model : models) {
    evaluations_.push_back(evaluated_with_derivatives(model));
    MatrixXd along = remainder_of(model, noise, evaluations_.back()).fitted_along;
    rows_.push_back(along.rows());
    fits_.emplace_back(*model.problem, model.x, std::move(along));
  }
  const FittedModel& last = models.back();
  for (std::size_t e = 0; e < noise.size(); ++e) {
    const double size = std::sqrt(mean_square(last.fit_residual[e]));
    const auto part = [&](const MatrixXd& left) {
      return size > 0 ? size_beyond(noise[e].level, left) / size : 0;
    };
    parts_.push_back({part(last.fit_residual[e]), part(last.held_out_residual[e])});
  }
}

RedrawnErrors::Draw RedrawnErrors::draw(std::uint64_t seed) const {
  std::mt19937_64 random(seed);
  const FittedModel& last = models_.back();
  std::vector<MatrixXd> of_laws, all;
  for (std::size_t e = 0; e < laws_.size(); ++e) {
    const Index first = last.fit_residual[e].cols();
    MatrixXd& error = of_laws.emplace_back(laws_[e].draw(random));
    error.leftCols(first) *= parts_[e].fitted;
    error.rightCols(error.cols() - first) *= parts_[e].held_out;
    all.emplace_back(error + drawn_noise(noise_[e], error.rows(), error.cols(), random));
  }
  return {left(all), left(of_laws)};
}

RedrawnErrors::Residuals RedrawnErrors::left(const std::vector<MatrixXd>& error) const {
  const FittedModel& last = models_.back();
  std::vector<MatrixXd> of_fitted;
  for (std::size_t e = 0; e < error.size(); ++e)
    of_fitted.emplace_back(error[e].leftCols(last.fit_residual[e].cols()));
  const VectorXd white = stacked(of_fitted, last.fit_residual, noise_);
  Residuals residuals;
  for (std::size_t m = 0; m < models_.size(); ++m) {
    const FittedModel& model = models_[m];
    VectorXd to_fit = VectorXd::Zero(rows_[m]);
    to_fit.head(white.size()) = white;
    const VectorXd step = fits_[m](to_fit);
    auto& fitted = residuals.fitted.emplace_back();
    auto& held_out = residuals.held_out.emplace_back();
    for (std::size_t e = 0; e < error.size(); ++e) {
      MatrixXd here = model.predicted[e] - last.predicted[e] + error[e];
      const auto& along = evaluations_[m].predictions[e].sensitivity;
      for (Index j = 0; j < step.size(); ++j)
        if (along[static_cast<std::size_t>(j)].size() > 0)
          here -= step[j] * along[static_cast<std::size_t>(j)];
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
