// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order in which families are computed: sweeps over the links.
#pragma once

#include <algorithm>
#include <vector>

#include "generator/emission/families.hpp"

namespace catena {

struct Sweep {
  int direction;  ///< +1 towards the tip, -1 towards the support, 0: not over links
  std::vector<size_t> families;

  /// Whether a family, by its place in Families::all, is computed in it.
  bool has(size_t family) const {
    return std::find(families.begin(), families.end(), family) != families.end();
  }
};

/// Puts every family into a sweep and says where its values are read (Family::sweep, local, carried, kept).
/// `layout`: kLoops or kWholeSweeps. Throws std::logic_error if there is no order of statements.
std::vector<Sweep> schedule(Families& families, Layout layout);

}  // namespace catena
