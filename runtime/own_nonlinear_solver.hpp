// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sundials/sundials_nonlinearsolver.h>

#include <memory>
#include <new>

namespace catena {

struct SunNonlinearSolverDeleter {
  void operator()(SUNNonlinearSolver solver) const { SUNNonlinSolFree(solver); }
};
using SunNonlinearSolverHandle =
    std::unique_ptr<_generic_SUNNonlinearSolver, SunNonlinearSolverDeleter>;

using SolveFunction = int (*)(SUNNonlinearSolver, N_Vector predicted, N_Vector correction,
                              N_Vector weight, double tolerance, booleantype, void* cvode);

/// A nonlinear solver for CVODES that calls `solve` instead of one of SUNDIALS; `owner` becomes its
/// content. Throws std::bad_alloc.
inline SunNonlinearSolverHandle own_nonlinear_solver(SUNContext context, void* owner,
                                                     SolveFunction solve) {
  SunNonlinearSolverHandle handle(SUNNonlinSolNewEmpty(context));
  if (!handle) throw std::bad_alloc();
  handle->content = owner;
  handle->ops->gettype = [](SUNNonlinearSolver) { return SUNNONLINEARSOLVER_FIXEDPOINT; };
  handle->ops->setsysfn = [](SUNNonlinearSolver, SUNNonlinSolSysFn) { return 0; };
  handle->ops->solve = solve;
  handle->ops->free = [](SUNNonlinearSolver solver) {
    SUNNonlinSolFreeEmpty(solver);
    return 0;
  };
  return handle;
}

}  // namespace catena
