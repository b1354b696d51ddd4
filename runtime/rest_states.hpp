// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "runtime/positions.hpp"
#include "runtime/signals.hpp"
#include "runtime/state.hpp"
#include "runtime/status.hpp"

namespace catena {

/// States at rest from which a simulation can start. Rates are zero, and so are extra states and
/// the coordinates that effects add. A chain in space lies in the plane of side and down.
///
///     const Model model = Model::built_in(12);
///     const State askew = straight(model, 0.6);                      // every link at 0.6 rad
///     const Eigen::VectorXd parameters = Eigen::VectorXd::Constant(model.parameters(), 0.2);
///     const State held = catenary(model, parameters, {1.2, 1.8});    // side, down of the end, m

/// Every link at `angle` (rad) from the downward vertical.
State straight(const Model& model, double angle);

/// Link i at angles[i] (rad; one entry per link). Throws std::invalid_argument on another number of
/// angles and on an angle that is not finite.
State from_angles(const Model& model, const Eigen::VectorXd& angles);

/// Where the links point, and how they turn, in space. Link i leaves the downward vertical by angle[i]
/// (rad) in the vertical plane of azimuth[i] (rad), which counts from side to across, and that plane by
/// out_of_plane[i] (rad) towards growing azimuth. One entry per link each; out_of_plane and its rate
/// may be empty: zero. Angle and out_of_plane are coordinates of any direction but those at
/// out_of_plane = pi/2; of the vertical, too.
struct LinkDirections {
  Eigen::VectorXd angle, azimuth;
  Eigen::VectorXd angle_rate, azimuth_rate;  ///< rad/s
  Eigen::VectorXd out_of_plane = {};
  Eigen::VectorXd out_of_plane_rate = {};  ///< rad/s
};

/// The state of a model in space with these directions, |q| = 1. Sizes are not checked.
State from_directions(const Model& model, const LinkDirections& links);

/// Its derivative (q and v) along a change of the angles, out of the plane too, and of their rates.
/// The azimuths stay as they are: those of `along` are not read. What is empty there is zero.
State from_directions_tangent(const Model& model, const LinkDirections& links,
                              const LinkDirections& along);

/// How a chain of rigid links is laid along a curve.
enum class CatenaryFit {
  /// The ends of each link lie, by arc length, on the curve; the link has the direction of the
  /// chord between them. A chord is a little shorter than its arc, so the free end lies a little
  /// beyond the held point.
  kChords,
  /// The same with a neighbouring catenary, chosen so that the free end lies on the held point.
  kEndHeld,
};

/// The static catenary (2.53) of the cable's length between the support, which is the origin, and
/// `held` (m), where the free end is held. Link lengths are those of `parameters` (one entry per
/// parameter of the model); other parameters are not used, as (2.53) is a uniform cable without
/// stiffness. If the held point is below the support, the cable goes straight down and up again.
/// Throws ImpossibleValue on parameters outside the bounds of the model, if the held point is
/// farther away than the cable is long or is not finite, and if kEndHeld finds no neighbouring catenary (few links).
State catenary(const Model& model, const Eigen::VectorXd& parameters, const CablePoint& held,
               CatenaryFit fit = CatenaryFit::kEndHeld);

struct Equilibrium {
  Status status = Status::kNotRun;  ///< kSuccess, kNoConvergence or kSingular
  std::string message;              ///< empty on success
  State state;                      ///< at rest
};

/// The equilibrium at time t (s): r = 0 with v = a = 0 and extra states zero, by Newton's method
/// from the chain that hangs straight down; in space by implicit steps (space_equilibrium.hpp), also in a
/// current and between two ends. `parameters`: one entry per parameter of the model;
/// `signals`: the channels that the model asks for. Whether the equilibrium is stable is not
/// examined. Throws std::invalid_argument on parameters that the model refuses
/// (Model::check_parameters), and ImpossibleValue where a held end is where the cable does not reach.
Equilibrium hanging_equilibrium(const Model& model, const Eigen::VectorXd& parameters,
                                double t = 0.0, const Signals& signals = {});

}  // namespace catena
