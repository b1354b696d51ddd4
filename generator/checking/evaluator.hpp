// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "generator/checking/derivation.hpp"

namespace catena::checking {

/// Evaluates a derivation. `links` replaces the number of links that the derivation states. `effects` are
/// those of the chain; "load_drag_coefficient" is a parameter of one. Throws InputError with file, line and
/// column for unknown names, indices out of range, divisions by zero and similar errors, and if there is
/// nothing to check.
Derivation evaluate(const Program& program, const std::string& file,
                    std::optional<int> links = std::nullopt,
                    const std::vector<Effect>& effects = {});

}  // namespace catena::checking
