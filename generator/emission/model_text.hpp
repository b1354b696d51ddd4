// SPDX-License-Identifier: GPL-3.0-or-later
//
// What emitted C++ has in common whether it is for one number of links or for any.
#pragma once

#include <string>
#include <vector>

#include "generator/emission/model_functions.hpp"

namespace catena {

inline const char* const kBanner =
    "// SPDX-License-Identifier: BSD-3-Clause\n"
    "// Written by catena-derive. Do not edit: change the model description and derive again.\n";

/// kOne: known when the model is emitted, the functions are free and the table needs no context.
/// kAny: known at run time, the functions are members of the Chain that is the table's context.
enum class NumberOfLinks { kOne, kAny };

/// What was found of the matrices, as lines of a comment.
std::string structure_text(const ModelFunctions& functions);

/// `head`, arguments and `end` in lines of at most `width` characters where the arguments allow it.
std::string in_lines(std::string head, const std::vector<std::string>& arguments,
                     const std::string& end, std::size_t width = 100);

/// The #include that models in space have besides.
std::string space_include(const ModelFunctions& functions);

/// MassMatrix and NewtonMatrix, as far as the model has them.
std::string matrix_types_text(const ModelFunctions& functions, NumberOfLinks links);

/// All functions, documentation included.
std::string functions_text(const ModelFunctions& functions, NumberOfLinks links);

/// The functions of double precision behind the table: c_residual, ..., and batch_size() where the
/// model may be evaluated in batches.
std::string table_functions_text(const ModelFunctions& functions, NumberOfLinks links);

}  // namespace catena
