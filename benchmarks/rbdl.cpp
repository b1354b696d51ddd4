// SPDX-License-Identifier: BSD-3-Clause
//
// RBDL's articulated-body algorithm, where RBDL is installed.
#include <rbdl/rbdl.h>

#include "benchmarks/spatial_peer.hpp"

namespace catena::benchmark {
namespace {

namespace rbd = RigidBodyDynamics;

/// Links hang along -z.
rbd::Model chain(const Cable& cable, rbd::JointType joint) {
  rbd::Model model;
  model.gravity = rbd::Math::Vector3d(0, 0, -cable.gravity);
  unsigned parent = 0;
  for (int i = 0; i < cable.links; ++i) {
    const RigidLink link(cable, i);
    const rbd::Body body(link.mass, rbd::Math::Vector3d(0, 0, -link.centre),
                         rbd::Math::Vector3d(link.inertia, link.inertia, link.inertia));
    parent = model.AddBody(
        parent, rbd::Math::Xtrans(rbd::Math::Vector3d(0, 0, i == 0 ? 0.0 : -cable.length)),
        rbd::Joint(joint), body);
  }
  return model;
}

/// A positive turn about y moves links towards -x, which is this engine's +side.
class Rbdl : public Peer {
 public:
  explicit Rbdl(const Cable& cable) : cable_(cable), model_(chain(cable, rbd::JointTypeRevoluteY)) {
    q_.resize(cable.links);
    v_.resize(cable.links);
    a_.resize(cable.links);
    torque_.resize(cable.links);
  }

  const char* name() const override { return "RBDL"; }

  void accelerations(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                     Eigen::VectorXd& a) override {
    q_ = q;
    v_ = v;
    torque_ = -cable_.stiffness * q - cable_.damping * v;
    rbd::ForwardDynamics(model_, q_, v_, torque_, a_);
    a = a_;
  }

 private:
  Cable cable_;
  rbd::Model model_;
  rbd::Math::VectorNd q_, v_, a_, torque_;
};

class SpatialRbdl : public SpatialPeer {
 public:
  explicit SpatialRbdl(const Cable& cable)
      : model_(chain(cable, rbd::JointTypeSpherical)),
        q_(rbd::Math::VectorNd::Zero(model_.q_size)),
        v_(rbd::Math::VectorNd::Zero(model_.qdot_size)),
        a_(v_),
        none_(v_),
        forces_(model_.mBodies.size(), rbd::Math::SpatialVector::Zero()) {}

  const char* name() const override { return "RBDL"; }

  void set(const SpatialState& state) override {
    unsigned i = 0;
    for (const auto& [turn, rate] : ball_joints(state, frame())) {
      v_.segment<3>(3 * i) = rate;
      model_.SetQuaternion(++i, rbd::Math::Quaternion(turn.x(), turn.y(), turn.z(), turn.w()), q_);
    }
  }

  void accelerate(const Vectors& moments) override {
    for (std::size_t i = 0; i < moments.size(); ++i) forces_[i + 1].head<3>() = moments[i];
    rbd::ForwardDynamics(model_, q_, v_, none_, a_, &forces_);
  }

  Vectors relative_accelerations() const override {
    Vectors result;
    for (Eigen::Index i = 0; i < a_.size(); i += 3) result.push_back(a_.segment<3>(i));
    return result;
  }
  Frame frame() const override { return Frame::kOfLink; }

 private:
  rbd::Model model_;
  rbd::Math::VectorNd q_, v_, a_, none_;
  std::vector<rbd::Math::SpatialVector> forces_;  ///< in the world, moments first
};

}  // namespace

std::unique_ptr<Peer> make_rbdl(const Cable& cable) { return std::make_unique<Rbdl>(cable); }

std::unique_ptr<SpatialPeer> make_rbdl_in_space(const Cable& cable) {
  return std::make_unique<SpatialRbdl>(cable);
}

}  // namespace catena::benchmark
