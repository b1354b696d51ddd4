// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/cvode_bdf.hpp"

#include <nvector/nvector_serial.h>
#include <time.h>

namespace catena::benchmark {

Solution simulate_cvode_bdf(const Cable& cable, const std::vector<double>& times,
                            double relative_tolerance, const BdfEquations& equations) {
  const int n = cable.links;
  SUNContext context;
  SUNContext_Create(nullptr, &context);
  const N_Vector y = N_VNew_Serial(2 * n, context);
  Eigen::Map<Eigen::VectorXd> state(NV_DATA_S(y), 2 * n);
  state << cable.start(), Eigen::VectorXd::Zero(n);
  const auto [matrix, solver] = equations.make_solver(y, context);
  void* cvode = CVodeCreate(CV_BDF, context);
  CVodeInit(cvode, equations.rates, times.front(), y);
  CVodeSetUserData(cvode, equations.user);
  CVodeSStolerances(cvode, relative_tolerance, 1e-2 * relative_tolerance);
  CVodeSetMaxNumSteps(cvode, 100'000'000);
  CVodeSetLinearSolver(cvode, solver, matrix);
  CVodeSetJacFn(cvode, equations.jacobian);
  Solution solution;
  solution.q.resize(n, static_cast<Eigen::Index>(times.size()));
  const clock_t begin = clock();
  for (std::size_t k = 0; k < times.size(); ++k) {
    double t = times[k];
    if (k > 0) CVode(cvode, times[k], y, &t, CV_NORMAL);
    solution.q.col(static_cast<Eigen::Index>(k)) = state.head(n);
  }
  solution.cpu_seconds = static_cast<double>(clock() - begin) / CLOCKS_PER_SEC;
  CVodeFree(&cvode);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(y);
  SUNContext_Free(&context);
  return solution;
}

}  // namespace catena::benchmark
