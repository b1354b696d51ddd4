// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace catena {

/// About what a piece of work will take.
struct WorkEstimate {
  double seconds = 0;    ///< s, on all the threads that it may use
  double bytes = 0;      ///< of memory
  bool or_more = false;  ///< the time is not known, only that it is more than this
};

/// What is begun without being asked for by --yes (in Python: large_work=True): a wait that nobody is
/// surprised by, and memory that every machine of today has.
inline constexpr WorkEstimate kMostUnasked = {600, 4e9};

/// Throws InputError "WHAT needs about 40 GB and 20 min; ..." where the work is above kMostUnasked
/// and `yes` is false.
void require_yes(bool yes, const std::string& what, const WorkEstimate& estimate);

}  // namespace catena
