// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/signals.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/support/near.hpp"

namespace {

using catena::Signals;

double cubic(double t) { return 2.0 - 3.0 * t + 0.5 * t * t + 0.25 * t * t * t; }

TEST_CASE("samples of a cubic are met exactly, with their derivatives, on uneven times") {
  const std::vector<double> t{-1.0, -0.4, 0.0, 0.9, 1.1, 2.0};
  std::vector<double> y;
  for (const double time : t) y.push_back(cubic(time));
  Signals signals;
  signals.add("s", t, y);
  CHECK(signals.count() == 1);
  CHECK(signals.name(0) == "s");
  CHECK(signals.first_time() == -1.0);
  CHECK(signals.last_time() == 2.0);
  for (const double time : {-1.0, -0.7, -0.1, 0.5, 1.0, 1.99, 2.0, 2.2}) {
    CAPTURE(time);
    double u[3];
    signals.evaluate(time, u);
    // The spline is the cubic but for rounding.
    CHECK(u[0] == catena::near(cubic(time), 1e-13));
    CHECK(u[1] == catena::near(-3.0 + time + 0.75 * time * time, 1e-12));
    CHECK(u[2] == catena::near(1.0 + 1.5 * time, 1e-12));
  }
}

TEST_CASE("two samples give a line, three a parabola") {
  Signals signals;
  const std::vector<double> two{0.0, 2.0}, line{1.0, 5.0}, three{0.0, 1.0, 3.0}, squares{0, 1, 9};
  signals.add("line", two, line);
  signals.add("parabola", three, squares);
  double u[6];
  signals.evaluate(1.5, u);
  const double expected[] = {4.0, 2.0, 0.0, 2.25, 3.0, 2.0};
  for (int i = 0; i < 6; ++i) CHECK(u[i] == catena::near(expected[i], 1e-14));
  CHECK(signals.last_time() == 2.0);  // where both are given
}

TEST_CASE("value, rate and acceleration of a sine converge with the fourth to second power") {
  double before[3] = {};
  for (const int intervals : {20, 40}) {
    std::vector<double> t, y;
    for (int i = 0; i <= intervals; ++i) {
      t.push_back(3.0 * i / intervals);
      y.push_back(std::sin(2.0 * t.back()));
    }
    Signals signals;
    signals.add("sine", t, y);
    double worst[3] = {};
    for (double time = 0.0; time <= 3.0; time += 0.01) {
      double u[3];
      signals.evaluate(time, u);
      const double exact[] = {std::sin(2 * time), 2 * std::cos(2 * time), -4 * std::sin(2 * time)};
      for (int i = 0; i < 3; ++i) worst[i] = std::max(worst[i], std::abs(u[i] - exact[i]));
    }
    if (before[0] > 0.0) {
      CHECK(before[0] / worst[0] > 12.0);  // 16
      CHECK(before[1] / worst[1] > 6.0);   // 8
      CHECK(before[2] / worst[2] > 3.0);   // 4
    }
    std::copy_n(worst, 3, before);
  }
}

TEST_CASE("bad samples name the channel, the sample and the rule") {
  struct Row {
    std::vector<double> time, value;
    const char* message;
  };
  const Row rows[] = {
      {{0, 1}, {0}, "signal wind: 2 times but 1 values"},
      {{0}, {0}, "signal wind: 1 samples; at least two"},
      {{0, 1, 1}, {0, 0, 0}, "signal wind, sample 3: time 1 s does not come after 1 s"},
      {{0, std::nan(""), 2}, {0, 0, 0}, "signal wind, sample 2: time and value must be finite"},
      {{0, 1, 2}, {0, 0, std::nan("")}, "signal wind, sample 3: time and value must be finite"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.message);
    Signals signals;
    std::string message = "nothing was thrown";
    try {
      signals.add("wind", row.time, row.value);
    } catch (const std::invalid_argument& error) {
      message = error.what();
    }
    CHECK(message.find(row.message) != std::string::npos);
    CHECK(signals.count() == 0);
  }
}

}  // namespace
