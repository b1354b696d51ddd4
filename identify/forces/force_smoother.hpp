// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "identify/forces/interval_map.hpp"

namespace catena {

/// The smooth random forces of a prior: each is a Matern process of smoothness 3/2, so that
/// (w, w' / rate) is a Markov chain with equal, independent variances.
struct ForcePrior {
  double time_scale = 0.15;  ///< s

  double rate() const { return std::sqrt(3.0) / time_scale; }  ///< 1/s
  /// From (w, w' / rate) to its expectation after `step` s. What is added has the covariance
  /// variance * (1 - A A').
  Eigen::Matrix2d transition(double step) const;
};

/// The equations of one recording, linearised about a path of nodes, and what was measured at them.
/// y: (q, v, z) minus the path; w: (w, dw/dt) of every pattern; p: the shared parameters, then
/// the recording's own, minus those of the path.
///
///     y(0)   = start_offset + start_by_parameter p
///     y(k+1) = by_state y(k) + by_force w(k) + by_parameter p + offset
///     w(k+1): what a prior makes of w(k)
///     seen   = observed_by_state y + observed_by_parameter p + noise
struct LinearRecording {
  struct Step {
    Eigen::MatrixXd by_state, by_force, by_parameter;
    Eigen::VectorXd offset;
    double duration = 0;  ///< s
  };
  struct Seen {
    Eigen::VectorXd value;  ///< measured minus what the path gives, in standard deviations
    Eigen::MatrixXd by_state, by_parameter;  ///< likewise
  };
  Eigen::VectorXd start_offset;
  Eigen::MatrixXd start_by_parameter;
  Eigen::VectorXd own_mean, own_deviation;  ///< prior of its own parameters
  std::vector<Step> steps;                  ///< one fewer than nodes
  std::vector<Seen> seen;                   ///< one per node, maybe of no values
};

struct LinearProblem {
  Eigen::VectorXd shared_mean, shared_deviation;  ///< prior of the shared parameters
  std::vector<LinearRecording> recordings;
};

/// A force pattern that acts, by its place among those of the problem, and its prior.
struct ActingForce {
  Eigen::Index pattern = 0;
  int group = 0;
};

/// What the data say of a linear problem with these forces.
struct Smoothed {
  double log_evidence = 0;  ///< up to a constant of the data
  struct Recording {
    Eigen::MatrixXd state;  ///< y, one column per node
    Eigen::MatrixXd force;  ///< (w, dw/dt) of each acting pattern, one column per node
    /// Per node, of w there with w there and, as far as asked for, at the nodes after it; acting patterns squared.
    std::vector<std::vector<Eigen::MatrixXd>> covariance;
    Eigen::VectorXd own;
  };
  std::vector<Recording> recordings;
  Eigen::VectorXd shared, shared_variance;
  /// For each group: variance times these is the next estimate of the variance. At the maximum of
  /// the evidence it is 1.
  std::vector<double> growth;
};

/// Kalman's filter forward and the smoother of Bryson and Frazier backward, over all recordings as
/// one chain: what one says of the shared parameters is the prior of the next. `variance`: of each
/// group. Without `smooth` the evidence alone. `later`: covariances with so many nodes after each. References: Bierman,
/// Automatica 9 (1973) 503; MacKay, Neural Computation 4 (1992) 415, for the growth; de Jong and MacKinnon, Biometrika
/// 75 (1988) 601, for the covariances.
Smoothed smooth_forces(const LinearProblem& problem, const std::vector<ActingForce>& forces,
                       const std::vector<double>& variance, const ForcePrior& prior, bool smooth,
                       Eigen::Index later = 0);

}  // namespace catena
