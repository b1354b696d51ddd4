// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sundials/sundials_nvector.h>

namespace catena {

/// A SUNDIALS vector of `size` doubles for the short vectors of a chain: contiguous, with the fused
/// operations that CVODES calls in each step, and none that it does not need. Destroyed with
/// N_VDestroy. Throws std::bad_alloc.
N_Vector new_state_vector(sunindextype size, SUNContext context);

/// The elements.
double* elements(N_Vector vector);

}  // namespace catena
