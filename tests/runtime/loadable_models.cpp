// SPDX-License-Identifier: BSD-3-Clause
//
// Shared libraries for the tests of Model::load; compiled once per LOADABLE_MODEL_* definition.
#include "tests/runtime/reference_model.hpp"

#ifdef LOADABLE_MODEL_WITHOUT_ENTRY
extern "C" const catena_model* some_other_name() { return nullptr; }
#else
extern "C" const catena_model* catena_model_table() {
  static catena_model model = *catena::testing::reference_model<3>();
#if defined(LOADABLE_MODEL_OTHER_ABI)
  model.abi = 1;
#elif defined(LOADABLE_MODEL_SHORT)
  model.size = 64;
#elif defined(LOADABLE_MODEL_INCOMPLETE)
  model.residual_tangent = nullptr;
#endif
  return &model;
}
#endif
