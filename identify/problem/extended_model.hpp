// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "runtime/model.hpp"

namespace catena {

/// A parameter that no equation of motion reads: it says how a motion is seen.
struct SensorParameter {
  std::string name;
  catena_parameter entry;  ///< all but the name
};

/// The model with these parameters behind its own.
Model extended_model(const Model& model, const std::vector<SensorParameter>& parameters);

}  // namespace catena
