// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/cvode_dense.hpp"

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <time.h>

#include <Eigen/Cholesky>

namespace catena::benchmark {
namespace {

struct Equations {
  Model model;
  Eigen::VectorXd p;
  Eigen::MatrixXd mass;
  Eigen::VectorXd bias;
  Eigen::LLT<Eigen::MatrixXd> factors;
};

int rates(double t, N_Vector y, N_Vector ydot, void* user) {
  auto& equations = *static_cast<Equations*>(user);
  const int n = equations.model.links();
  const double *q = NV_DATA_S(y), *v = q + n;
  const catena_point at{t, q, v, nullptr, nullptr, nullptr, equations.p.data()};
  equations.model.table().mass_matrix(equations.model.table().context, &at, equations.mass.data());
  equations.model.table().bias(equations.model.table().context, &at, equations.bias.data());
  equations.factors.compute(equations.mass);
  Eigen::Map<Eigen::VectorXd> out(NV_DATA_S(ydot), 2 * n);
  out.head(n) = Eigen::Map<const Eigen::VectorXd>(v, n);
  out.tail(n) = -equations.factors.solve(equations.bias);
  return 0;
}

}  // namespace

Solution simulate_cvode_dense(const Cable& cable, double rest_angle,
                              const std::vector<double>& times, double relative_tolerance) {
  const int n = cable.links;
  const Model model = Model::built_in(n);
  Equations equations{model, cable.parameters(model, rest_angle), Eigen::MatrixXd(n, n),
                      Eigen::VectorXd(n), Eigen::LLT<Eigen::MatrixXd>(n)};
  SUNContext context;
  SUNContext_Create(nullptr, &context);
  const N_Vector y = N_VNew_Serial(2 * n, context);
  Eigen::Map<Eigen::VectorXd> state(NV_DATA_S(y), 2 * n);
  state << cable.start(), Eigen::VectorXd::Zero(n);
  void* cvode = CVodeCreate(CV_BDF, context);
  const SUNMatrix matrix = SUNDenseMatrix(2 * n, 2 * n, context);
  const SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  CVodeInit(cvode, rates, times.front(), y);
  CVodeSetUserData(cvode, &equations);
  CVodeSStolerances(cvode, relative_tolerance, 1e-2 * relative_tolerance);
  CVodeSetMaxNumSteps(cvode, 100'000'000);
  CVodeSetLinearSolver(cvode, solver, matrix);
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
