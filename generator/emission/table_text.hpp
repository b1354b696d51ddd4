// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of a model (catena_model.h) as text that is both C and C++.
#pragma once

#include <string>

#include "description/description.hpp"
#include "generator/emission/model_functions.hpp"
#include "generator/emission/parameter_table.hpp"

namespace catena {

/// The members of a row, without braces.
std::string quantity_text(const QuantityRow& row);
std::string parameter_text(const ParameterRow& row);

/// Arrays of terms and of energies.
std::string term_array(const ModelFunctions& functions);
std::string energy_array(const ModelFunctions& functions);

/// Arrays of coordinates, states, signals, terms, parameters and energies.
std::string table_arrays(const Description& description, const ModelFunctions& functions);

/// What stands between the braces of the table itself. Constants kLinks ... kParameters and the
/// functions are expected to be declared: c_residual ... in C++, residual ... in C.
std::string table_entries(const Description& description, const ModelFunctions& functions,
                          Language language);

}  // namespace catena
