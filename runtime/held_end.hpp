// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "runtime/model.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/signals.hpp"
#include "runtime/state.hpp"

namespace catena {

/// A held end needs a start that satisfies its constraint, which a motion only keeps. This function finds one. Models
/// in space with table().gap only.
///
/// It adds one vector nu to all link directions and normalises them. nu minimises the convex function
/// sum l_i |q_i + nu| - nu . (end - support), and then closes the gap, unless it is a -q_i. Parallel links do not
/// determine a shape. They are bent first, about as a cable that sags, in the plane of the links and of the line from
/// the support to the end. The rates are made perpendicular to the directions, and another vector is added to them in
/// the same way, so that the end moves with what holds it.
///
///     const Model model = Model::load("held.so");  // in space, its far end held
///     const Eigen::VectorXd parameters = model.default_parameters();
///     const State start = closed_end(model, parameters, State::zero(model), 0.0, {});
///
/// `open`: any state; q and v need not fit. t: s. `signals`: those the model asks for.
/// Throws ImpossibleValue where the distance of the ends is not between 2 max l - sum l and sum l, and where
/// the gap is not closed.
State closed_end(const Model& model, const Eigen::VectorXd& parameters, const State& open, double t,
                 const Signals& signals);

/// Its derivative (q and v) along a change of q and v of `open`. `closed`: what closed_end made of it.
/// Vectors that are empty are zero.
void close_direction(const Model& model, const Eigen::VectorXd& parameters, const State& open,
                     const State& closed, SensitivityDirection& direction);

}  // namespace catena
