// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "runtime/model.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/signals.hpp"
#include "runtime/state.hpp"

namespace catena {

/// The constraint of a held end keeps a gap closed, but does not close it: a motion starts from a state
/// that is closed. Models in space with table().gap only.
///
/// Of all links the same vector nu is added to the directions, and the sums are given the length one: nu is
/// the least of sum l_i |q_i + nu| - nu . (end - support), which is convex. It closes the gap where it is no
/// -q_i. Parallel links say nothing of a shape, so they are bent before: about as a cable that sags, in the
/// plane of the links and of the line from the support to the end. To the rates, made perpendicular to the
/// directions, another vector is added in the same way, so that the end moves as what holds it.
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
