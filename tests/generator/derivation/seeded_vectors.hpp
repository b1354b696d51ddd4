// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact numbers and vectors by names, for tests in 50-digit arithmetic.
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <cstddef>
#include <random>
#include <string>

namespace catena::testing {

using Vector = std::array<GiNaC::ex, 3>;
inline constexpr const char* kAxes[] = {"side", "down", "across"};

/// Of the order of one and of both signs: the same for a name and a seed each time.
inline GiNaC::ex draw(const std::string& name, unsigned seed = 0) {
  std::seed_seq sequence(name.begin(), name.end());
  std::mt19937 generator(sequence);
  generator.discard(seed);
  return GiNaC::numeric(2 * (static_cast<int>(generator() % 1801) - 900) + 1, 1000);
}

inline GiNaC::ex dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The name of what belongs to link i.
inline std::string name(const std::string& family, int i) {
  return family + "[" + std::to_string(i) + "]";
}

/// The direction of link i in space, of length one, and its rate.
struct LinkDirection {
  Vector along, rate;
};
inline LinkDirection drawn_direction(int i) {
  LinkDirection drawn;
  auto& [e, rate] = drawn;
  for (std::size_t a = 0; a < 3; ++a) {
    e[a] = draw(name(kAxes[a], i));
    rate[a] = draw(name(kAxes[a] + std::string("_rate"), i));
  }
  const GiNaC::ex length = GiNaC::sqrt(dot(e, e)).evalf();
  for (GiNaC::ex& component : e) component = (component / length).evalf();
  const GiNaC::ex turned = dot(rate, e);
  for (std::size_t a = 0; a < 3; ++a) rate[a] = (rate[a] - turned * e[a]).evalf();
  return drawn;
}

}  // namespace catena::testing
