// SPDX-License-Identifier: GPL-3.0-or-later
//
// The order, names and units of a model's parameters, coordinates, states and signals: the table's
// view of a description.
#pragma once

#include <string>
#include <vector>

#include "description/description.hpp"
#include "generator/emission/function_body.hpp"

namespace catena {

struct ParameterRow {
  std::string name, unit, description;
  double default_value, lower, upper, neutral;
};

struct QuantityRow {
  std::string name, unit;
};

/// A row of the table, or one for each link: name_1 ... name_n.
template <class Row>
struct TableFamily {
  Row row;
  bool of_each_link = false;
  bool description_numbered = false;  ///< the number of the link ends a parameter's description
};

/// What a model's table lists, in its order, for any number of links.
struct TableFamilies {
  std::vector<TableFamily<ParameterRow>> parameters;
  std::vector<TableFamily<QuantityRow>> coordinates, states, signals;
  std::vector<TableFamily<QuantityRow>> events;  ///< those of one place first
};

/// Of this description.
TableFamilies table_families(const Description& description);

/// The same for `links` links, row by row.
struct ModelTable {
  std::vector<ParameterRow> parameters;
  std::vector<QuantityRow> coordinates, states, signals, events;
};

/// Of this description.
ModelTable model_table(const Description& description, int links);

/// Where a family of the derivation's inputs stands in a point.
struct InputPlace {
  std::string family;
  char member;   ///< 'q', 'v', 'a', 'z', 'u' or 'p'
  int offset;    ///< of the first in the member
  int count;     ///< symbols of the family
  bool indexed;  ///< by link, from 1; else the one symbol has no index
};
/// Of all inputs of this description.
std::vector<InputPlace> input_places(const Description& description, int links);

/// What brings the derivation's inputs into an emitted function.
/// `point`: the argument that has q, v, a, z, u, p and t; empty: they are arguments themselves.
/// `differentials`: of the inputs, "d_<family>"; where `point` is empty, their arguments are "dq" ...
/// `type`: of the inputs.
Inputs inputs_of(const Description& description, int links, const std::string& point,
                 bool differentials, Type type);

}  // namespace catena
