// SPDX-License-Identifier: GPL-3.0-or-later
//
// Chains in space with effects, at seeded random points in 50-digit arithmetic.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "generator/certificate/exact_evaluation.hpp"
#include "generator/derivation/chain.hpp"
#include "tests/generator/derivation/seeded_vectors.hpp"

namespace catena::testing::space_point {

using GiNaC::ex;
using GiNaC::numeric;

inline constexpr int kLinks = 3;
inline constexpr int kDigits = 50;
// Evaluation in 50 digits loses a few to cancellation; a wrong term would be of order one.
inline constexpr double kTolerance = 1e-40;

/// A number for every name of a parameter or signal, the same each time. What flows, moves or tilts has both
/// signs, all else is positive. Nothing flows across unless a test says so.
inline ex value_of(const std::string& name, unsigned seed) {
  for (const char* signed_name : {"speed", "wind", "current_side", "support_", "tilt", "fraction"})
    if (name.find(signed_name) != std::string::npos) return draw(name, seed);
  return GiNaC::abs(draw(name, seed)) + numeric(1, 5);
}

inline ex numeric_of(const ex& e) { return e.evalf(); }

inline double size(const ex& e) { return std::abs(GiNaC::ex_to<numeric>(e.evalf()).to_double()); }

inline double difference(const ex& a, const ex& b) { return size(a - b) / (1 + size(a)); }

inline Description with(const std::vector<std::string>& effects, Space space) {
  Description description = plain_chain();
  description.space = space;
  for (const std::string& id : effects) description.effects.push_back(built_in_effect(id));
  return description;
}

/// Values of inputs, those that are set first.
struct Inputs {
  unsigned seed;
  std::map<std::string, ex> set = {};

  ex operator()(const std::string& name) const {
    const auto found = set.find(name);
    return found != set.end() ? found->second : value_of(name, seed);
  }
};

inline void set_vector(Inputs& inputs, int i, const char* dots, const Vector& vector) {
  for (std::size_t k = 0; k < 3; ++k)
    inputs.set[name("direction_" + std::string(kAxes[k]) + dots, i)] = vector[k].evalf();
}

inline void set_slip(Inputs& inputs, int i, const Vector& vector) {
  for (std::size_t k = 0; k < 3; ++k)
    inputs.set[name("joint_hysteresis_slip_" + std::string(kAxes[k]), i)] = vector[k].evalf();
}

/// d(stored)/dt = supplied - dissipated + v.r, whatever the accelerations.
inline double imbalance(Chain& chain, ExactEvaluation& evaluation) {
  ex balance = 0;
  for (const EnergyItem& item : chain.energies()) {
    for (const ex& part : item.parts) {
      if (item.kind == EnergyItem::kStored) balance += evaluation.of(chain.rate(part));
      if (item.kind == EnergyItem::kSupplied) balance -= evaluation.of(part);
      if (item.kind == EnergyItem::kDissipated) balance += evaluation.of(part);
    }
  }
  for (std::size_t k = 0; k < chain.residual().size(); ++k)
    balance -= evaluation.of(chain.rates()[k]) * evaluation.of(chain.residual()[k]);
  return size(balance);
}

inline ex component(Chain& chain, ExactEvaluation& evaluation, int i, std::size_t axis) {
  return evaluation.of(chain.residual()[axis * kLinks + static_cast<std::size_t>(i) - 1]);
}

}  // namespace catena::testing::space_point
