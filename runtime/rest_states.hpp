// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "runtime/positions.hpp"
#include "runtime/signals.hpp"
#include "runtime/state.hpp"
#include "runtime/status.hpp"

namespace catena {

/// At rest, every link at `angle` (rad) from the downward vertical.
State straight(const Model& model, double angle);

/// At rest, link i at angles[i] (rad). Throws std::invalid_argument unless there is one per link,
/// all finite.
State from_angles(const Model& model, const Eigen::VectorXd& angles);

/// How a chain of rigid links is laid along a curve.
enum class CatenaryFit {
  /// Link i has the direction of the chord between the points of the curve at the arc lengths of
  /// its
  /// ends. A chord is a little shorter than its arc, so the free end comes to lie a little beyond
  /// the
  /// held point.
  kChords,
  /// The same chords of a neighbouring catenary, chosen so that the free end lies on the held
  /// point.
  kEndHeld,
};

/// At rest on the static catenary (2.53) of the cable's length between the support at the origin
/// and `held` (m), where its free end is held. Link lengths are exact. (2.53) is a uniform cable
/// without stiffness; masses are not looked at. Right below the support the catenary is folded:
/// straight down and up again. Throws std::invalid_argument if the held point is farther away than
/// the cable is long, or not finite.
State catenary(const Model& model, const Eigen::VectorXd& parameters, const CablePoint& held,
               CatenaryFit fit = CatenaryFit::kEndHeld);

struct Equilibrium {
  Status status = Status::kNotRun;
  std::string message;  ///< empty on success
  State state;          ///< at rest
};

/// Where the chain hangs still at time t: r = 0 with v = a = 0, extra states zero, found by
/// Newton's method from hanging straight down. Stable or not is not examined.
Equilibrium hanging_equilibrium(const Model& model, const Eigen::VectorXd& parameters,
                                double t = 0.0, const Signals& signals = {});

}  // namespace catena
