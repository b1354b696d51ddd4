// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <vector>

#include "benchmarks/peer.hpp"

namespace catena::benchmark {

using Vectors = std::vector<Eigen::Vector3d>;  ///< one for each link, in the world

/// A chain in space as rigid bodies have it. World: x side, y across, z up; a link hangs along its own -z.
/// Links do not spin, and nothing makes them: so what they resist about their own axes is of no effect.
struct SpatialState {
  std::vector<Eigen::Matrix3d> rotation;  ///< from a link to the world
  Vectors angular_velocity;               ///< rad/s
};

/// A start whose links leave the plane: the angles of Cable::start(), azimuths from 0 to 0.5 rad, which grow by
/// 0.8 rad/s.
SpatialState askew_start(const Cable& cable);

/// Of a model in space: from its coordinates, and the second derivatives of these.
SpatialState spatial_state(const Eigen::VectorXd& q, const Eigen::VectorXd& v);
Eigen::VectorXd second_derivatives(const SpatialState& state, const Vectors& angular_acceleration);

/// Moments (N m) of bending and damping on each link, those along it left out: of a cable hinged at its
/// support (Cable::hinged).
Vectors moments(const Cable& cable, const SpatialState& state);

/// Far ends of the links, m, side, across and up of one after the other.
Eigen::VectorXd joints(const Cable& cable, const SpatialState& state);

/// A general engine with the same chain, of ball joints.
class SpatialPeer {
 public:
  virtual ~SpatialPeer() = default;
  virtual const char* name() const = 0;
  virtual void set(const SpatialState& state) = 0;
  /// Forward dynamics at what was set, `moments` among its forces. This is what is timed.
  virtual void accelerate(const Vectors& moments) = 0;
  /// What it found: relative angular accelerations of the joints, as the engine has them, and the frame of
  /// their components.
  virtual Vectors relative_accelerations() const = 0;
  enum class Frame { kOfParent, kOfLink };
  virtual Frame frame() const = 0;
};

/// What a ball joint turns by, from the link above to its own, and how fast (rad/s, in the frame asked for).
struct BallJoint {
  Eigen::Quaterniond turn;
  Eigen::Vector3d rate;
};
std::vector<BallJoint> ball_joints(const SpatialState& state, SpatialPeer::Frame frame);

/// In the world, from what an engine found.
Vectors angular_accelerations(const SpatialState& state, const SpatialPeer& peer);

std::unique_ptr<SpatialPeer> make_mujoco_in_space(const Cable& cable);
std::unique_ptr<SpatialPeer> make_simbody_in_space(const Cable& cable);
// If compiled with CATENA_BENCHMARK_RBDL and CATENA_BENCHMARK_PINOCCHIO:
std::unique_ptr<SpatialPeer> make_rbdl_in_space(const Cable& cable);
std::unique_ptr<SpatialPeer> make_pinocchio_in_space(const Cable& cable);

/// Simbody's CPodes (BDF) at the given accuracy, from askew_start(); q holds joints(), one column per time.
Solution simulate_simbody_in_space(const Cable& cable, const std::vector<double>& times,
                                   double accuracy);

}  // namespace catena::benchmark
