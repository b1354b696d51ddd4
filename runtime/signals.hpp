// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <vector>

namespace catena {

/// Functions of time given by samples, interpolated twice continuously differentiable: cubic
/// splines with not-a-knot ends (so that samples of a cubic are met exactly, derivatives included).
class Signals {
 public:
  /// Adds a channel: at least two samples, finite, times strictly increasing (s). Throws
  /// std::invalid_argument naming the channel, the sample (counted from 1) and the rule.
  void add(std::string name, std::span<const double> time, std::span<const double> value);

  int count() const { return static_cast<int>(channels_.size()); }
  const std::string& name(int channel) const;
  /// The times between which every channel is given; infinite if there is none.
  double first_time() const;
  double last_time() const;

  /// u[3k], u[3k + 1], u[3k + 2]: value, first and second time derivative of channel k. Outside the
  /// samples the outermost cubic goes on.
  void evaluate(double t, double* u) const;

 private:
  struct Channel {
    std::string name;
    std::vector<double> time, value, second_derivative;
  };

  std::vector<Channel> channels_;
};

}  // namespace catena
