// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>

#include "reference/chain_constants.hpp"

namespace catena::reference {

/// Coriolis and centrifugal torques f (N m), one per link; theta in rad, rate in rad/s.
/// Dissertation (4.12), (4.13), with its beta as it stands there.
template <class T>
Vector<T> coriolis(const Chain<T>& chain, const Vector<T>& theta, const Vector<T>& rate) {
  using std::cos;
  using std::sin;
  const std::size_t n = chain.links();
  const auto& l = chain.length;
  const auto& m = chain.mass;
  Vector<T> f(n, T(0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      const int beta = i > j ? 2 : -2;  // (4.13)
      const int sign = beta > 0 ? 1 : -1;
      const std::size_t outer = std::max(i, j);
      // beta l_j (m_max / 2 + m_c + sum_{g > max} m_g)
      //   [-1/2 sign(beta) cos(theta_i) sin(theta_j) + 1/beta sin(theta_i) cos(theta_j)]
      //   thetadot_j^2
      const T bracket =
          sin(theta[i]) * cos(theta[j]) / beta - cos(theta[i]) * sin(theta[j]) * sign / 2;
      f[i] = f[i] +
             beta * l[j] * (m[outer] / 2 + mass_beyond(chain, outer)) * bracket * rate[j] * rate[j];
    }
    f[i] = l[i] * f[i];
  }
  return f;
}

}  // namespace catena::reference
