// SPDX-License-Identifier: GPL-3.0-or-later
//
// One model for any number of links. What is emitted above four links reads the same for every
// number but for integers; those that change become expressions in the number.
#pragma once

#include <map>
#include <string>

#include "description/description.hpp"

namespace catena {

/// "chain_any"
std::string any_links_name(const Description& description);

/// <name>.hpp and <name>.cpp, name = any_links_name(description). The model is derived for several
/// numbers of links; two give the expressions, and the statements for the others are compared with
/// what is derived there. Throws std::logic_error where they differ, or where the model has not the
/// structure of the plain chain.
std::map<std::string, std::string> emit_any_links(const Description& description);

}  // namespace catena
