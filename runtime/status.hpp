// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace catena {

/// How a computation ended.
enum class Status {
  kNotRun,
  kSuccess,
  kStepFailure,    ///< the error test kept failing until the step was too small
  kNoConvergence,  ///< the nonlinear equations of a step could not be solved
  kTooManySteps,
  kNotFinite,    ///< the equations gave a value that is not finite
  kSingular,     ///< a pivot of the mass matrix or of the Newton matrix vanished
  kInterrupted,  ///< keep_going returned false
};

/// "success", "step failure", ...
const char* status_name(Status status);

}  // namespace catena
