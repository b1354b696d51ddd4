// SPDX-License-Identifier: GPL-3.0-or-later
//
// What emitted C++ has in common whether it is for one number of links or for any.
#pragma once

#include <string>

#include "generator/emission/model_functions.hpp"

namespace catena {

inline const char* const kBanner =
    "// SPDX-License-Identifier: BSD-3-Clause\n"
    "// Written by catena-derive. Do not edit: change the model description and derive again.\n";

/// "20 additions, 12 multiplications, ..."
std::string operations_text(const OperationCount& count);

/// What was found of the matrices, as lines of a comment.
std::string structure_text(const ModelFunctions& functions);

/// CATENA_EACH_PROCESSOR and point(): what the functions behind the table begin with.
std::string processors_text();

/// c_newton_factor, c_newton_solve and its like. `matrix`: a statement that makes the `matrix` to
/// be factored in `work`; `factored`: a function of that name that gives it back.
std::string newton_text(const std::string& matrix, const std::string& factored);

/// sets_at_once() and c_accelerations, which calls `accelerations` with as many points as a
/// register of the processor holds numbers.
std::string several_at_once_text(const std::string& accelerations);

}  // namespace catena
