// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <vector>

#include "generator/checking/chain_symbols.hpp"
#include "generator/checking/contribution.hpp"
#include "generator/checking/effect_parts.hpp"

namespace catena::checking {

/// The chain's equations from its energies: kinematics (2.24)-(2.27) with the unit vectors q of the links,
/// energies (2.3)-(2.9) with the load's potential m_c g h_c, which (2.9) leaves out, Rayleigh dissipation, and
///   d/dt(dL/dthetadot_i) - dL/dtheta_i + dD/dthetadot_i - T_i = 0.
/// Nothing is simplified or assumed about the result. Every part keeps its body, joint or torque.
/// Indices run from 1 to n. Heights are measured from the straight chain (2.7). A call costs about
/// n^2 terms, so single entries of chains of many links are cheap.
///
/// In space the equations are those of the elevations, then those of the azimuths. A joint bends by
/// acos(q_{i-1} . q_i), D is that of the difference of q x qdot; C and K are those of small motions about
/// the plumb cable.
///
/// What effects add (EffectParts) comes from the derivation that models are emitted from. It is part
/// of T, V, D, M and the equations; C, K, F and G are those of the plain chain.
class FlatDerivation {
 public:
  /// In space `symbols` have the directions of all links.
  explicit FlatDerivation(const ChainSymbols& symbols, EffectParts effects = {});

  [[nodiscard]] Contributions kinetic() const;      ///< T, J
  [[nodiscard]] Contributions potential() const;    ///< V, J
  [[nodiscard]] Contributions dissipation() const;  ///< D, W
  [[nodiscard]] Contributions lagrangian() const;   ///< T - V, J

  [[nodiscard]] Contributions mass(int i, int j) const;  ///< M_ij, factor of thetaddot_j
  /// C_ij and K_ij, factors of thetadot_j and theta_j. In space they throw std::domain_error if the links
  /// do not point down where all angles are zero.
  [[nodiscard]] Contributions damping(int i, int j) const;
  [[nodiscard]] Contributions stiffness(int i, int j) const;
  [[nodiscard]] Contributions coriolis(int i) const;  ///< F_i, N m
  [[nodiscard]] Contributions gravity(int i) const;   ///< G_i, N m
  /// Left side of equation i, whose right side is 0: M a + C w + K theta + F + G - T, N m.
  [[nodiscard]] Contributions equation(int i) const;

 private:
  [[nodiscard]] Contributions inertial(int i) const;  ///< d/dt dT/dthetadot_i - dT/dtheta_i

  [[nodiscard]] const Contributions& momentum(int i) const;  ///< dT/dthetadot_i

  const ChainSymbols& symbols_;
  mutable std::map<int, Contributions> momenta_;  // those computed so far; M uses each n times
  EffectParts effects_;
  [[nodiscard]] Contributions at_plumb(const Contributions& parts) const;

  Contributions kinetic_, gravity_potential_, elastic_potential_, dissipation_;
  /// With the curvature that elastic_potential_ has where the links point down, without its 0/0 there.
  Contributions elastic_at_plumb_;
};

}  // namespace catena::checking
