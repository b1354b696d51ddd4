// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "identify/problem/problem.hpp"
#include "runtime/internal_forces.hpp"

namespace catena {

/// A simulation with the positions of its points and the forces inside the cable.
struct Motion {
  Simulation simulation;
  /// m, (links + 2) x times: the support, the far end of each link, the load.
  Eigen::MatrixXd side, down;
  Eigen::MatrixXd across;  ///< in space; empty in the plane
  InternalForces forces;   ///< empty unless the simulation succeeded
};

/// A chain as the sensors of an experiment report it.
struct SeenChain {
  std::vector<double> time;    ///< s, of the frames
  Eigen::MatrixXd side, down;  ///< m, points x frames
  Eigen::MatrixXd across;      ///< in space; empty in the plane
};

/// The motion of a case without a recording, as its file says, energies included; x: its unknowns.
/// `keep_going`: asked at every step with its time (s); false ends the simulation. One that fails says so
/// in its status and has the times before the failure. Throws InputError where the case does not say for
/// how long, and ImpossibleValue for values of x outside of the model's bounds or without a start.
Motion motion_alone(const Problem& problem, const Eigen::VectorXd& x,
                    const std::function<bool(double)>& keep_going = {});

/// The motion of one experiment (an index into problem.experiments()) with the unknowns x, from its
/// start on, at its frames. Throws ImpossibleValue as motion_alone.
Motion motion_of(const Problem& problem, const Eigen::VectorXd& x, int experiment,
                 const std::function<bool(double)>& keep_going = {});

/// What the sensors of one experiment (an index into problem.experiments()) report of the whole
/// chain with the unknowns x: with their clock, tilt, scale, origin and offsets, to be laid over
/// what was measured. Of markers: both ends of every link, then the load. Of angles: the chain of
/// links with the angles reported, from the support. NaN where the simulation failed. Throws as
/// motion_of.
SeenChain seen_chain(const Problem& problem, const Eigen::VectorXd& x, int experiment);

}  // namespace catena
