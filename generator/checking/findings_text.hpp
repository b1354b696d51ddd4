// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "generator/checking/comparison.hpp"
#include "generator/checking/derivation.hpp"

namespace catena::checking {

/// The answer of `catena check` for a reader: one paragraph an entry, then remarks on whole
/// matrices, notes, and the count.
std::string findings_text(const std::string& file, const Derivation& derivation,
                          const std::vector<Finding>& findings);

}  // namespace catena::checking
