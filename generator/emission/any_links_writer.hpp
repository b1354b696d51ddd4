// SPDX-License-Identifier: GPL-3.0-or-later
//
// One model for any number of links. Above four links the programs for all numbers are the same but
// for integers that are affine in the number (program_pattern.hpp).
#pragma once

#include <map>
#include <string>

#include "description/description.hpp"

namespace catena {

/// "chain_any"
std::string any_links_name(const Description& description);

/// <name>.hpp and <name>.cpp, name = any_links_name(description). The model is derived for several
/// numbers of links; two give the program, and the statements for the others are compared with what
/// is derived there.
/// Throws InputError, naming the effects, where the statements differ.
std::map<std::string, std::string> emit_any_links(const Description& description);

}  // namespace catena
