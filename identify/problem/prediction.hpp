// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/problem/problem.hpp"

namespace catena {

/// Simulates one experiment from its start and reads off what its sensors would have seen:
///
///   model time of frame k      tau_k = clock(t_k); before the start, the start itself (held until
///   then) marker at arc length s     on the chord of the link it lies on, at its share of the
///   link's length sensor effects             observe(), if the model has any
///
/// and the derivatives of all that along the directions given.
Prediction predict_experiment(const Model& model, const SimulationSpec& settings,
                              const Experiment& experiment, const Eigen::VectorXd& parameters,
                              const State& initial, bool all_frames, const std::vector<Seed>& along,
                              const std::function<bool()>& keep_going);

SimulationOptions simulation_options(const SimulationSpec& settings);

}  // namespace catena
