// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/status.hpp"

namespace catena {

const char* status_name(Status status) {
  switch (status) {
    case Status::kNotRun:
      return "not run";
    case Status::kSuccess:
      return "success";
    case Status::kStepFailure:
      return "step failure";
    case Status::kNoConvergence:
      return "no convergence";
    case Status::kTooManySteps:
      return "too many steps";
    case Status::kNotFinite:
      return "not finite";
    case Status::kSingular:
      return "singular";
    case Status::kInterrupted:
      return "interrupted";
  }
  return "unknown";
}

}  // namespace catena
