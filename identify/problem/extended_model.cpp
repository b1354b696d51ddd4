// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/extended_model.hpp"

#include <memory>

namespace catena {

Model extended_model(const Model& model, const std::vector<SensorParameter>& parameters) {
  struct Extended {
    Model model;
    std::vector<SensorParameter> added;
    std::vector<catena_parameter> parameters;
    catena_model table;
  };
  const catena_model& table = model.table();
  const auto own = std::make_shared<Extended>(
      Extended{model, parameters, {table.parameter, table.parameter + table.parameters}, table});
  for (const SensorParameter& parameter : own->added) {
    own->parameters.push_back(parameter.entry);
    own->parameters.back().name = parameter.name.c_str();
  }
  own->table.parameter = own->parameters.data();
  own->table.parameters = static_cast<int32_t>(own->parameters.size());
  return Model(std::shared_ptr<const catena_model>(own, &own->table));
}

}  // namespace catena
