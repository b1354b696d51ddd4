// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "benchmarks/table_6_1_cable.hpp"

namespace catena::benchmark {

/// A general engine with the same chain. Its coordinates are relative angles.
class Peer {
 public:
  virtual ~Peer() = default;
  virtual const char* name() const = 0;
  /// Forward dynamics, from relative angles and rates to their accelerations. This is what is
  /// timed.
  virtual void accelerations(const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                             Eigen::VectorXd& a) = 0;
};

/// A method of integrating the 60-link cable; larger `effort` is more accurate.
struct Solution {
  double cpu_seconds;
  Eigen::MatrixXd q;  ///< absolute angles, one column per time
};

std::unique_ptr<Peer> make_mujoco(const Cable& cable);
std::unique_ptr<Peer> make_simbody(const Cable& cable);
std::unique_ptr<Peer> make_dart(const Cable& cable);
// If compiled with CATENA_BENCHMARK_RBDL and CATENA_BENCHMARK_PINOCCHIO:
std::unique_ptr<Peer> make_rbdl(const Cable& cable);
std::unique_ptr<Peer> make_pinocchio(const Cable& cable);

/// Simbody's CPodes (BDF) at the given accuracy.
Solution simulate_simbody(const Cable& cable, double rest_angle, const std::vector<double>& times,
                          double accuracy);
/// MuJoCo at a fixed time step, by its implicit integrator or by Runge-Kutta.
Solution simulate_mujoco(const Cable& cable, double rest_angle, const std::vector<double>& times,
                         double time_step, bool runge_kutta);

}  // namespace catena::benchmark
