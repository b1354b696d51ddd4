// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "runtime/model.hpp"

namespace catena {

/// The state of a model at one time.
struct State {
  /// Model::coordinates() entries: the angles of the links from the downward vertical (rad), then
  /// the coordinates that effects add.
  Eigen::VectorXd q;
  Eigen::VectorXd v;  ///< dq/dt, as many
  Eigen::VectorXd z;  ///< Model::states() extra states of effects

  /// All zero: the chain hangs straight down, at rest.
  static State zero(const Model& model) {
    return {Eigen::VectorXd::Zero(model.coordinates()), Eigen::VectorXd::Zero(model.coordinates()),
            Eigen::VectorXd::Zero(model.states())};
  }
};

}  // namespace catena
