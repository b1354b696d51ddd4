// SPDX-License-Identifier: BSD-3-Clause
//
// RBDL's articulated-body algorithm, where RBDL is installed.
#include <rbdl/rbdl.h>

#include "benchmarks/peer.hpp"

namespace catena::benchmark {
namespace {

namespace rbd = RigidBodyDynamics;

/// Links hang along -z; a positive turn about y moves them towards -x, which is this engine's
/// +side.
class Rbdl : public Peer {
 public:
  explicit Rbdl(const Cable& cable) : cable_(cable) {
    model_.gravity = rbd::Math::Vector3d(0, 0, -cable.gravity);
    unsigned parent = 0;
    for (int i = 0; i < cable.links; ++i) {
      const RigidLink link(cable, i);
      const rbd::Body body(link.mass, rbd::Math::Vector3d(0, 0, -link.centre),
                           rbd::Math::Vector3d(link.inertia, link.inertia, link.inertia));
      parent = model_.AddBody(
          parent, rbd::Math::Xtrans(rbd::Math::Vector3d(0, 0, i == 0 ? 0.0 : -cable.length)),
          rbd::Joint(rbd::JointTypeRevoluteY), body);
    }
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

}  // namespace

std::unique_ptr<Peer> make_rbdl(const Cable& cable) { return std::make_unique<Rbdl>(cable); }

}  // namespace catena::benchmark
