// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/problem/evaluation.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

/// What the end of a fit says of a recording.
struct FitRemark {
  std::size_t experiment = 0;  ///< the first of its windows that is concerned
  std::string recording;       ///< its name in the case
  std::string words;
};

/// One remark for each recording that the fit leaves far above the noise: more than noise is left, and
/// the next step is a diagnosis. Of windows it gives the range. The noise is that of the case, or else
/// that of the residuals.
std::vector<FitRemark> remarks_on_fit(const Problem& problem, const Evaluation& best);

}  // namespace catena
