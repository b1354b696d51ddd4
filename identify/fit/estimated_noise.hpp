// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "identify/fit/fit.hpp"
#include "identify/noise/noise_model.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

// Noise that nobody stated, and fits that make residuals white with it: feasible generalised least
// squares.

/// The noise of every experiment: that of its recording, as the residuals show it (of the fitted
/// part; of windows that are held out whole, too). A noise the case states counts where it is larger.
/// `predicted`: of every experiment, channels x frames, at least those that are fitted; empty: not
/// looked at, its level is zero.
std::vector<NoiseModel> estimated_noise(const Problem& problem,
                                        const std::vector<Eigen::MatrixXd>& predicted);

/// What is unusual of the noise of each recording: "run: the tracks look smoothed over 5 frames".
std::vector<std::string> noise_in_words(const Problem& problem,
                                        const std::vector<NoiseModel>& noise);
/// The same of the noise that the problem makes residuals white with; nothing where it does not.
std::vector<std::string> noise_in_words(const Problem& problem);

/// The problem whose least squares make the residuals white with this noise, one for each experiment;
/// those whose level is zero stay as they are.
Problem with_noise(const Problem& problem, const std::vector<NoiseModel>& noise);

/// The same with the noise that the fitted residuals at `x` show. Throws InputError where an experiment has too
/// few frames to show any; std::runtime_error where the simulation fails.
Problem with_noise_seen_at(const Problem& problem, const Eigen::VectorXd& x);

/// What is fitted first where the case wants the noise estimated: all residuals count alike, without a
/// loss or priors, as both are in units of the noise. Else the problem itself.
std::shared_ptr<const Problem> before_noise_is_known(std::shared_ptr<const Problem> problem);

/// A fit, and the problem with the noise that weighed its residuals.
struct WeighedFit {
  std::shared_ptr<const Problem> problem;
  FitResult fit;
};

/// The fit that the case asks for, from the end of `first`, the fit of before_noise_is_known(): where
/// the noise is to be estimated, a second one with it; else `first` itself. Its errors are in units
/// of the noise, its effort is that of both. `options` as for fit(); nothing is recalled or recorded.
WeighedFit fit_with_noise(std::shared_ptr<const Problem> problem, FitResult first,
                          const FitOptions& options, const LeastSquares& least_squares);

}  // namespace catena
