// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "identify/forces/force_pattern.hpp"
#include "runtime/direction_batch.hpp"
#include "runtime/newton_matrix.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/signals.hpp"

namespace catena {

/// The state (q, v, z) at the end of an interval, and its exact derivatives by the state and the
/// forces at its beginning and by the parameters.
struct IntervalMap {
  Eigen::VectorXd end;
  Eigen::MatrixXd by_state, by_force, by_parameter;
};

/// Integrates the equations of a model with forces over an interval by the implicit midpoint rule,
/// with steps of at most `step` s, and shorter ones where these fail, and differentiates what it does.
/// Within the interval the forces go on straight, as they begin. They turn with the links as the
/// rates at the beginning of a step predict them at its middle: a difference of second order in the
/// step, as the rule itself has.
class IntervalIntegrator {
 public:
  /// `parameters`: the model's array. `directions`: by which derivatives are wanted; only their
  /// parameters are read. References must outlive this object.
  IntervalIntegrator(const Model& model, const Eigen::VectorXd& parameters, const Signals& signals,
                     const std::vector<ForcePattern>& patterns,
                     const std::vector<SensitivityDirection>& directions, double step);

  /// From `begin` to `end` (s). `state`: (q, v, z). `force`: (w, dw/dt) of each pattern. Nothing
  /// where Newton's iteration fails with an eighth of the step, too.
  std::optional<IntervalMap> operator()(double begin, double end, const Eigen::VectorXd& state,
                                        const Eigen::VectorXd& force);

 private:
  void begin_at(const Eigen::VectorXd& state);
  /// False where a step fails.
  bool step_through(double begin, double end, const Eigen::VectorXd& force, int steps);
  IntervalMap map_of_steps() const;
  bool step_on(double t, double step, const Eigen::VectorXd& force, double since);
  void differentiate(double t, double gamma, double since);
  void turn_force();

  const Model model_;
  Dynamics dynamics_;
  const std::vector<ForcePattern>& patterns_;
  double step_;
  Eigen::Index n_, states_, forces_, parameters_;
  Eigen::VectorXd lengths_;
  std::size_t per_link_;  // coordinates of a link
  std::unique_ptr<NewtonMatrix> matrix_;
  BatchTangents tangents_;
  std::size_t batches_;
  std::vector<std::vector<DirectionBatch>> dp_;                  // of each batch
  std::vector<std::vector<DirectionBatch>> q_of_, v_of_, z_of_;  // columns, of each batch
  std::vector<DirectionBatch> predicted_, zero_, change_, rate_;
  std::vector<double> q_, v_, z_, a_, middle_q_, middle_v_, middle_z_, residual_, zdot_, force_,
      turning_, predicted_q_;
  std::vector<std::vector<double>> unit_force_;  // generalised force of each pattern
};

}  // namespace catena
