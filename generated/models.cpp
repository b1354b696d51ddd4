// SPDX-License-Identifier: BSD-3-Clause
// Written by catena-derive. Do not edit: change the model description and derive again.
#include "models.hpp"

#include "chain_2.hpp"
#include "chain_3.hpp"
#include "chain_4.hpp"
#include "chain_12.hpp"
#include "chain_60.hpp"

namespace catena {

const catena_model* const* built_in_models(int* count) {
  static const catena_model* const models[] = {
      &chain_2::table(),
      &chain_3::table(),
      &chain_4::table(),
      &chain_12::table(),
      &chain_60::table(),
  };
  *count = 5;
  return models;
}

}  // namespace catena
