// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "runtime/model.hpp"

namespace catena {

/// A state of a model at one time.
struct State {
  Eigen::VectorXd q;  ///< coordinates: link angles from the downward vertical (rad), then effects'
  Eigen::VectorXd v;  ///< dq/dt
  Eigen::VectorXd z;  ///< extra states of effects

  /// All zero, with the sizes of the model: the chain hangs straight down at rest.
  static State zero(const Model& model) {
    return {Eigen::VectorXd::Zero(model.coordinates()), Eigen::VectorXd::Zero(model.coordinates()),
            Eigen::VectorXd::Zero(model.states())};
  }
};

}  // namespace catena
