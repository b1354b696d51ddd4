// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sundials/sundials_nvector.h>

namespace catena {

/// A SUNDIALS vector of `size` doubles, contiguous, made for the short vectors of a chain. It has
/// the fused operations that CVODES calls in each step and none that CVODES does not need. Destroy
/// it with N_VDestroy. Throws std::bad_alloc.
N_Vector new_state_vector(sunindextype size, SUNContext context);

/// The elements of such a vector.
double* elements(N_Vector vector);

}  // namespace catena
