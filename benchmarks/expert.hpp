// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "benchmarks/table_6_1_cable.hpp"

namespace catena::benchmark {

/// What an expert writes by hand for the planar chain in absolute angles: loops over the links,
/// as in C, for a number of links known to the compiler. Sines and cosines come from the C
/// library's vector functions. All arrays have one entry a link.
class Expert {
 public:
  virtual ~Expert() = default;

  /// Accelerations a (rad/s^2) of the angles q (rad) at the rates v (rad/s). Articulated bodies:
  /// from the tip, the force in a joint is A r'' + b with A of 2x2.
  virtual void accelerations(const double* q, const double* v, double* a) = 0;
  /// The generalised forces that the motion q, v, a lacks, N m.
  virtual void residual(const double* q, const double* v, const double* a, double* r) = 0;
  /// The change of the residual at (q, v, a) along (dq, dv, da).
  virtual void tangent(const double* q, const double* v, const double* a, const double* dq,
                       const double* dv, const double* da, double* dr) = 0;
  /// Factors cm dr/da + cv dr/dv + cq dr/dq at (q, v, a): the same recursion, with the angle of the
  /// link above as a third unknown of a joint, hence 3x3.
  virtual void newton_factor(const double* q, const double* v, const double* a, double cm,
                             double cv, double cq) = 0;
  /// Solves with the last factors, in place.
  virtual void newton_solve(double* x) = 0;
};

/// Null for a number of links that is not compiled: 2, 3, 4, 12, 60, 240 and 1000 are.
/// `rest_angle` (rad) is that of joint 1.
std::unique_ptr<Expert> make_expert(const Cable& cable, double rest_angle = 0.0);

}  // namespace catena::benchmark
