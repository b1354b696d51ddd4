// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "runtime/dynamics.hpp"

namespace catena {

/// One entry of an array that holds CATENA_DIRECTIONS numbers for each: those of as many
/// directions.
struct alignas(CATENA_DIRECTIONS * sizeof(double)) Several {
  double of[CATENA_DIRECTIONS];
};

inline const double* numbers(const std::vector<Several>& several) { return several.data()->of; }
inline double* numbers(std::vector<Several>& several) { return several.data()->of; }

/// Tangents of a model along CATENA_DIRECTIONS directions at once: by its own functions for that,
/// or one direction at a time where it has none.
class SeveralTangents {
 public:
  explicit SeveralTangents(const Dynamics& dynamics);

  /// Arrays of `along` and the results hold CATENA_DIRECTIONS numbers for each entry, aligned as
  /// Several is; along.t and along.u are taken as zero.
  void residual(const catena_point& at, const catena_point& along, double* dr);
  void state_rate(const catena_point& at, const catena_point& along, double* dzdot);

 private:
  using Tangent = void (Model::*)(const catena_point& at, const catena_point& along,
                                  double* change) const;
  void one_at_a_time(Tangent tangent, const catena_point& at, const catena_point& along, int count,
                     double* changes);

  const Dynamics& dynamics_;
  std::vector<double> q_, v_, a_, z_, p_, change_;
};

}  // namespace catena
