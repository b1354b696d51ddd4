// SPDX-License-Identifier: GPL-3.0-or-later
//
// What need not be computed while an effect has its neutral values.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "generator/emission/families.hpp"

namespace catena {

/// Finds which families matter only where a switch is on (Family::guard), and which of them are read
/// where they were not computed (Family::zero). What a family adds up only where a switch is on
/// becomes a family of its own, which adds it (Family::adds_to).
void guard_families(Families& families, const std::vector<Switch>& switches);

/// The inputs of the switches of a guard that the function has.
std::vector<std::string> inputs_of_guard(const Families& families,
                                         const std::vector<Switch>& switches,
                                         const std::set<int>& guard);

}  // namespace catena
