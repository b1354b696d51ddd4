// SPDX-License-Identifier: BSD-3-Clause
//
// Pinocchio's articulated-body algorithm, where Pinocchio is installed.
#include <unistd.h>

#include <cmath>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/multibody/data.hpp>
#include <pinocchio/multibody/model.hpp>
#include <stdexcept>

#include "benchmarks/peer.hpp"

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
      const RigidLink link(cable, i);
      model_.appendBodyToJoint(parent, pin::Inertia(link.mass, Eigen::Vector3d(0, 0, -link.centre),
                                                    link.inertia * Eigen::Matrix3d::Identity()));
    }
    // Data always allocates the second derivatives of the torques. If they do not fit into memory,
    // the system would end the program.
    const double room = 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                        static_cast<double>(sysconf(_SC_PAGESIZE));
    const double tensors = 4 * std::pow(cable.links, 3) * sizeof(double);
    if (tensors > room) {
      throw std::runtime_error("Pinocchio's Data takes " +
                               std::to_string(std::lround(tensors / 1e9)) +
                               " GB, more than half of this machine's memory");
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
