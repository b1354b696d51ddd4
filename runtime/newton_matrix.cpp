// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/newton_matrix.hpp"

#include <cmath>
#include <stdexcept>

namespace catena {

void NewtonMatrix::solve_several(double* x) const {
  for (std::size_t k = 0; k < CATENA_DIRECTIONS; ++k) {
    for (std::size_t i = 0; i < column_.size(); ++i) column_[i] = x[CATENA_DIRECTIONS * i + k];
    solve(column_.data());
    for (std::size_t i = 0; i < column_.size(); ++i) x[CATENA_DIRECTIONS * i + k] = column_[i];
  }
}

StructuredNewtonMatrix::StructuredNewtonMatrix(const Model& model)
    : NewtonMatrix(model),
      factor_(model.table().newton_factor),
      solve_(model.table().newton_solve),
      solve_several_(model.table().newton_solves),
      solve_transposed_(model.table().newton_solve_transposed),
      work_(static_cast<std::size_t>(model.table().newton_work)) {}

int StructuredNewtonMatrix::factor(Dynamics&, const catena_point& at, double gamma) {
  return factor_(&at, 1.0, gamma, gamma * gamma, work_.data());
}

void StructuredNewtonMatrix::solve(double* x) const { solve_(work_.data(), x); }

void StructuredNewtonMatrix::solve_several(double* x) const {
  if (solve_several_ != nullptr)
    solve_several_(work_.data(), x);
  else
    NewtonMatrix::solve_several(x);
}

void StructuredNewtonMatrix::solve_transposed(double* x) const {
  solve_transposed_(work_.data(), x);
}

DenseNewtonMatrix::DenseNewtonMatrix(const Model& model) : NewtonMatrix(model) {
  const int n = model.coordinates(), size = n + model.states();
  matrix_.resize(size, size);
  factors_ = Eigen::PartialPivLU<Eigen::MatrixXd>(size);
  permuted_.resize(size);
  for (std::vector<double>* direction : {&dq_, &dv_, &da_})
    direction->assign(static_cast<std::size_t>(n), 0.0);
  dz_.assign(static_cast<std::size_t>(model.states()), 0.0);
}

int DenseNewtonMatrix::factor(Dynamics& dynamics, const catena_point& at, double gamma) {
  const catena_model& table = dynamics.table();
  const int n = table.coordinates, states = table.states;
  const double* zero = dynamics.zero();
  const catena_point along{0.0, dq_.data(), dv_.data(), da_.data(), dz_.data(), zero, zero};
  for (int j = 0; j < n + states; ++j) {
    const auto i = static_cast<std::size_t>(j < n ? j : j - n);
    if (j < n) {
      dq_[i] = gamma * gamma;
      dv_[i] = gamma;
      da_[i] = 1.0;
    } else {
      dz_[i] = gamma;
    }
    double* column = matrix_.col(j).data();
    table.residual_tangent(&at, &along, column);
    if (states > 0) {
      // dv and dz carry one factor gamma already
      table.state_rate_tangent(&at, &along, column + n);
      for (int k = 0; k < states; ++k) column[n + k] = -column[n + k];
      if (j >= n) column[j] += 1.0;
    }
    if (j < n)
      dq_[i] = dv_[i] = da_[i] = 0.0;
    else
      dz_[i] = 0.0;
  }
  factors_.compute(matrix_);
  for (int j = 0; j < n + states; ++j) {
    const double pivot = factors_.matrixLU()(j, j);
    if (pivot == 0.0 || !std::isfinite(pivot)) return j + 1;
  }
  return 0;
}

void DenseNewtonMatrix::solve(double* x) const {
  Eigen::Map<Eigen::VectorXd> unknown(x, permuted_.size());
  permuted_.noalias() = factors_.permutationP() * unknown;
  factors_.matrixLU().triangularView<Eigen::UnitLower>().solveInPlace(permuted_);
  factors_.matrixLU().triangularView<Eigen::Upper>().solveInPlace(permuted_);
  unknown = permuted_;
}

void DenseNewtonMatrix::solve_transposed(double* x) const {
  Eigen::Map<Eigen::VectorXd> unknown(x, permuted_.size());
  permuted_ = unknown;
  factors_.matrixLU().transpose().triangularView<Eigen::Lower>().solveInPlace(permuted_);
  factors_.matrixLU().transpose().triangularView<Eigen::UnitUpper>().solveInPlace(permuted_);
  unknown.noalias() = factors_.permutationP().transpose() * permuted_;
}

std::unique_ptr<NewtonMatrix> make_newton_matrix(const Model& model, LinearSolver requested,
                                                 LinearSolver& used) {
  const bool possible = model.table().structured != 0 && model.states() == 0;
  if (requested == LinearSolver::kStructured && !possible)
    throw std::invalid_argument(
        "linear_solver = structured, but the Newton matrix of this model has no structure to "
        "exploit; choose automatic or dense");
  if (possible && requested != LinearSolver::kDense) {
    used = LinearSolver::kStructured;
    return std::make_unique<StructuredNewtonMatrix>(model);
  }
  used = LinearSolver::kDense;
  return std::make_unique<DenseNewtonMatrix>(model);
}

}  // namespace catena
