// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/cvode_dense.hpp"

#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <Eigen/Cholesky>

#include "benchmarks/cvode_bdf.hpp"

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
  const auto make_solver = [n](N_Vector y, SUNContext context) {
    const SUNMatrix matrix = SUNDenseMatrix(2 * n, 2 * n, context);
    return std::pair(matrix, SUNLinSol_Dense(y, matrix, context));
  };
  return simulate_cvode_bdf(cable, times, relative_tolerance,
                            {rates, nullptr, &equations, make_solver});
}

}  // namespace catena::benchmark
