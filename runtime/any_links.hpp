// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "runtime/model.hpp"

namespace catena {

/// The fewest links that the model for any number has; below it the built-in models are short, and
/// written out.
inline constexpr int kFewestLinks = 5;

/// The plain chain of a number of links that is known only when the program runs, without deriving
/// or compiling anything: from 5 links on the equations of generated/chain_any.hpp, below the
/// built-in model. It gives the bits of the model derived and compiled for this number.
///
/// Each call makes a model of its own, any number of which may exist at the same time. May be called
/// from several threads. Throws InputError for fewer than 2 links or more than kMostLinks (common/most_links.hpp).
Model any_links_model(int links);

}  // namespace catena
