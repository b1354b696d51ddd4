// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/newton_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace catena {

void NewtonMatrix::solve_batch(double* x) const {
  for (std::size_t k = 0; k < CATENA_DIRECTIONS; ++k) {
    for (std::size_t i = 0; i < column_.size(); ++i) column_[i] = x[CATENA_DIRECTIONS * i + k];
    solve(column_.data());
    for (std::size_t i = 0; i < column_.size(); ++i) x[CATENA_DIRECTIONS * i + k] = column_[i];
  }
}

StructuredNewtonMatrix::StructuredNewtonMatrix(const Model& model)
    : NewtonMatrix(model),
      model_(model),
      n_(static_cast<std::size_t>(model.coordinates())),
      states_(static_cast<std::size_t>(model.states())),
      work_(static_cast<std::size_t>(model.table().newton_work)) {
  if (states_ == 0) return;
  const auto parameters = static_cast<std::size_t>(model.parameters());
  u_.resize(3 * static_cast<std::size_t>(model.signals()));
  for (auto* values : {&q_, &v_, &a_, &dq_, &dv_, &dr_}) values->resize(n_);
  for (auto* values : {&z_, &diagonal_, &dz_, &rate_}) values->resize(states_);
  dp_.resize(parameters);
  none_.resize(std::max({n_, states_, parameters, u_.size()}));
}

int StructuredNewtonMatrix::factor(Dynamics&, const catena_point& at, double gamma) {
  gamma_ = gamma;
  if (states_ > 0) keep(at);
  return model_.newton_factor(at, 1.0, gamma, gamma * gamma, work_.data());
}

/// Copies the point and finds D: each rate depends on its own state alone, so that one product with
/// ones has them all.
void StructuredNewtonMatrix::keep(const catena_point& at) {
  std::copy_n(at.q, n_, q_.begin());
  std::copy_n(at.v, n_, v_.begin());
  std::copy_n(at.a, n_, a_.begin());
  std::copy_n(at.z, states_, z_.begin());
  std::copy_n(at.u, u_.size(), u_.begin());
  at_ = {at.t, q_.data(), v_.data(), a_.data(), z_.data(), u_.data(), at.p};
  std::fill(dz_.begin(), dz_.end(), gamma_);
  const catena_point along = direction(none_, none_, dz_);
  model_.state_rate_tangent(at_, along, rate_.data());
  for (std::size_t k = 0; k < states_; ++k) diagonal_[k] = 1.0 - rate_[k];
}

catena_point StructuredNewtonMatrix::direction(const std::vector<double>& q,
                                               const std::vector<double>& v,
                                               const std::vector<double>& z) const {
  return {0.0, q.data(), v.data(), none_.data(), z.data(), none_.data(), none_.data()};
}

void StructuredNewtonMatrix::solve(double* x) const {
  if (states_ > 0) {
    for (std::size_t k = 0; k < states_; ++k) {
      x[n_ + k] /= diagonal_[k];
      dz_[k] = gamma_ * x[n_ + k];
    }
    const catena_point along = direction(none_, none_, dz_);
    model_.residual_tangent(at_, along, dr_.data());
    for (std::size_t i = 0; i < n_; ++i) x[i] -= dr_[i];
  }
  model_.newton_solve(work_.data(), x);
  if (states_ > 0) {
    for (std::size_t i = 0; i < n_; ++i) {
      dv_[i] = gamma_ * x[i];
      dq_[i] = gamma_ * dv_[i];
    }
    const catena_point along = direction(dq_, dv_, none_);
    model_.state_rate_tangent(at_, along, rate_.data());
    for (std::size_t k = 0; k < states_; ++k) x[n_ + k] += rate_[k] / diagonal_[k];
  }
}

void StructuredNewtonMatrix::solve_batch(double* x) const {
  if (states_ == 0 && model_.table().newton_solves != nullptr)
    model_.newton_solves(work_.data(), x);
  else
    NewtonMatrix::solve_batch(x);
}

