// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "identify/diagnosis/gap_test.hpp"
#include "identify/fit/fit.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

/// A model of a case at fitted unknowns, and what it leaves unexplained.
struct FittedModel {
  std::shared_ptr<const Problem> problem;
  Eigen::VectorXd x;
  FitStatus status = FitStatus::kNotRun;
  std::string message;
  bool ok = false;  ///< the simulation at x succeeded, held-out parts included

  /// Per experiment, simulated minus measured, channels x frames, NaN where not measured; empty
  /// where the experiment has no such part.
  std::vector<Eigen::MatrixXd> fit_residual, held_out_residual;
  std::vector<Eigen::MatrixXd> predicted;  ///< per experiment, all frames
};

/// Simulates the whole of every experiment at x. An experiment that only validates and whose start
/// is free (a window held out) has the start that fits it best, everything else as in x.
FittedModel assess(std::shared_ptr<const Problem> problem, const Eigen::VectorXd& x,
                   const LeastSquares& least_squares, const std::atomic<bool>* stop);

/// Fits from `start` by least squares and assesses the result.
FittedModel fit_model(std::shared_ptr<const Problem> problem, const Eigen::VectorXd& start,
                      const LeastSquares& least_squares, const std::atomic<bool>* stop);

/// The noise of every experiment from the residuals of the fitted part (of the held-out part where
/// nothing is fitted); not below `smallest`. A noise the case states counts where it is larger.
std::vector<double> noise_levels(const FittedModel& model);

/// What is unusual of the noise of each recording, as the residuals show it where the motion has no
/// power: "run: the tracks look smoothed over 5 frames (...)".
std::vector<std::string> noise_in_words(const FittedModel& model);

GapTest fit_gap(const FittedModel& model, const std::vector<double>& sigmas);
GapTest held_out_gap(const FittedModel& model, const std::vector<double>& sigmas);

/// Residuals of the fitted part in units of the noise, stacked: experiment, frame, channel; those
/// not measured left out.
Eigen::VectorXd stacked(const std::vector<Eigen::MatrixXd>& matrices,
                        const std::vector<Eigen::MatrixXd>& measured_where,
                        const std::vector<double>& sigmas);

/// Derivative of the stacked residuals of the fitted part by all unknowns.
Eigen::MatrixXd fitted_jacobian(const FittedModel& model, const std::vector<double>& sigmas);

/// Root mean square over the fitted and the held-out parts of the difference of two models'
/// predictions, in units of the noise.
double prediction_distance(const FittedModel& a, const FittedModel& b,
                           const std::vector<double>& sigmas);

}  // namespace catena
