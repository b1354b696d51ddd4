// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/forces/force_smoother.hpp"
#include "identify/forces/law_variable.hpp"

namespace catena {

/// A motion that laws look at: states (q, v, z), one column per node, and their times, s.
struct LawMotion {
  Eigen::MatrixXd state;
  std::vector<double> time;
};

/// What a law looks at besides the state of its time: the accelerations of the angles, or how far each piece of its
/// site has been stretched, where a stretch z of the position or angle x relaxes, z' = x' - z / lag; or the time
/// itself. Of other variables nothing.
struct LawMemory {
  LawSite site;
  LawVariable variable = LawVariable::kSidePosition;
  double lag = 0;  ///< s, where it relaxes

  /// The states of a motion, each with what the law remembers behind it. Stretches begin at zero. Accelerations
  /// come from positions and rates of three nodes.
  Eigen::MatrixXd along(const LawMotion& motion, const LawChain& chain) const;

  /// The recording, linearised about the motion, with the same behind its states.
  LinearRecording added_to(const LinearRecording& recording, const LawMotion& motion,
                           const LawChain& chain) const;
};

}  // namespace catena
