// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "runtime/model.hpp"
#include "runtime/signals.hpp"

namespace catena {

/// The table of an effect whose clamp_side, clamp_down and clamp_across are all zero at time t (s), "[support]"
/// or "[held_end]", so that the clamp has no direction and the equations have no value; empty if there is
/// none, and for a table for fits, which cannot tell. A vector of the length 1e-155 is taken as zero: its square
/// is. `signals`: those the model asks for.
std::string clamp_without_direction(const Model& model, const Eigen::VectorXd& parameters, double t,
                                    const Signals& signals);

}  // namespace catena
