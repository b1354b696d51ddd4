// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "reference/chain_constants.hpp"

namespace catena::reference {

/// Gravity torques g_i (N m), one per link; theta in rad. Dissertation (4.23).
template <class T>
Vector<T> gravity(const Chain<T>& chain, const Vector<T>& theta) {
  using std::sin;
  Vector<T> torque(chain.links(), T(0));
  for (std::size_t i = 0; i < chain.links(); ++i) {
    // g_i = l_i (m_i / 2 + m_c + sum_{k = i + 1}^n m_k) g sin(theta_i)
    torque[i] = chain.length[i] * (chain.mass[i] / 2 + mass_beyond(chain, i)) * chain.gravity *
                sin(theta[i]);
  }
  return torque;
}

}  // namespace catena::reference
