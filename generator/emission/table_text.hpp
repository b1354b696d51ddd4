// SPDX-License-Identifier: GPL-3.0-or-later
//
// The table of a model (catena_model.h) as text that is both C and C++.
#pragma once

#include <functional>
#include <string>
#include <vector>

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

/// Arrays of coordinates, states, signals, terms, parameters, energies and, where there are some, events.
std::string table_arrays(const Description& description, const ModelFunctions& functions);

/// What differs between the tables of a model in C++, in C and for any number of links, as
/// expressions. The default is that of C++ for one number of links.
struct TableText {
  std::string size = "sizeof(::catena_model)", null = "nullptr";
  std::string id;  ///< empty: that of the model, quoted
  std::string context = "nullptr";
  std::string links = "kLinks", coordinates = "kCoordinates", states = "kStates",
              signals = "kSignals", parameters = "kParameters";
  std::string events;  ///< their number; empty: the model's own
  std::string event_array = "kEventTable";
  std::string newton_work = "sizeof(NewtonMatrix<double>) / sizeof(double)";
  std::string batch;
  std::vector<std::string> arrays = {"kCoordinateTable", "kStateTable", "kSignalTable",
                                     "kParameterTable"};
  /// The function behind a member of the table that is not null.
  std::function<std::string(const std::string& member)> function;
};

/// What stands between the braces of the table itself.
std::string table_members(const Description& description, const ModelFunctions& functions,
                          const TableText& text);

}  // namespace catena
