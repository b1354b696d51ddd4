// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace catena {

/// Which pieces of work, counted from 0, a process does. Pieces are numbered for themselves and take
/// turns, so that what comes of them does not depend on how they are shared out.
struct Shard {
  std::size_t part = 0;  ///< below `of`
  std::size_t of = 1;    ///< processes; 0: none of the work is this one's

  bool has(std::size_t piece) const { return of > 0 && piece % of == part; }
};

}  // namespace catena
