// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/trajectory.hpp"

namespace catena {

void normalise_directions(Trajectory& trajectory, int links) {
  for (Eigen::Index k = 0; k < trajectory.q.cols(); ++k) {
    for (Eigen::Index i = 0; i < links; ++i) {
      auto q = trajectory.q.col(k)(Eigen::seqN(i, 3, links));
      auto v = trajectory.v.col(k)(Eigen::seqN(i, 3, links));
      const double length = q.norm();
      q /= length;
      v = (v - q.dot(v) * q).eval() / length;
    }
  }
}

}  // namespace catena
