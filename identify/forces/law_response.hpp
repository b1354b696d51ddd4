// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/forces/force_smoother.hpp"

namespace catena {

/// Forces at the nodes of one recording, patterns x columns each, and how they depend on the state
/// there: nothing, or patterns x states.
struct NodeForces {
  std::vector<Eigen::MatrixXd> columns;
  std::vector<Eigen::MatrixXd> by_state;
};

/// Some nodes of every recording as one least-squares problem, in standard deviations: parameters
/// and states with their priors, and forces.
struct LawPart {
  Eigen::MatrixXd nuisance;  ///< rows x (parameters, states)
  Eigen::MatrixXd forces;    ///< rows x columns
  Eigen::VectorXd value;
  Eigen::Index seen = 0;  ///< rows that are measured; those of the priors follow
};

enum class FrameHalf { kFirst, kSecond, kBoth };

/// The response of the linearised recordings to these forces, which go straight from node to node.
/// At the middle node the second half has a state of its own.
LawPart law_part(const LinearProblem& linear, const std::vector<NodeForces>& forces,
                 FrameHalf half);

/// The problem with a law whose force follows the state. Its coefficients are further shared
/// parameters behind those of the problem, with a prior about 0 of these deviations.
LinearProblem with_law(const LinearProblem& linear, const std::vector<NodeForces>& forces,
                       const Eigen::VectorXd& deviation);

/// Columns less what the unknowns imitate.
Eigen::MatrixXd without_nuisance(const LawPart& part, Eigen::MatrixXd columns);

}  // namespace catena
