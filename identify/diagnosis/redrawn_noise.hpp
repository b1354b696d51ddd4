// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "identify/diagnosis/bounded_fit.hpp"
#include "identify/diagnosis/fitted_model.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {

/// What models of the same recordings would have left with other noise.
///
/// A recording is what the last model predicts, what it lacks, and noise, which is drawn. What it lacks is what it
/// leaves, made so much smaller that the noise makes up for it, in the fitted part and in what is held out. Each model
/// is fitted by one linearised step, and predicts the rest:
///
///     r = y - y_last + d + e - J J_f^+ e_f
///
/// y is a model's prediction, d what the last one lacks, e the noise, J the derivative of y by the unknowns; f is the
/// fitted part.
class RedrawnNoise {
 public:
  /// `models`: fitted with this noise. Throws std::runtime_error where a simulation with derivatives fails.
  RedrawnNoise(const std::vector<FittedModel>& models, const std::vector<NoiseModel>& noise);

  /// Of every model: the residuals of every experiment, as FittedModel has them.
  struct Residuals {
    std::vector<std::vector<Eigen::MatrixXd>> fitted, held_out;
  };
  Residuals draw(std::uint64_t seed) const;
  Residuals without_noise() const;

 private:
  /// `step`: of each model's unknowns.
  Residuals left(const std::vector<Eigen::MatrixXd>& error,
                 const std::vector<Eigen::VectorXd>& step) const;

  const std::vector<FittedModel>& models_;
  const std::vector<NoiseModel>& noise_;
  std::vector<Eigen::MatrixXd> lacking_;  // of every experiment, channels x frames
  std::vector<Evaluation> evaluations_;   // of every model, with derivatives
  std::vector<BoundedFit> fits_;
  std::vector<Eigen::Index> rows_;  // of what is fitted, priors too
};

}  // namespace catena
