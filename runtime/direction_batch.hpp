// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "runtime/model.hpp"

namespace catena {

/// One entry of an array for a batch of directions: CATENA_DIRECTIONS numbers, one per direction.
struct alignas(CATENA_DIRECTIONS * sizeof(double)) DirectionBatch {
  double of[CATENA_DIRECTIONS];
};

/// All numbers of a vector of batches, those of an entry side by side.
inline const double* numbers(const std::vector<DirectionBatch>& batch) { return batch.data()->of; }
inline double* numbers(std::vector<DirectionBatch>& batch) { return batch.data()->of; }

/// Tangents of a model along CATENA_DIRECTIONS directions in one call. A model without functions
/// for batches is called once for each direction.
class BatchTangents {
 public:
  explicit BatchTangents(const Model& model);

  /// Arrays of `along` and the results hold CATENA_DIRECTIONS numbers for each entry, with the
  /// alignment of DirectionBatch. along.t and along.u count as zero.
  void residual(const catena_point& at, const catena_point& along, double* dr);
  void state_rate(const catena_point& at, const catena_point& along, double* dzdot);

 private:
  using Tangent = void (Model::*)(const catena_point& at, const catena_point& along,
                                  double* change) const;
  void one_at_a_time(Tangent tangent, const catena_point& at, const catena_point& along, int count,
                     double* changes);

  Model model_;
  std::vector<double> q_, v_, a_, z_, p_, u_, change_;
};

}  // namespace catena
