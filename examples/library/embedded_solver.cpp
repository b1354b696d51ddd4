// SPDX-License-Identifier: BSD-3-Clause
//
// catena::generated: the emitted equations of a chain of 12 links in a fixed-step solver, as for a
// controller. It needs the standard library only: instead of installing catena, one may copy
// generated/chain_12.hpp and the headers that it includes.
#include <array>
#include <cstdio>
#include <cstdlib>

#include "generated/chain_12.hpp"

namespace chain = catena::chain_12;

namespace {

using Vector = std::array<double, chain::kLinks>;

/// In the order of the parameter table: lengths, masses, inertias, stiffnesses, dampings and
/// torques of the 12 links, then load mass and gravity.
std::array<double, chain::kParameters> cable() {
  const double length = 3.39 / chain::kLinks;  // m
  const double mass = 0.1424 * length;         // kg
  const double each[] = {length, mass, mass * length * length / 12, 0.5, 1e-3, 0.0};
  std::array<double, chain::kParameters> parameters{};
  for (int family = 0; family < 6; ++family)
    for (int i = 0; i < chain::kLinks; ++i) parameters[family * chain::kLinks + i] = each[family];
  parameters[chain::kParameters - 2] = 1.47;  // kg
  parameters[chain::kParameters - 1] = 9.81;  // m/s^2
  return parameters;
}

struct State {
  Vector angle{}, rate{};
};

const std::array<double, chain::kParameters> kCable = cable();

catena::Point<double> point(const State& state) {
  return {0.0, state.angle.data(), state.rate.data(), nullptr, nullptr, nullptr, kCable.data()};
}

State slope(const State& state) {
  State out;
  out.angle = state.rate;
  if (chain::acceleration(point(state), out.rate.data()) != 0) std::abort();  // M not definite
  return out;
}

State moved(const State& from, double step, const State& along) {
  State out;
  for (int i = 0; i < chain::kLinks; ++i) {
    out.angle[i] = from.angle[i] + step * along.angle[i];
    out.rate[i] = from.rate[i] + step * along.rate[i];
  }
  return out;
}

/// The classical Runge-Kutta method of fourth order.
State advanced(const State& state, double step) {
  const State a = slope(state);
  const State b = slope(moved(state, step / 2, a));
  const State c = slope(moved(state, step / 2, b));
  const State d = slope(moved(state, step, c));
  State out = moved(state, step / 6, a);
  out = moved(out, step / 3, b);
  out = moved(out, step / 3, c);
  return moved(out, step / 6, d);
}

}  // namespace

int main() {
  State state;
  state.angle.fill(0.5);  // rad, at rest
  const double step = 1e-4;
  for (int k = 0; k <= 20000; ++k) {
    if (k % 5000 == 0) {
      double side[chain::kLinks + 2], down[chain::kLinks + 2];
      chain::positions(point(state), side, down);
      std::printf("%.1f s: load at side %7.4f m, down %.4f m\n", k * step, side[chain::kLinks + 1],
                  down[chain::kLinks + 1]);
    }
    state = advanced(state, step);
  }
}
