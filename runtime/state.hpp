// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "runtime/model.hpp"

namespace catena {

/// The state of a model at one time.
struct State {
  /// Model::coordinates() entries: the angles of the links from the downward vertical (rad), then
  /// the coordinates that effects add. In space: the components side of all links, then down, then
  /// across, of a vector along each link, of any length but zero. Each held place adds three, last: minus
  /// its force (N), integrated twice over time; they enter no equation.
  Eigen::VectorXd q;
  Eigen::VectorXd v;  ///< dq/dt, as many
  Eigen::VectorXd z;  ///< Model::states() extra states of effects

  /// The chain hangs straight down, at rest: all zero, but in space the components down are one.
  static State zero(const Model& model) {
    State state{Eigen::VectorXd::Zero(model.coordinates()),
                Eigen::VectorXd::Zero(model.coordinates()), Eigen::VectorXd::Zero(model.states())};
    if (model.in_space()) state.q.segment(model.links(), model.links()).setOnes();
    return state;
  }
};

}  // namespace catena
