// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "identify/forces/chain_measures.hpp"
#include "identify/forces/force_path.hpp"
#include "identify/forces/missing_force.hpp"

namespace catena {

/// A force in every direction at each place, each direction in its group. `places`: arc lengths, m.
std::vector<ForcePattern> point_patterns(const std::vector<double>& places,
                                         const ChainMeasures& chain);

/// Tries a force at each place alone, about the motion with forces everywhere.
class PlaceSearch {
 public:
  /// `paths`: settled with forces everywhere, which give the size from which single places are tried;
  /// other patterns act on it afterwards. Both must outlive this object.
  PlaceSearch(ForcePaths& paths, const ChainMeasures& chain);

  /// False where the equations cannot be followed.
  bool look_everywhere(MissingForce& missing);
  /// The best of them, looked at more closely.
  bool look_closer(MissingForce& missing);
  /// A moment in joints near the same places alone. Takes one that is better than every place.
  bool look_at_joints(MissingForce& missing);

  /// The error of the camera that explains most about the motion last linearised.
  std::optional<MissingForce::Sensor> best_sensor() const;

  /// The prior variance of the best, in the square of its unit.
  double best_variance() const { return best_variance_; }
  double none() const { return none_; }  ///< log evidence of no force

 private:
  bool linearise(std::vector<ForcePattern> patterns);
  void add(const std::vector<double>& at, std::vector<MissingForce::Place>& places);

  ForcePaths& paths_;
  const ChainMeasures& chain_;
  double size_, none_ = 0, best_variance_ = 0;
  std::optional<LinearProblem> linear_;
  std::vector<double> variance_;  // of each place
};

}  // namespace catena
