// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/spatial_peer.hpp"

#include <cmath>

namespace catena::benchmark {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;

const Vector3d kHanging(0, 0, -1);

Vector3d direction(const SpatialState& state, std::size_t i) {
  return state.rotation[i] * kHanging;
}

SpatialState state_of(const Vectors& directions, const Vectors& rates) {
  SpatialState state;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    state.rotation.push_back(
        Quaterniond::FromTwoVectors(kHanging, directions[i]).toRotationMatrix());
    state.angular_velocity.push_back(directions[i].cross(rates[i]));
  }
  return state;
}

// The coordinates of a model are all sides, then all downs, then all acrosses.
Vectors vectors_of(const VectorXd& list) {
  const Index n = list.size() / 3;
  Vectors vectors;
  for (Index i = 0; i < n; ++i) vectors.emplace_back(list[i], list[2 * n + i], -list[n + i]);
  return vectors;
}

}  // namespace

SpatialState askew_start(const Cable& cable) {
  const VectorXd angles = cable.start(), azimuths = VectorXd::LinSpaced(cable.links, 0, 0.5);
  Vectors directions, rates;
  for (Index i = 0; i < cable.links; ++i) {
    const double sine = std::sin(angles[i]);
    directions.emplace_back(sine * std::cos(azimuths[i]), sine * std::sin(azimuths[i]),
                            -std::cos(angles[i]));
    rates.push_back(0.8 * Vector3d(-sine * std::sin(azimuths[i]), sine * std::cos(azimuths[i]), 0));
  }
  return state_of(directions, rates);
}

SpatialState spatial_state(const VectorXd& q, const VectorXd& v) {
  return state_of(vectors_of(q), vectors_of(v));
}

VectorXd second_derivatives(const SpatialState& state, const Vectors& angular_acceleration) {
  const auto n = static_cast<Index>(angular_acceleration.size());
  VectorXd list(3 * n);
  for (Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Vector3d q = direction(state, k), w = state.angular_velocity[k];
    const Vector3d a = angular_acceleration[k].cross(q) + w.cross(w.cross(q));
    list[i] = a.x(), list[n + i] = -a.z(), list[2 * n + i] = a.y();
  }
  return list;
}

Vectors moments(const Cable& cable, const SpatialState& state) {
  const std::size_t n = state.rotation.size();
  Vectors result(n, Vector3d::Zero());
  Vector3d above = kHanging, above_rate = Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector3d own = direction(state, i), rate = state.angular_velocity[i];
    Vector3d moment = -cable.damping * (rate - above_rate);
    if (i > 0) {  // hinged at the support
      const Vector3d axis = own.cross(above);
      const double sine = axis.norm(), angle = std::atan2(sine, own.dot(above));
      moment += cable.stiffness * (sine > 0 ? angle / sine : 1) * axis;
      result[i - 1] -= moment - moment.dot(above) * above;
    }
    result[i] += moment - moment.dot(own) * own;
    above = own;
    above_rate = rate;
  }
  return result;
}

VectorXd joints(const Cable& cable, const SpatialState& state) {
  VectorXd list(3 * cable.links);
  Vector3d place = Vector3d::Zero();
  for (Index i = 0; i < cable.links; ++i) {
    place += cable.length * direction(state, static_cast<std::size_t>(i));
    list.segment<3>(3 * i) = place;
  }
  return list;
}

std::vector<BallJoint> ball_joints(const SpatialState& state, SpatialPeer::Frame frame) {
  std::vector<BallJoint> result;
  Matrix3d above = Matrix3d::Identity();
  Vector3d above_rate = Vector3d::Zero();
  for (std::size_t i = 0; i < state.rotation.size(); ++i) {
    const Matrix3d& own = state.rotation[i];
    const Vector3d& rate = state.angular_velocity[i];
    const Matrix3d& axes = frame == SpatialPeer::Frame::kOfLink ? own : above;
    result.push_back(
        {Quaterniond(Matrix3d(above.transpose() * own)), axes.transpose() * (rate - above_rate)});
    above = own;
    above_rate = rate;
  }
  return result;
}

Vectors angular_accelerations(const SpatialState& state, const SpatialPeer& peer) {
  Vectors result;
  Matrix3d above = Matrix3d::Identity();
  Vector3d above_rate = Vector3d::Zero(), sum = Vector3d::Zero();
  const Vectors found = peer.relative_accelerations();
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Vector3d rate = state.angular_velocity[i], relative = rate - above_rate;
    sum += peer.frame() == SpatialPeer::Frame::kOfLink
               ? Vector3d(state.rotation[i] * found[i] + rate.cross(relative))
               : Vector3d(above * found[i] + above_rate.cross(relative));
    result.push_back(sum);
    above = state.rotation[i];
    above_rate = rate;
  }
  return result;
}

}  // namespace catena::benchmark
