// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/cvode_expert.hpp"

#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_matrix.h>

#include "benchmarks/cvode_bdf.hpp"
#include "benchmarks/expert.hpp"

namespace catena::benchmark {
namespace {

/// Where the Jacobian J is taken, and gamma: I - gamma J as CVODE's "matrix".
struct Linearisation {
  Eigen::VectorXd q, v, a;
  double gamma = 0;
};

Linearisation& linearisation(SUNMatrix matrix) {
  return *static_cast<Linearisation*>(matrix->content);
}

SUNMatrix make_matrix(SUNContext context);

SUNMatrix_ID matrix_id(SUNMatrix) { return SUNMATRIX_CUSTOM; }
SUNMatrix clone(SUNMatrix matrix) { return make_matrix(matrix->sunctx); }
void destroy(SUNMatrix matrix) {
  delete &linearisation(matrix);
  SUNMatFreeEmpty(matrix);
}
int zero(SUNMatrix) { return 0; }
int copy(SUNMatrix from, SUNMatrix to) {
  linearisation(to) = linearisation(from);
  return 0;
}
int scale_add_identity(realtype minus_gamma, SUNMatrix matrix) {
  linearisation(matrix).gamma = -minus_gamma;
  return 0;
}

SUNMatrix make_matrix(SUNContext context) {
  const SUNMatrix matrix = SUNMatNewEmpty(context);
  matrix->content = new Linearisation;
  matrix->ops->getid = matrix_id;
  matrix->ops->clone = clone;
  matrix->ops->destroy = destroy;
  matrix->ops->zero = zero;
  matrix->ops->copy = copy;
  matrix->ops->scaleaddi = scale_add_identity;
  return matrix;
}

struct Equations {
  std::unique_ptr<Expert> expert;
  int links;
  Eigen::VectorXd change, none, right;
};

int rates(double, N_Vector y, N_Vector ydot, void* user) {
  auto& equations = *static_cast<Equations*>(user);
  const int n = equations.links;
  const double* state = NV_DATA_S(y);
  double* out = NV_DATA_S(ydot);
  std::copy(state + n, state + 2 * n, out);
  equations.expert->accelerations(state, state + n, out + n);
  return 0;
}

int jacobian(double, N_Vector y, N_Vector ydot, SUNMatrix matrix, void* user, N_Vector, N_Vector,
             N_Vector) {
  const int n = static_cast<Equations*>(user)->links;
  Linearisation& at = linearisation(matrix);
  at.q = Eigen::Map<const Eigen::VectorXd>(NV_DATA_S(y), n);
  at.v = Eigen::Map<const Eigen::VectorXd>(NV_DATA_S(y) + n, n);
  at.a = Eigen::Map<const Eigen::VectorXd>(NV_DATA_S(ydot) + n, n);
  return 0;
}

SUNLinearSolver_Type solver_type(SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; }

int set_up(SUNLinearSolver solver, SUNMatrix matrix) {
  const Linearisation& at = linearisation(matrix);
  static_cast<Equations*>(solver->content)
      ->expert->newton_factor(at.q.data(), at.v.data(), at.a.data(), 1, at.gamma,
                              at.gamma * at.gamma);
  return 0;
}

int solve(SUNLinearSolver solver, SUNMatrix matrix, N_Vector x, N_Vector b, realtype) {
  auto& equations = *static_cast<Equations*>(solver->content);
  const Linearisation& at = linearisation(matrix);
  const int n = equations.links;
  const Eigen::Map<const Eigen::VectorXd> right(NV_DATA_S(b), 2 * n);
  Eigen::Map<Eigen::VectorXd> left(NV_DATA_S(x), 2 * n);
  equations.change = -at.gamma * right.head(n);
  equations.expert->tangent(at.q.data(), at.v.data(), at.a.data(), equations.change.data(),
                            equations.none.data(), right.data() + n, equations.right.data());
  equations.expert->newton_solve(equations.right.data());
  left.head(n) = right.head(n) + at.gamma * equations.right;
  left.tail(n) = equations.right;
  return 0;
}

int free_solver(SUNLinearSolver solver) {
  SUNLinSolFreeEmpty(solver);
  return 0;
}

}  // namespace

Solution simulate_cvode_expert(const Cable& cable, double rest_angle,
                               const std::vector<double>& times, double relative_tolerance) {
  const int n = cable.links;
  Equations equations{make_expert(cable, rest_angle), n, Eigen::VectorXd(n),
                      Eigen::VectorXd::Zero(n), Eigen::VectorXd(n)};
  const auto make_solver = [&equations](N_Vector, SUNContext context) {
    const SUNLinearSolver solver = SUNLinSolNewEmpty(context);
    solver->content = &equations;
    solver->ops->gettype = solver_type;
    solver->ops->setup = set_up;
    solver->ops->solve = solve;
    solver->ops->free = free_solver;
    return std::pair(make_matrix(context), solver);
  };
  return simulate_cvode_bdf(cable, times, relative_tolerance,
                            {rates, jacobian, &equations, make_solver});
}

}  // namespace catena::benchmark
