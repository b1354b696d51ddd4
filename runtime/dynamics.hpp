// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "runtime/model.hpp"
#include "runtime/signals.hpp"

namespace catena {

/// A model with the parameters and signals of one simulation, which are needed to evaluate its
/// equations at a time and state. Only the constructor allocates.
class Dynamics {
 public:
  /// `parameters` as Model::check_parameters admits them; `signals` must outlive it.
  Dynamics(const Model& model, const Eigen::VectorXd& parameters, const Signals& signals)
      : model_(model),
        parameters_(parameters),
        signals_(signals),
        signal_values_(static_cast<std::size_t>(3 * model.signals())),
        zero_(static_cast<std::size_t>(std::max(
            {1, model.coordinates(), model.states(), model.parameters(), 3 * model.signals()}))) {}

  /// The model, its table, and the lengths of q and of z.
  const catena_model& table() const { return model_.table(); }
  const Model& model() const { return model_; }
  int coordinates() const { return model_.coordinates(); }
  int states() const { return model_.states(); }
  /// Length of y = (q, v, z).
  int size() const { return 2 * coordinates() + states(); }
  /// p of a point.
  const double* parameters() const { return parameters_.data(); }
  /// Zeros, as many as the longest array of a point has entries.
  const double* zero() const { return zero_.data(); }

  /// The point (t, q, v, a, z) with the parameters and with the signals at t. It refers to the
  /// given arrays and is valid until the next call.
  catena_point at(double t, const double* q, const double* v, const double* a, const double* z) {
    if (!signal_values_.empty() && t != signal_time_) {
      signals_.evaluate(t, signal_values_.data());
      signal_time_ = t;
    }
    return {t, q, v, a, z, signal_values_.data(), parameters_.data()};
  }

 private:
  Model model_;
  Eigen::VectorXd parameters_;
  const Signals& signals_;
  std::vector<double> signal_values_;
  double signal_time_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> zero_;
};

}  // namespace catena