void StructuredNewtonMatrix::solve_transposed(double* x) const {
  if (states_ > 0) {
    for (std::size_t k = 0; k < states_; ++k) {
      x[n_ + k] /= diagonal_[k];
      rate_[k] = gamma_ * x[n_ + k];
    }
    model_.residual_adjoint(at_, none_.data(), rate_.data(), dq_.data(), dv_.data(), dz_.data(),
                            dp_.data());
    for (std::size_t i = 0; i < n_; ++i) x[i] += dv_[i] + gamma_ * dq_[i];
  }
  model_.newton_solve_transposed(work_.data(), x);
  if (states_ > 0) {
    model_.residual_adjoint(at_, x, none_.data(), dq_.data(), dv_.data(), dz_.data(), dp_.data());
    for (std::size_t k = 0; k < states_; ++k) x[n_ + k] -= gamma_ * dz_[k] / diagonal_[k];
  }
}

DenseNewtonMatrix::DenseNewtonMatrix(const Model& model) : NewtonMatrix(model), tangents_(model) {
  const int n = model.coordinates(), size = n + model.states();
  matrix_.resize(size, size);
  factors_ = Eigen::PartialPivLU<Eigen::MatrixXd>(size);
  permuted_.resize(size);
  for (std::vector<DirectionBatch>* values : {&dq_, &dv_, &da_, &dr_})
    values->resize(static_cast<std::size_t>(n));
  for (std::vector<DirectionBatch>* values : {&dz_, &rate_})
    values->resize(static_cast<std::size_t>(model.states()));
  none_.resize(
      static_cast<std::size_t>(std::max(3 * model.table().signals, model.table().parameters)));
}

int DenseNewtonMatrix::factor(Dynamics&, const catena_point& at, double gamma) {
  const auto n = static_cast<int>(dq_.size()), states = static_cast<int>(dz_.size());
  const int size = n + states;
  const catena_point along{0.0,          numbers(dq_),   numbers(dv_),  numbers(da_),
                           numbers(dz_), numbers(none_), numbers(none_)};
  for (int first = 0; first < size; first += CATENA_DIRECTIONS) {
    const int last = std::min(first + CATENA_DIRECTIONS, size);
    point_along(first, last, gamma, gamma * gamma, 1.0);
    tangents_.residual(at, along, numbers(dr_));
    // dv and dz carry one factor gamma already
    if (states > 0) tangents_.state_rate(at, along, numbers(rate_));
    for (int j = first; j < last; ++j) {
      const auto k = static_cast<std::size_t>(j - first);
      for (int i = 0; i < n; ++i) matrix_(i, j) = dr_[static_cast<std::size_t>(i)].of[k];
      for (int i = 0; i < states; ++i)
        matrix_(n + i, j) = -rate_[static_cast<std::size_t>(i)].of[k];
      if (j >= n) matrix_(j, j) += 1.0;
    }
    point_along(first, last, 0.0, 0.0, 0.0);
  }
  factors_.compute(matrix_);
  for (int j = 0; j < size; ++j) {
    const double pivot = factors_.matrixLU()(j, j);
    if (pivot == 0.0 || !std::isfinite(pivot)) return j + 1;
  }
  return 0;
}

/// The unknowns from `first` to before `last` as one direction each.
void DenseNewtonMatrix::point_along(int first, int last, double dv, double dq, double da) {
  const auto n = static_cast<int>(dq_.size());
  for (int j = first; j < last; ++j) {
    const auto i = static_cast<std::size_t>(j < n ? j : j - n);
    const auto k = static_cast<std::size_t>(j - first);
    if (j < n) {
      dq_[i].of[k] = dq;
      dv_[i].of[k] = dv;
      da_[i].of[k] = da;
    } else {
      dz_[i].of[k] = dv;
    }
  }
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
  const bool possible = model.table().structured != 0;
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
