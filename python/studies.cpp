// SPDX-License-Identifier: BSD-3-Clause
//
// catena._core: cases and what is done with them.
#include "python/core.hpp"

namespace catena::python {

void add_studies(pybind11::module_&) {}

}  // namespace catena::python
