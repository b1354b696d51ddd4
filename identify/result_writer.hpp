// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identify/error.hpp"
#include "identify/fit.hpp"
#include "identify/motion.hpp"

namespace catena {

/// Everything a result file of `catena identify` says, see docs/file-formats.md.
struct Identification {
  FitResult fit;
  Evaluation before, after;      ///< all frames, at the start and at the best
  std::vector<Motion> motions;   ///< one per experiment, at the best
};

/// result.json of `catena simulate`: a motion without data.
std::string simulation_result_text(const Problem& problem, const Motion& motion);
/// result.json of `catena simulate` where the case has data: motions and comparison at x.
std::string comparison_result_text(const Problem& problem, const Eigen::VectorXd& x,
                                   const Evaluation& evaluation, const std::vector<Motion>& motions);
/// result.json of `catena identify`.
std::string identification_result_text(const Problem& problem, const Identification& found);

}  // namespace catena
