// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <vector>

#include "description/description.hpp"
#include "description/effect.hpp"

namespace catena::checking {

/// The symbols of a chain of n links. Vectors are indexed 1..n. Entry 0 is that of the support:
/// angle[0], rate[0] and acceleration[0] are 0, the others are not used. In space each link has two
/// angles: entries 1..n are elevations, n+1..2n azimuths, and so are those of the torques.
struct ChainSymbols {
  explicit ChainSymbols(int links, const std::vector<Effect>& effects = {},
                        Space space = Space::kPlane);

  int links;
  Space space;
  std::vector<GiNaC::ex> angle;         ///< theta_i; in the plane from the downward vertical, rad
  std::vector<GiNaC::ex> rate;          ///< thetadot_i, rad/s
  std::vector<GiNaC::ex> acceleration;  ///< thetaddot_i, rad/s^2
  std::vector<GiNaC::ex> azimuth;       ///< in space: phi_i, those of `angle`; else empty
  std::vector<GiNaC::ex> azimuth_rate, azimuth_acceleration;
  /// The unit vector of link i, from its upper to its lower end: side, down, across. Entry 0 points
  /// down. In the plane (sin theta_i, cos theta_i, 0). In space the derivation says what it is; until then
  /// it is empty.
  std::vector<std::vector<GiNaC::ex>> direction;
  std::vector<GiNaC::ex> length;     ///< l_i, m
  std::vector<GiNaC::ex> mass;       ///< m_i, kg
  std::vector<GiNaC::ex> inertia;    ///< I_i, about the link's own centre, kg m^2
  std::vector<GiNaC::ex> stiffness;  ///< k_i, N m/rad
  std::vector<GiNaC::ex> damping;    ///< c_i, N m s/rad
  std::vector<GiNaC::ex> torque;     ///< T_i, external, on angle i, N m
  GiNaC::ex load_mass;               ///< m_c, kg
  GiNaC::ex gravity;                 ///< g, m/s^2
  /// The parameters of effects: "load_drag_coefficient" is entry 0; entries 1..n, if there are any,
  /// are those of the joints or links.
  std::map<std::string, std::vector<GiNaC::ex>> effects;

  /// How many angles there are.
  [[nodiscard]] int coordinates() const { return static_cast<int>(angle.size()) - 1; }

  /// d/dt of an expression in these symbols, where angles and rates are functions of time. Throws
  /// std::invalid_argument if it contains an acceleration: there are no third derivatives.
  [[nodiscard]] GiNaC::ex time_derivative(const GiNaC::ex& expression) const;

  /// True if angles, rates and accelerations do not occur in the expression.
  [[nodiscard]] bool is_constant(const GiNaC::ex& expression) const;

 private:
  GiNaC::exmap derivative_;  ///< angle -> rate, rate -> acceleration
  GiNaC::exset accelerations_;
};

/// Partial, by one of the symbols.
GiNaC::ex derivative(const GiNaC::ex& expression, const GiNaC::ex& symbol);

}  // namespace catena::checking
