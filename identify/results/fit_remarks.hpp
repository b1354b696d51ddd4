// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/problem/evaluation.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

/// What the end of a fit says of each experiment: where it is far above the noise, more than noise is
/// left, and the next step is a diagnosis. Empty where there is nothing to say. The noise is that of the
/// case, or else that of the residuals.
std::vector<std::string> remarks_on_fit(const Problem& problem, const Evaluation& best);

}  // namespace catena
