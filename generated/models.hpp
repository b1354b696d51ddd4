// SPDX-License-Identifier: BSD-3-Clause
// Written by catena-derive. Do not edit: change the model description and derive again.
#pragma once

#include "catena_model.h"

namespace catena {

/// The models compiled into this library, by ascending number of links; *count of them.
const catena_model* const* built_in_models(int* count);

}  // namespace catena
