// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

namespace catena {

/// Functions of time given by samples. Between the samples they are cubic splines with not-a-knot
/// ends, twice continuously differentiable; a cubic polynomial and its derivatives are reproduced.
///
///     Signals signals;
///     const std::vector<double> time = {0.0, 0.5, 1.0}, side = {0.0, 0.1, 0.0};  // s, m
///     signals.add("support_side", time, side);
///     double u[3];
///     signals.evaluate(0.25, u);  // value, first and second time derivative
class Signals {
 public:
  /// Adds a channel. `time` (s, strictly increasing) and `value` (unit of the channel) have equal
  /// lengths, at least two, and are finite. Throws std::invalid_argument that names the channel,
  /// the sample (counted from 1) and the rule.
  void add(std::string name, std::span<const double> time, std::span<const double> value);

  /// Channels.
  int count() const { return static_cast<int>(channels_.size()); }
  /// Name of a channel, counted from 0.
  const std::string& name(int channel) const;
  /// The times (s) between which every channel has samples; infinite if there is no channel.
  double first_time() const;
  double last_time() const;

  /// Writes value, first and second time derivative of channel k at t (s) into u[3k], u[3k + 1],
  /// u[3k + 2]; u has room for 3 count() numbers. Outside the samples the outermost cubic
  /// continues.
  void evaluate(double t, double* u) const;

 private:
  struct Channel {
    std::string name;
    std::vector<double> time, value, second_derivative;
  };

  std::vector<Channel> channels_;
};

}  // namespace catena
