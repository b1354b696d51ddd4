// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/force_pattern.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace catena {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

/// What the links' ends carry of forces at the middles of the links.
VectorXd carried_of_middles(const VectorXd& force) {
  VectorXd carried(force.size());
  double below = 0;
  for (Index k = force.size() - 1; k >= 0; --k) {
    carried[k] = below + 0.5 * force[k];
    below += force[k];
  }
  return carried;
}

ForcePattern empty(const LinkChain& chain, std::string name, std::string unit) {
  ForcePattern pattern;
  pattern.name = std::move(name);
  pattern.unit = std::move(unit);
  pattern.carried.setZero(chain.lengths.size(), chain.in_space ? 3 : 2);
  pattern.torque.setZero(chain.lengths.size(), chain.in_space ? 3 : 1);
  return pattern;
}

/// One pattern, or in space one for each axis, of torques about it.
std::vector<ForcePattern> about_axes(const LinkChain& chain, const std::string& name,
                                     const VectorXd& torque) {
  std::vector<ForcePattern> patterns;
  if (!chain.in_space) {
    patterns.push_back(empty(chain, name, "N m"));
    patterns.back().torque.col(0) = torque;
    return patterns;
  }
  for (const ForceDirection axis : force_directions(true)) {
    patterns.push_back(empty(chain, fmt::format("{} about {}", name, word_of(axis)), "N m"));
    patterns.back().direction = axis;
    patterns.back().torque.col(static_cast<Index>(axis)) = torque;
  }
  return patterns;
}

/// Link k of a chain in space: its vector's length and direction, and what acts on it.
struct LinkInSpace {
  double size;
  Vector3d along, force, torque;  // force: times the length of the link, N m
  LinkInSpace(const ForcePattern& pattern, const VectorXd& lengths, const double* q, Index k) {
    const Index n = lengths.size();
    const Vector3d vector(q[k], q[n + k], q[2 * n + k]);
    size = vector.norm();
    along = vector / size;
    force = lengths[k] * pattern.carried.row(k).transpose();
    torque = pattern.torque.row(k).transpose();
  }
  Vector3d generalised() const {
    return (force - along.dot(force) * along + torque.cross(along)) / size;
  }
};

}  // namespace

const char* word_of(ForceDirection direction) {
  constexpr const char* kWords[] = {"side", "down", "across"};
  return kWords[static_cast<std::size_t>(direction)];
}

std::vector<ForceDirection> force_directions(bool in_space) {
  std::vector<ForceDirection> directions = {ForceDirection::kSide, ForceDirection::kDown};
  if (in_space) directions.push_back(ForceDirection::kAcross);
  return directions;
}

VectorXd link_middles(const VectorXd& lengths) {
  VectorXd middles(lengths.size());
  double begin = 0;
  for (Index k = 0; k < lengths.size(); ++k) {
    middles[k] = begin + 0.5 * lengths[k];
    begin += lengths[k];
  }
  return middles;
}

ForcePattern density_pattern(ForceDirection direction, const std::string& shape,
                             const VectorXd& density, const LinkChain& chain) {
  ForcePattern pattern =
      empty(chain, fmt::format("{} density {}", word_of(direction), shape), "N/m");
  pattern.direction = direction;
  pattern.density = density;
  pattern.carried.col(static_cast<Index>(direction)) =
      carried_of_middles(density.cwiseProduct(chain.lengths));
  return pattern;
}

ForcePattern point_pattern(ForceDirection direction, double s, const LinkChain& chain) {
  ForcePattern pattern =
      empty(chain, fmt::format("{} force at arc length {:.3g} m", word_of(direction), s), "N");
  pattern.direction = direction;
  double begin = 0;
  for (Index k = 0; k < chain.lengths.size(); ++k) {
    pattern.carried(k, static_cast<Index>(direction)) =
        std::clamp((s - begin) / chain.lengths[k], 0.0, 1.0);
    begin += chain.lengths[k];
  }
  return pattern;
}

std::vector<ForcePattern> torque_patterns(Index link, const LinkChain& chain) {
  return about_axes(chain, fmt::format("torque on link {}", link + 1),
                    VectorXd::Unit(chain.lengths.size(), link));
}

std::string moment_name(Index joint, const VectorXd& lengths) {
  return joint == 0
             ? std::string("torque at the support")
             : fmt::format("moment in the joint at arc length {:.3g} m", lengths.head(joint).sum());
}

std::vector<ForcePattern> moment_patterns(Index joint, const LinkChain& chain) {
  VectorXd torque = VectorXd::Unit(chain.lengths.size(), joint);
  if (joint > 0) torque[joint - 1] = -1;
  return about_axes(chain, moment_name(joint, chain.lengths), torque);
}

void add_generalised_force(const ForcePattern& pattern, const VectorXd& lengths, const double* q,
                           double size, double* force) {
  const Index n = lengths.size();
  for (Index k = 0; k < n; ++k) {
    if (!pattern.in_space()) {
      force[k] += size * (lengths[k] * (std::cos(q[k]) * pattern.carried(k, 0) -
                                        std::sin(q[k]) * pattern.carried(k, 1)) +
                          pattern.torque(k, 0));
      continue;
    }
    const Vector3d on_link = size * LinkInSpace(pattern, lengths, q, k).generalised();
    for (Index i = 0; i < 3; ++i) force[i * n + k] += on_link[i];
  }
}

VectorXd link_torques(const ForcePattern& pattern, const VectorXd& lengths, const double* q) {
  VectorXd torques = VectorXd::Zero(pattern.torque.size());
  if (!pattern.in_space()) {
    add_generalised_force(pattern, lengths, q, 1, torques.data());
    return torques;
  }
  for (Index k = 0; k < lengths.size(); ++k) {
    const LinkInSpace link(pattern, lengths, q, k);
    torques.segment<3>(3 * k) = link.along.cross(link.force) + link.torque;
  }
  return torques;
}

void add_turning(const ForcePattern& pattern, const VectorXd& lengths, const double* q, double size,
                 double* turning) {
  for (Index k = 0; k < lengths.size(); ++k) {
    if (!pattern.in_space()) {
      turning[k] -=
          size * lengths[k] *
          (std::sin(q[k]) * pattern.carried(k, 0) + std::cos(q[k]) * pattern.carried(k, 1));
      continue;
    }
    const LinkInSpace link(pattern, lengths, q, k);
    const Vector3d by_force = (link.force - link.along.dot(link.force) * link.along) / link.size;
    const Matrix3d across = Matrix3d::Identity() - link.along * link.along.transpose();
    Matrix3d by_q =
        -(link.along.dot(link.force) / link.size * across + link.along * by_force.transpose() +
          link.generalised() * link.along.transpose());
    for (Index i = 0; i < 3; ++i) by_q.col(i) += link.torque.cross(across.col(i)) / link.size;
    Eigen::Map<Matrix3d, 0>(turning + 9 * k) += size / link.size * by_q.transpose();
  }
}

}  // namespace catena
