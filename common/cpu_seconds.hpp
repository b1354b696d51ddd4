// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <time.h>

namespace catena {

/// s of processor time of this thread: what work costs, whatever else the machine does.
inline double cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace catena
