// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/problem/evaluation.hpp"

namespace catena {

/// One residual: simulated minus measured, m or rad.
struct ResidualIndex {
  int experiment = 0;
  int channel = 0;
  Eigen::Index frame = 0;
};

/// All residuals of one part, in the order of experiment, frame, channel. Points that were not seen
/// are left out.
struct Residuals {
  std::vector<ResidualIndex> index;
  Eigen::VectorXd value;
  Eigen::MatrixXd jacobian;  ///< residuals x unknowns, empty if the evaluation had none
};

/// The residuals of an evaluation of the problem. `evaluation` must be ok.
Residuals residuals_of(const Problem& problem, const Evaluation& evaluation, Part part);

/// What a fit makes small: the residuals of the fitted part. Those of an experiment with a noise model
/// are made white with it, and are then in units of the noise; values far off are left out.
Residuals fitted_residuals(const Problem& problem, const Evaluation& evaluation);

/// Neighbouring residuals of the same marker and frame (side and down), or one angle: together a
/// distance.
struct Distance {
  Eigen::Index first = 0, count = 0;
};
/// In the order of the residuals.
std::vector<Distance> distances_of(const Problem& problem, const Residuals& residuals);

/// What a fit should meet beside the measurements, each with a weight.
struct SoftConstraints {
  Eigen::VectorXd value;     ///< zero where it is met
  Eigen::MatrixXd jacobian;  ///< constraints x unknowns, empty if the evaluation had none
  Eigen::VectorXd weight;    ///< of each in units of the residuals over their noise
  Eigen::Index priors = 0;   ///< the last so many are knowledge with errors of its own
};

/// The shooting defects of joined windows: where each window ends minus where the next one starts;
/// angles (rad), then rates (rad/s), window by window. Empty where no windows are joined.
SoftConstraints shooting_defects_of(const Problem& problem, const Evaluation& evaluation);

/// What the case says of an unknown before the fit: a normal prior, in the unknown's unit.
struct Prior {
  Eigen::Index unknown = 0;
  double measured = 0, deviation = 1;
};
std::vector<Prior> priors_of(const Problem& problem);

/// The shooting defects; then, for each unknown with a standard deviation, the unknown minus what
/// was measured, in its unit.
SoftConstraints constraints_of(const Problem& problem, const Evaluation& evaluation);

/// The noise sigma of each fitted residual, m or rad: the experiment's, or 1 where it states none and
/// where the residuals are white already. Under the likelihood: what the residuals of its channel show,
/// see channels_of.
Eigen::VectorXd noise_of(const Problem& problem, const Residuals& residuals);

/// One channel of one recording, over all its windows.
struct ChannelNoise {
  std::string name;        ///< "recording: marker 3 side"
  Eigen::Index count = 0;  ///< residuals
  double deviation = 0;    ///< their root mean square, m or rad
};
std::vector<ChannelNoise> channels_of(const Problem& problem, const Residuals& residuals);

/// Weights with which the sum of weight * |residual| is (7.1): the mean over the channels of each
/// channel's mean.
Eigen::VectorXd channel_weights(const Problem& problem, const Residuals& residuals);

/// The case's error measure (m, rad; for least squares with noise given: in units of the noise, by
/// the case's loss).
/// Infinite if the evaluation failed; a failed simulation is never a good fit. Constraints count with
/// their weight in the fitted part.
double error_of(const Problem& problem, const Evaluation& evaluation, Part part);

/// The unit of error_of: "m" or "rad", or "1" where it is counted in noise levels.
const char* error_unit(const Problem& problem);

/// The fitted part of an evaluation: what the optimisers work with.
struct Misfit {
  bool ok =
      false;  ///< else the simulation failed or its error is too great a number: infinite, and the rest empty
  Residuals residuals;
  SoftConstraints constraints;
  double error = 0;  ///< error_of
};
Misfit misfit_of(const Problem& problem, const Evaluation& evaluation);

/// The error of a misfit with derivatives and its gradient by the unknowns. The kinks of the two
/// L1-like measures are rounded on a scale of `rounding` (m or rad).
double error_and_gradient(const Problem& problem, const Misfit& misfit, Eigen::VectorXd& gradient,
                          double rounding = 1e-7);

/// How far simulation and measurement are apart in one part of one experiment.
struct Gap {
  int experiment = 0;
  Part part = Part::kFit;
  Eigen::Index count = 0;    ///< residuals
  double rms = 0;            ///< root mean square of the residuals, m or rad
  double mean_absolute = 0;  ///< (7.1)-(7.5)
  double mean_distance = 0;  ///< (6.5), (6.6); angles: mean absolute
  double largest = 0;        ///< largest absolute residual
};

/// Gaps of every experiment and part that has data.
std::vector<Gap> gaps_of(const Problem& problem, const Evaluation& evaluation);

}  // namespace catena
