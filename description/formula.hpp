// SPDX-License-Identifier: BSD-3-Clause
//
// The physics of an effect as formulas for readers, in LaTeX (math mode, amsmath) and MathML.
//
// v_n, v_t, v_s, v_d, v_a: velocity along normal, tangent, side, down, across; u_n, ...: the same relative
// to the fluid, whose velocity is w_s, ...; r_s, r_d, r_a, r_g: position along side, down, across, gravity; theta: angle of the link; phi: angle of the joint, from its rest; l, m, I:
// length, mass, inertia of the link; k, c: stiffness, damping of the joint; s, Delta: arc length
// and spacing at the joint; m_c: load.
#pragma once

#include <string>
#include <vector>

#include "description/effect.hpp"

namespace catena {

///     const std::vector<Formula> of_drag = formulas(built_in_effect("air_drag_quadratic"));
///     const std::string latex = of_drag.front().latex;
struct Formula {
  std::string what;    ///< "Dissipation per length, at the middle of every link"
  std::string latex;   ///< without delimiters
  std::string mathml;  ///< a whole <math> element, inline
};

/// The formulas of everything that the effect declares, definitions first. Throws InputError if an
/// expression does not follow the grammar.
std::vector<Formula> formulas(const Effect& effect);

}  // namespace catena
