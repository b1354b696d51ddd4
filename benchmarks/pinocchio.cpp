// SPDX-License-Identifier: BSD-3-Clause
//
// Pinocchio's articulated-body algorithm, where Pinocchio is installed.
#include <unistd.h>

#include <cmath>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/multibody/data.hpp>
#include <pinocchio/multibody/model.hpp>
#include <stdexcept>

#include "benchmarks/spatial_peer.hpp"

namespace catena::benchmark {
namespace {

namespace pin = pinocchio;

/// Links hang along -z.
pin::Model chain(const Cable& cable, const pin::JointModel& joint) {
  pin::Model model;
  model.gravity.linear(Eigen::Vector3d(0, 0, -cable.gravity));
  pin::JointIndex parent = 0;
  for (int i = 0; i < cable.links; ++i) {
    const pin::SE3 place(Eigen::Matrix3d::Identity(),
                         Eigen::Vector3d(0, 0, i == 0 ? 0.0 : -cable.length));
    parent = model.addJoint(parent, joint, place, "joint_" + std::to_string(i));
    const RigidLink link(cable, i);
    model.appendBodyToJoint(parent, pin::Inertia(link.mass, Eigen::Vector3d(0, 0, -link.centre),
                                                 link.inertia * Eigen::Matrix3d::Identity()));
  }
  return model;
}

/// Data always allocates the second derivatives of the torques. If they do not fit into memory, the
/// system would end the program.
std::unique_ptr<pin::Data> data(const pin::Model& model) {
  const double room = 0.5 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
                      static_cast<double>(sysconf(_SC_PAGESIZE));
  const double tensors = 4 * std::pow(model.nv, 3) * sizeof(double);
  if (tensors > room) {
    throw std::runtime_error("Pinocchio's Data takes " +
                             std::to_string(std::lround(tensors / 1e9)) +
                             " GB, more than half of this machine's memory");
  }
  return std::make_unique<pin::Data>(model);
}

/// A positive turn about y moves links towards -x, which is this engine's +side.
class Pinocchio : public Peer {
 public:
  explicit Pinocchio(const Cable& cable)
      : cable_(cable), model_(chain(cable, pin::JointModelRY())), data_(data(model_)) {}

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

class SpatialPinocchio : public SpatialPeer {
 public:
  explicit SpatialPinocchio(const Cable& cable)
      : model_(chain(cable, pin::JointModelSpherical())),
        data_(data(model_)),
        q_(Eigen::VectorXd::Zero(model_.nq)),
        v_(Eigen::VectorXd::Zero(model_.nv)),
        none_(v_),
        forces_(model_.joints.size(), pin::Force::Zero()) {}

  const char* name() const override { return "Pinocchio"; }

  void set(const SpatialState& state) override {
    rotation_ = state.rotation;
    Eigen::Index i = 0;
    for (const auto& [turn, rate] : ball_joints(state, frame())) {
      q_.segment<4>(4 * i) = turn.coeffs();
      v_.segment<3>(3 * i) = rate;
      ++i;
    }
  }

  void accelerate(const Vectors& moments) override {
    for (std::size_t i = 0; i < moments.size(); ++i)
      forces_[i + 1].angular() = rotation_[i].transpose() * moments[i];
    pin::aba(model_, *data_, q_, v_, none_, forces_);
  }

  Vectors relative_accelerations() const override {
    Vectors result;
    for (Eigen::Index i = 0; i < model_.nv; i += 3) result.push_back(data_->ddq.segment<3>(i));
    return result;
  }
  Frame frame() const override { return Frame::kOfLink; }

 private:
  pin::Model model_;
  std::unique_ptr<pin::Data> data_;
  Eigen::VectorXd q_, v_, none_;
  std::vector<Eigen::Matrix3d> rotation_;
  pin::container::aligned_vector<pin::Force> forces_;  ///< in the frames of the links
};

}  // namespace

std::unique_ptr<Peer> make_pinocchio(const Cable& cable) {
  return std::make_unique<Pinocchio>(cable);
}

std::unique_ptr<SpatialPeer> make_pinocchio_in_space(const Cable& cable) {
  return std::make_unique<SpatialPinocchio>(cable);
}

}  // namespace catena::benchmark
