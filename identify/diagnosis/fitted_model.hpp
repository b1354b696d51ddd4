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

/// Whether an experiment only validates and its start is free (a window held out).
bool starts_as_it_fits(const Experiment& experiment);

/// Simulates the whole of every experiment at x. One that starts as it fits has the start that fits it best,
/// everything else as in x.
FittedModel assess(std::shared_ptr<const Problem> problem, const Eigen::VectorXd& x,
                   const LeastSquares& least_squares, const std::atomic<bool>* stop);

/// Fits from `start` and assesses the result. `noise`: of every experiment; least squares make the
/// residuals white with it. Empty: all values count alike. A simulation that stalls fails
/// (DiagnosisThresholds::stall).
FittedModel fit_model(std::shared_ptr<const Problem> problem, const Eigen::VectorXd& start,
                      const std::vector<NoiseModel>& noise, const LeastSquares& least_squares,
                      const std::atomic<bool>* stop);

/// What fit_model makes small, at these unknowns; infinite where the simulation fails. `keep_going`: false
/// at a step of the integrator ends it.
double error_to_fit(const Problem& problem, const Eigen::VectorXd& x,
                    const std::vector<NoiseModel>& noise,
                    const std::function<bool(double)>& keep_going);

/// The noise of every experiment, as the model's residuals show it: estimated_noise().
std::vector<NoiseModel> noise_of(const FittedModel& model);

/// What is left in the fitted part and in what is held out. `noise`: of every experiment.
GapTest fit_gap(const FittedModel& model, const std::vector<NoiseModel>& noise);
GapTest held_out_gap(const FittedModel& model, const std::vector<NoiseModel>& noise);

/// Of every experiment with a fitted part: its residuals made white, channels x frames.
std::vector<Eigen::MatrixXd> white_residuals(const FittedModel& model,
                                             const std::vector<NoiseModel>& noise);

/// Residuals of the fitted part, or derivatives of them, made white, stacked: experiment, frame,
/// channel; those not measured or far off left out.
Eigen::VectorXd stacked(const std::vector<Eigen::MatrixXd>& matrices,
                        const std::vector<Eigen::MatrixXd>& measured_where,
                        const std::vector<NoiseModel>& noise);

/// Derivative of the stacked residuals of the fitted part by all unknowns.
Eigen::MatrixXd fitted_jacobian(const FittedModel& model, const std::vector<NoiseModel>& noise);

/// Root mean square over the fitted and the held-out parts of the difference of two models'
/// predictions, made white.
double prediction_distance(const FittedModel& a, const FittedModel& b,
                           const std::vector<NoiseModel>& noise);

}  // namespace catena
