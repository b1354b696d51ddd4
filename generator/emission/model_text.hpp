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

/// How the functions behind a table use its context, as pieces of text.
struct Context {
  std::string parameter;        ///< of a function of the table
  std::string inner_parameter;  ///< of a function that those call, with its comma
  std::string argument;         ///< for it, with its comma
  std::string object;           ///< whose members the emitted functions are, with its dot
};
/// A model for one number of links is free functions, which need none.
inline const Context kNoContext{"const void*", "", "", ""};
/// The model for any number of links is the members of a Chain.
inline const Context kChainContext{"const void* context", "const void* context, ", "context, ",
                                   "chain(context)."};

/// c_<name>: a function of the table.
std::string table_function_text(const TableFunction& function, const Context& context);

/// c_newton_factor, c_newton_solve and its like. `matrix_in_work`: an expression of `matrix_type`
/// for the matrix whose numbers are in `work`.
std::string newton_text(const Context& context, const std::string& matrix_type,
                        const std::string& matrix_in_work);

/// batch_size() and c_accelerations, which calls `accelerations` with as many points as a register
/// of the processor holds numbers.
std::string batch_text(const Context& context, const std::string& accelerations);

}  // namespace catena
