// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/model.hpp"
#include "runtime/signals.hpp"
#include "runtime/trajectory.hpp"

namespace catena {

/// Forces inside the cable over time: links x times, row i - 1 for joint or link i.
struct InternalForces {
  /// Moment of joint i, N m: acts on link i from link i - 1 (from the support for i = 1), positive
  /// towards growing theta.
  Eigen::MatrixXd moment;
  /// Tension of link i at its upper end, N: positive pulls.
  Eigen::MatrixXd tension;
  /// Curvature at joint i, rad/m: the change of angle over the distance between the middles of its
  /// links; at joint 1, the clamp, over half of link 1.
  Eigen::MatrixXd curvature;
  /// What the support exerts on the chain, and what holds the far ends of links where they are held, one column a
  /// time: forces, N, by components side, down and in space across, and moments, N m: in space likewise, in the
  /// plane one, positive towards growing theta. Empty: the table does not tell.
  struct Reaction {
    Eigen::MatrixXd force, moment;
  };
  struct Held {
    int link;  ///< from 1
    Reaction reaction;
  };
  Reaction support;
  std::vector<Held> held;
};

/// The internal forces along a motion of the model: accelerations follow from the equations of
/// motion (3.4) at each time.
///
/// `parameters`: one entry per parameter of the model. `trajectory`: a motion with these
/// parameters, its q, v and z. `signals`: those of the motion.
/// Throws std::runtime_error that names the coordinate and the time where the mass matrix is not
/// positive definite.
///
///     const Model model = Model::built_in(4);
///     const Eigen::VectorXd parameters = Eigen::VectorXd::Constant(model.parameters(), 0.1);
///     Trajectory motion;  // of a simulation
///     const InternalForces inside = internal_forces(model, parameters, motion);
InternalForces internal_forces(const Model& model, const Eigen::VectorXd& parameters,
                               const Trajectory& trajectory, const Signals& signals = {});

}  // namespace catena
