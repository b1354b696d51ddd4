// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace catena {

/// Counts and places are int in the tables of models; containers ask for std::size_t.
///
///     const std::size_t place = as_index(3);
constexpr std::size_t as_index(int i) { return static_cast<std::size_t>(i); }

}  // namespace catena
