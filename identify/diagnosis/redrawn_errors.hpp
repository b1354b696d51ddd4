// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "identify/diagnosis/bounded_fit.hpp"
#include "identify/diagnosis/fitted_errors.hpp"
#include "identify/diagnosis/fitted_model.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {

/// What models of the same recordings would have left with other errors.
///
/// A recording is what the last model predicts, noise, and what its laws get wrong: random series with the spectrum of
/// what it leaves (fitted_errors.hpp), and the size of what is left beyond the noise. Each model is fitted by one
/// linearised step, and predicts the rest:
///
///     r = y - y_last + e - J J_f^+ e_f
///
/// y is a model's prediction, e the errors, J the derivative of y by the unknowns; f is the fitted part.
class RedrawnErrors {
 public:
  /// `models`: fitted with this noise. Throws std::runtime_error where a simulation with derivatives fails.
  RedrawnErrors(const std::vector<FittedModel>& models, const std::vector<NoiseModel>& noise);

  /// Of every model: the residuals of every experiment, as FittedModel has them.
  struct Residuals {
    std::vector<std::vector<Eigen::MatrixXd>> fitted, held_out;
  };
  /// With the same errors of laws.
  struct Draw {
    Residuals with_noise, without_noise;
  };
  Draw draw(std::uint64_t seed) const;

 private:
  /// `error`: of every experiment, channels x frames.
  Residuals left(const std::vector<Eigen::MatrixXd>& error) const;

  /// Sizes of what laws get wrong in one experiment, over what is left where it was fitted.
  struct Parts {
    double fitted, held_out;
  };

  const std::vector<FittedModel>& models_;
  const std::vector<NoiseModel>& noise_;
  std::vector<FittedErrors> laws_;       // of every experiment
  std::vector<Parts> parts_;             // of every experiment
  std::vector<Evaluation> evaluations_;  // of every model, with derivatives
  std::vector<BoundedFit> fits_;
  std::vector<Eigen::Index> rows_;  // of what is fitted, priors too
};

}  // namespace catena
