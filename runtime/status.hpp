// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace catena {

/// How a computation ended.
enum class Status {
  kNotRun,
  kSuccess,
  kStepFailure,    ///< the error test kept failing: the step became too small
  kNoConvergence,  ///< the nonlinear equations of a step could not be solved
  kTooManySteps,
  kNotFinite,    ///< the equations gave a value that is not finite
  kSingular,     ///< the mass matrix or the Newton matrix lost a pivot
  kInterrupted,  ///< the caller's keep_going said no
};

/// "success", "step failure", ...
const char* status_name(Status status);

}  // namespace catena
