// SPDX-License-Identifier: BSD-3-Clause
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>

#include "benchmarks/peer.hpp"

namespace catena::benchmark {
namespace {

/// x to the side, y up; joints turn about z, a positive turn moves a hanging link towards +x.
class DartPeer : public Peer {
 public:
  explicit DartPeer(const Cable& cable) : skeleton_(dart::dynamics::Skeleton::create("chain")) {
    using dart::dynamics::RevoluteJoint;
    dart::dynamics::BodyNode* parent = nullptr;
    for (int i = 0; i < cable.links; ++i) {
      RevoluteJoint::Properties joint;
      joint.mName = "joint_" + std::to_string(i);
      joint.mAxis = Eigen::Vector3d::UnitZ();
      if (i > 0) joint.mT_ParentBodyToJoint.translation() << 0, -cable.length, 0;
      joint.mSpringStiffnesses[0] = cable.stiffness;
      joint.mDampingCoefficients[0] = cable.damping;
      const RigidLink link(cable, i);
      dart::dynamics::BodyNode::Properties body;
      body.mName = "link_" + std::to_string(i);
      body.mInertia = dart::dynamics::Inertia(link.mass, Eigen::Vector3d(0, -link.centre, 0),
                                              link.inertia * Eigen::Matrix3d::Identity());
      parent = skeleton_->createJointAndBodyNodePair<RevoluteJoint>(parent, joint, body).second;
    }
    skeleton_->setGravity(Eigen::Vector3d(0, -cable.gravity, 0));
    // Its joint springs are implicit over one time step. With a time step of zero the dynamics are
    // the plain ones.
    skeleton_->setTimeStep(1e-14);
  }
  const char* name() const override { return "DART"; }
  void accelerations(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                     Eigen::VectorXd& a) override {
    skeleton_->setPositions(q);
    skeleton_->setVelocities(v);
    skeleton_->computeForwardDynamics();
    a = skeleton_->getAccelerations();
  }

 private:
  dart::dynamics::SkeletonPtr skeleton_;
};

}  // namespace

std::unique_ptr<Peer> make_dart(const Cable& cable) { return std::make_unique<DartPeer>(cable); }

}  // namespace catena::benchmark
