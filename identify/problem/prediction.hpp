// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "identify/problem/experiment.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/simulation.hpp"

namespace catena {

/// What the model says about one experiment.
struct Prediction {
  Status status = Status::kNotRun;
  std::string message;
  Eigen::MatrixXd simulated;                 ///< channels x frames, m or rad; NaN where it failed
  std::vector<Eigen::MatrixXd> sensitivity;  ///< one per direction, channels x frames
  Trajectory trajectory;                     ///< at the frames
  /// Windows that are joined: (q, v) at the start, and where the next window starts.
  Eigen::VectorXd first, last;
  Eigen::MatrixXd first_along, last_along;  ///< their derivatives, one column per direction
  bool ok() const { return status == Status::kSuccess; }
};

/// Simulates one experiment from its start and reads off what its sensors would have seen:
///
/// - The model time of frame k is clock(t_k). Before the start it is the start: the cable is held
///   until then.
/// - A marker at arc length s is on the chord of the link it lies on, at its share of the length of
///   the link.
/// - The sensor effects of the model, if it has any, then change what is seen: observe().
///
/// `parameters`: the model's array. `initial`: the state at experiment.spec.start. `all_frames`: else only
/// those to be fitted. `along`: directions in which derivatives of all that are wanted; a vector of a
/// direction that is empty is zero. `keep_going`: asked at every step with its time (s); false ends the
/// simulation. A simulation that fails says so in the status. Throws ImpossibleValue for parameters outside the model's
/// bounds, markers beyond the end of the cable and a clock beyond the signals, std::invalid_argument for
/// sizes that do not fit the model.
Prediction predict_experiment(const Model& model, const SimulationSpec& settings,
                              const Experiment& experiment, const Eigen::VectorXd& parameters,
                              const State& initial, bool all_frames,
                              const std::vector<SensitivityDirection>& along,
                              const std::function<bool(double)>& keep_going);

/// The prediction of an experiment that cannot begin.
Prediction failed_prediction(const Experiment& experiment, const std::string& message);

/// The tolerances and limits of a case as the runtime wants them.
SimulationOptions simulation_options(const SimulationSpec& settings);

}  // namespace catena
