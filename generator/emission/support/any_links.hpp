// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "catena_model.h"

namespace catena {

/// A parameter of a chain whose number of links is known only when the program runs.
struct ParameterFamily {
  catena_parameter parameter;
  /// name_1 ... name_n, and the number of the link ends the description
  bool of_each_link;
};

}  // namespace catena
