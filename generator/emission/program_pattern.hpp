// SPDX-License-Identifier: GPL-3.0-or-later
//
// Statements for any number of links from those for two numbers.
#pragma once

#include "generator/emission/program.hpp"

namespace catena {

/// The statements that are `here` for `links` links and `there` for one more. Whether they hold for
/// other numbers is for the caller to compare (at_links, written_out).
/// Throws std::logic_error if the two differ in more than integers for_each_affine visits.
Statements for_any_links(Statements here, Statements there, long links);

}  // namespace catena
