// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polynomials of the equations of motion as sums of monomials, with sines and cosines put together
// again: what latex_polynomial writes.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <tuple>

namespace catena {

/// What a factor of a monomial is, in the order in which factors are written.
enum class Role {
  kGravity,
  kLength,
  kCosine,  ///< cos(theta_i - theta_j), or cos theta_i where j is 0
  kSine,
  kVersine,  ///< 1 - cos theta_i
  kOther,
  kAngle,
  kRate,
  kAcceleration,
  // coefficients: what is collected in parentheses
  kMass,
  kLoadMass,
  kInertia,
  kStiffness,
  kDamping,
  kTorque,
};

struct MonomialFactor {
  Role role = Role::kOther;
  int first = 0, second = 0;  ///< links; for kOther the rank of the family and the link
  int number = -1;            ///< of the symbol, where it is one

  bool operator<(const MonomialFactor& other) const {
    return std::tie(role, first, second) < std::tie(other.role, other.first, other.second);
  }
  bool is_coefficient() const { return role >= Role::kMass; }
};

using Powers = std::map<MonomialFactor, int>;
using MonomialSum = std::map<Powers, GiNaC::numeric>;  ///< coefficients are never zero

/// Adds a monomial.
void add_monomial(MonomialSum& sum, const Powers& powers, const GiNaC::numeric& coefficient);

/// cos a cos b + sin a sin b = cos(a - b), sin a cos b - cos a sin b = sin(a - b), a before b;
/// sin^2 + cos^2 = 1; x - x cos a = x (1 - cos a): wherever it makes the coefficients smaller.
void combine_trigonometry(MonomialSum& sum);

}  // namespace catena
