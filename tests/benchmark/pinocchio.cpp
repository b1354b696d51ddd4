// SPDX-License-Identifier: BSD-3-Clause
//
// Pinocchio's articulated-body algorithm, where Pinocchio is installed.
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/multibody/data.hpp>
#include <pinocchio/multibody/model.hpp>

#include "tests/benchmark/peer.hpp"

namespace catena::benchmark {
namespace {

namespace pin = pinocchio;

/// Links hang along -z; a positive turn about y moves them towards -x, which is this engine's
/// +side.
class Pinocchio : public Peer {
 public:
  explicit Pinocchio(const Cable& cable) : cable_(cable) {
    model_.gravity.linear(Eigen::Vector3d(0, 0, -cable.gravity));
    pin::JointIndex parent = 0;
    for (int i = 0; i < cable.links; ++i) {
      const pin::SE3 place(Eigen::Matrix3d::Identity(),
                           Eigen::Vector3d(0, 0, i == 0 ? 0.0 : -cable.length));
      parent = model_.addJoint(parent, pin::JointModelRY(), place, "joint_" + std::to_string(i));
      // the load is part of the last link
      const RigidLink link(cable, i);
      model_.appendBodyToJoint(parent, pin::Inertia(link.mass, Eigen::Vector3d(0, 0, -link.centre),
                                                    link.inertia * Eigen::Matrix3d::Identity()));
    }
    data_ = std::make_unique<pin::Data>(model_);
  }

  const char* name() const override { return "Pinocchio"; }

  void accelerations(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                     Eigen::VectorXd& a) override {
    torque_ = -cable_.stiffness * q - cable_.damping * v;
    a = pin::aba(model_, *data_, q, v, torque_);
  }

 private:
  Cable cable_;
  pin::Model model_;
  std::unique_ptr<pin::Data> data_;
  Eigen::VectorXd torque_;
};

}  // namespace

std::unique_ptr<Peer> make_pinocchio(const Cable& cable) {
  return std::make_unique<Pinocchio>(cable);
}

}  // namespace catena::benchmark
