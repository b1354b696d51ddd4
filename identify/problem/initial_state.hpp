// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "identify/cases/case.hpp"
#include "identify/recordings/recording.hpp"
#include "runtime/model.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/signals.hpp"
#include "runtime/state.hpp"

namespace catena {

/// The linear map from coefficients to the angle (or rate) of each link: links x coefficients.
/// `lengths`: of the links, m.
Eigen::MatrixXd shape_basis(Shape shape, int links, int terms, const Eigen::VectorXd& lengths);

/// Angles of the links at the start, rad, for the shapes that have coefficients.
Eigen::VectorXd initial_angles(const InitialSpec& initial, const Eigen::VectorXd& lengths);
/// Their rates, rad/s.
Eigen::VectorXd initial_rates(const InitialSpec& initial, const Eigen::VectorXd& lengths);

/// The state of the model as `initial` describes it, at time `time` (s). `parameters`: the model's
/// array. `signals`: for the hanging equilibrium. Throws ImpossibleValue where there is no such state
/// (held farther away than the cable is long, no equilibrium).
State state_at_start(const Model& model, const Eigen::VectorXd& parameters,
                     const InitialSpec& initial, const Signals& signals, double time);

/// The derivative of that state by one coefficient: an index into the lists of
/// InitialSpec::coefficient_lists(), end to end. A vector that is empty is zero. Throws as
/// state_at_start.
SensitivityDirection start_along(const Model& model, const Eigen::VectorXd& parameters,
                                 InitialSpec initial, const Signals& signals, double time,
                                 int coefficient);

/// Throws InputError (at `where`) if there is no such state, or no motion from there.
void check_start(const Model& model, const Eigen::VectorXd& parameters, const InitialSpec& initial,
                 const Signals& signals, double time, const std::string& where);

/// Finds the coefficients that `initial` leaves open, from the first frames of a recording: angles through
/// the first frame (least squares on the positions, with the least bending that explains them), rates from a
/// line through the first few frames. In space the azimuths come with the angles: one vertical plane for all
/// links, but one of its own for a link that points far out of it where the shape is kAngles. The support is
/// at the origin. `lengths`: of the links, m. Throws InputError if the recording has nothing there.
void complete_from_data(InitialSpec& initial, const Recording& recording,
                        const Eigen::VectorXd& lengths);

}  // namespace catena
