// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "runtime/model.hpp"

namespace catena {

/// The fewest links of the model for any number of links. Shorter chains have built-in models.
inline constexpr int kFewestLinks = 5;

/// The plain chain of a number of links that is known only when the program runs. Nothing is
/// derived or compiled: from 5 links on it uses the equations of generated/chain_any.hpp, below
/// them the built-in model. Results are equal, bit for bit, to those of the model derived and
/// compiled for this number.
///
///     const Model model = any_links_model(37);
///     const int first_stiffness = model.parameter_index("stiffness_1");
///
/// Each call makes a model of its own; any number of them may exist at the same time. May be called
/// from several threads. Throws InputError for fewer than 2 links or more than kMostLinks
/// (common/most_links.hpp).
Model any_links_model(int links);

}  // namespace catena
