// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace catena {

/// How deep parentheses, signs, loops, lists and dotted keys may be nested in an input file, and the
/// values of a derivation. Far beyond what anyone writes; readers that call themselves stay within a stack of 1 MB.
inline constexpr int kDeepestNesting = 200;

}  // namespace catena
