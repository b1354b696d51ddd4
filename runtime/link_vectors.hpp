// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace catena {

/// The vector of link i (from 0) in q or v of a model in space, whose components stand side of all
/// links first, then down, then across.
inline Eigen::Vector3d vector_of(const Eigen::VectorXd& all, Eigen::Index links, Eigen::Index i) {
  return {all[i], all[links + i], all[2 * links + i]};
}

/// Puts it there.
inline void put(Eigen::VectorXd& all, Eigen::Index links, Eigen::Index i,
                const Eigen::Vector3d& vector) {
  for (Eigen::Index axis = 0; axis < 3; ++axis) all[axis * links + i] = vector[axis];
}

}  // namespace catena
