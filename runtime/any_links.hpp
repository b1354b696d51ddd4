// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "runtime/model.hpp"

namespace catena {

/// The fewest links that the model for any number has; below it the built-in models are short, and
/// written out.
inline constexpr int kFewestLinks = 5;
/// The most links any_links_model takes: the arrays of a call lie on the stack, the largest set of
/// them with 400 bytes a link, and a thread has 8 MB.
inline constexpr int kMostLinks = 10'000;

/// The plain chain of a number of links that is known only when the program runs, without deriving
/// or compiling anything: from 5 links on the equations of generated/chain_any.hpp, below the
/// built-in model. It gives the bits of the model derived and compiled for this number.
///
/// Models of at most 64 different numbers of links can be there at the same time; a number is free
/// again when the last copy is gone. May be called from several threads. Throws InputError for
/// fewer than 2 links or more than kMostLinks, or when there are 64 already.
Model any_links_model(int links);

}  // namespace catena
