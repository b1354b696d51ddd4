// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>

namespace catena {

/// The headers that every emitted model includes, name -> text, as they stand in
/// generator/emission/support; compiled in.
std::map<std::string, std::string> support_text();

}  // namespace catena
