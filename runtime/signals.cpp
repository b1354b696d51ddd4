// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/signals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/number_text.hpp"

namespace catena {
namespace {

/// Second derivatives at the samples of the cubic spline with not-a-knot ends: with h_i = t_{i+1} -
/// t_i, d_i = (y_{i+1} - y_i) / h_i,
///   h_{i-1} s_{i-1} + 2 (h_{i-1} + h_i) s_i + h_i s_{i+1} = 6 (d_i - d_{i-1}),  0 < i < n - 1,
/// and the third derivative is continuous at the second and at the last but one sample. Two samples
/// give a straight line, three a parabola.
std::vector<double> spline_second_derivatives(const std::vector<double>& t,
                                              const std::vector<double>& y) {
  const std::size_t n = t.size();
  std::vector<double> s(n, 0.0);
  if (n == 2) return s;
  const auto h = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto slope = [&](std::size_t i) { return (y[i + 1] - y[i]) / h(i); };
  if (n == 3) {
    std::fill(s.begin(), s.end(), 2.0 * (slope(1) - slope(0)) / (h(0) + h(1)));
    return s;
  }
  // Unknowns s_1 .. s_{n-2}; the end conditions give s_0 and s_{n-1} from their two neighbours.
  std::vector<double> diagonal(n), upper(n), lower(n), right(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    lower[i] = h(i - 1);
    diagonal[i] = 2.0 * (h(i - 1) + h(i));
    upper[i] = h(i);
    right[i] = 6.0 * (slope(i) - slope(i - 1));
  }
  const double first = h(0) / h(1);  // s_0 = s_1 + first (s_1 - s_2)
  diagonal[1] += lower[1] * (1.0 + first);
  upper[1] -= lower[1] * first;
  const double last = h(n - 2) / h(n - 3);  // s_{n-1} = s_{n-2} + last (s_{n-2} - s_{n-3})
  diagonal[n - 2] += upper[n - 2] * (1.0 + last);
  lower[n - 2] -= upper[n - 2] * last;
  for (std::size_t i = 2; i + 1 < n; ++i) {
    const double ratio = lower[i] / diagonal[i - 1];
    diagonal[i] -= ratio * upper[i - 1];
    right[i] -= ratio * right[i - 1];
  }
  s[n - 2] = right[n - 2] / diagonal[n - 2];
  for (std::size_t i = n - 2; i-- > 1;) s[i] = (right[i] - upper[i] * s[i + 1]) / diagonal[i];
  s[0] = s[1] + first * (s[1] - s[2]);
  s[n - 1] = s[n - 2] + last * (s[n - 2] - s[n - 3]);
  return s;
}

}  // namespace

void Signals::add(std::string name, std::span<const double> time, std::span<const double> value) {
  const std::string where = "signal " + name;
  if (time.size() != value.size())
    throw std::invalid_argument(where + ": " + std::to_string(time.size()) + " times but " +
                                std::to_string(value.size()) + " values");
  if (time.size() < 2)
    throw std::invalid_argument(where + ": " + std::to_string(time.size()) +
                                " samples; at least two are needed");
  for (std::size_t i = 0; i < time.size(); ++i) {
    const std::string sample = where + ", sample " + std::to_string(i + 1);
    if (!std::isfinite(time[i]) || !std::isfinite(value[i]))
      throw std::invalid_argument(sample + ": time and value must be finite");
    if (i > 0 && !(time[i] > time[i - 1]))
      throw std::invalid_argument(sample + ": time " + number_text(time[i]) +
                                  " s does not come after " + number_text(time[i - 1]) + " s");
  }
  Channel channel{std::move(name), {time.begin(), time.end()}, {value.begin(), value.end()}, {}};
  channel.second_derivative = spline_second_derivatives(channel.time, channel.value);
  channels_.push_back(std::move(channel));
}

const std::string& Signals::name(int channel) const {
  return channels_.at(static_cast<std::size_t>(channel)).name;
}

double Signals::first_time() const {
  double first = -std::numeric_limits<double>::infinity();
  for (const Channel& channel : channels_) first = std::max(first, channel.time.front());
  return first;
}

double Signals::last_time() const {
  double last = std::numeric_limits<double>::infinity();
  for (const Channel& channel : channels_) last = std::min(last, channel.time.back());
  return last;
}

void Signals::evaluate(double t, double* u) const {
  for (const Channel& channel : channels_) {
    const auto& time = channel.time;
    const auto after = std::upper_bound(time.begin() + 1, time.end() - 1, t);
    const auto right = static_cast<std::size_t>(after - time.begin()), left = right - 1;
    const double h = time[right] - time[left];
    const double a = (time[right] - t) / h, b = (t - time[left]) / h;
    const double y0 = channel.value[left], y1 = channel.value[right];
    const double s0 = channel.second_derivative[left], s1 = channel.second_derivative[right];
    *u++ = a * y0 + b * y1 + ((a * a * a - a) * s0 + (b * b * b - b) * s1) * h * h / 6.0;
    *u++ = (y1 - y0) / h + ((3.0 * b * b - 1.0) * s1 - (3.0 * a * a - 1.0) * s0) * h / 6.0;
    *u++ = a * s0 + b * s1;
  }
}

}  // namespace catena
