// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/cases/case.hpp"

namespace catena {

/// What a squared residual s, in units of the noise squared, counts: rho(s), and its derivatives.
struct LossValue {
  double value = 0, slope = 0, curvature = 0;
};

/// The loss of a case. With a = loss_scale:
///
///   none      s
///   huber     s up to a^2, then 2 a sqrt(s) - a^2
///   soft_l1   2 a^2 (sqrt(1 + s / a^2) - 1)
///   cauchy    a^2 log(1 + s / a^2)
LossValue loss_of(const ErrorSpec& error, double square);

}  // namespace catena
