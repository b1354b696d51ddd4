// SPDX-License-Identifier: BSD-3-Clause
//
// Models whose number of links is known only when the program runs: what their tables list, and the
// table of one number of links with all names.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "catena_model.h"

namespace catena {

/// A parameter: one, or name_1 ... name_n.
struct ParameterFamily {
  catena_parameter parameter;
  bool of_each_link;
  bool description_numbered;  ///< the number of the link ends the description
};

/// A coordinate, state, signal or event: one, or name_1 ... name_n.
struct QuantityFamily {
  catena_quantity quantity;
  bool of_each_link;
};

/// The model of one number of links. Chain: that of an emitted <id>_any.hpp.
template <class Chain>
class AnyLinksModel {
 public:
  /// links: at least kFewestLinks of <id>_any.hpp.
  explicit AnyLinksModel(int links) : chain_{links}, table_(table(chain_)) {
    table_.id = numbered(Chain::kId, links);
    for (const ParameterFamily& family : Chain::kParameters) {
      for (int i = 1; i <= (family.of_each_link ? links : 1); ++i) {
        catena_parameter& row = parameters_.emplace_back(family.parameter);
        if (family.of_each_link) row.name = numbered(row.name, i);
        if (family.description_numbered) row.description = numbered(row.description, i, " ");
      }
    }
    table_.parameter = parameters_.data();
    table_.coordinate = listed(Chain::kCoordinates, coordinates_);
    table_.state = listed(Chain::kStates, states_);
    table_.signal = listed(Chain::kSignals, signals_);
    table_.event = listed(Chain::kEvents, events_);
  }
  AnyLinksModel(const AnyLinksModel&) = delete;
  AnyLinksModel& operator=(const AnyLinksModel&) = delete;

  /// Lives as long as this object.
  const catena_model& model() const { return table_; }

 private:
  const char* numbered(const char* name, int number, const char* between = "_") {
    return texts_.emplace_back(name + (between + std::to_string(number))).c_str();
  }

  template <class Families>
  const catena_quantity* listed(const Families& families, std::vector<catena_quantity>& rows) {
    for (const QuantityFamily& family : families) {
      for (int i = 1; i <= (family.of_each_link ? chain_.number : 1); ++i) {
        catena_quantity& row = rows.emplace_back(family.quantity);
        if (family.of_each_link) row.name = numbered(row.name, i);
      }
    }
    if (rows.empty()) rows.push_back({nullptr, nullptr});
    return rows.data();
  }

  std::deque<std::string> texts_;
  Chain chain_;
  catena_model table_;
  std::vector<catena_parameter> parameters_;
  std::vector<catena_quantity> coordinates_, states_, signals_, events_;
};

}  // namespace catena
