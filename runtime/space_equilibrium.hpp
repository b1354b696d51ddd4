// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "runtime/rest_states.hpp"

namespace catena {

/// The end of messages where the search was given up: what to do.
inline constexpr const char* kWithoutEquilibrium =
    "; begin with angles instead and let a damped motion come to rest, make the cable less stiff, "
    "or look at units";

/// hanging_equilibrium of a model in space (rest_states.hpp), whose far end is free or held, in time
/// proportional to the number of links. It begins plumb, or with a catenary between the ends, and goes on by
/// implicit steps of the motion, the velocity taken away after each (pseudo-transient continuation): the
/// matrix of a step is M / tau^2 + dr/dq. tau grows as the residual falls, so that Newton's method is the
/// limit, and equilibria that are not stable are left.
/// A model without a structured matrix gives kNoConvergence. Throws ImpossibleValue where the ends are where
/// the cable does not reach (closed_end).
Equilibrium space_equilibrium(const Model& model, const Eigen::VectorXd& parameters, double t,
                              const Signals& signals);

}  // namespace catena
