// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <memory>
#include <vector>

#include "runtime/direction_batch.hpp"
#include "runtime/dynamics.hpp"
#include "runtime/simulation.hpp"

namespace catena {

/// The matrix of the equations of one implicit step. A multistep method sets, with gamma > 0 and
/// constants q*, v*, z* from earlier steps,
///     q = q* + gamma v,   v = v* + gamma a,   z = z* + gamma zdot,
/// so the residuals gamma r(t, q, v, a, z) and z - z* - gamma zdot depend on v and z alone:
///     | M + gamma dr/dv + gamma^2 dr/dq              gamma dr/dz      |
///     | -gamma (dzdot/dv + gamma dzdot/dq)       1 - gamma dzdot/dz   |
/// Coordinates are eliminated exactly. The system has one row per coordinate and extra state.
class NewtonMatrix {
 public:
  /// Of a model with as many coordinates and states.
  explicit NewtonMatrix(const Model& model)
      : column_(static_cast<std::size_t>(model.coordinates() + model.states())) {}
  virtual ~NewtonMatrix() = default;
  /// Factors the matrix at a point. Returns 0, or the 1-based index of the unknown without a pivot.
  virtual int factor(Dynamics& dynamics, const catena_point& at, double gamma) = 0;
  /// Overwrites the right-hand side (coordinates, then states) with the solution.
  virtual void solve(double* x) const = 0;
  /// The same for CATENA_DIRECTIONS right-hand sides: that many numbers for each entry, with the
  /// alignment of DirectionBatch.
  virtual void solve_batch(double* x) const;
  /// The same with the transpose of the matrix.
  virtual void solve_transposed(double* x) const = 0;

 private:
  mutable std::vector<double> column_;  // one right-hand side of a batch
};

/// By the emitted factorisation, O(links). Extra states are eliminated: D = 1 - gamma dzdot/dz is
/// diagonal, C is the rest of their rows, and the emitted N is the matrix that is left for v. Two
/// products with tangents of the model, O(links) too, eliminate the states and compute them again.
class StructuredNewtonMatrix : public NewtonMatrix {
 public:
  /// `model` must be structured.
  explicit StructuredNewtonMatrix(const Model& model);
  int factor(Dynamics& dynamics, const catena_point& at, double gamma) override;
  void solve(double* x) const override;
  void solve_batch(double* x) const override;
  void solve_transposed(double* x) const override;

 private:
  void keep(const catena_point& at);
  catena_point direction(const std::vector<double>& q, const std::vector<double>& v,
                         const std::vector<double>& z) const;

  Model model_;
  const std::size_t n_, states_;
  std::vector<double> work_;
  // for extra states: the point of the factors, D there, and what the products need
  double gamma_ = 0.0;
  catena_point at_{};
  std::vector<double> q_, v_, a_, z_, u_, diagonal_, none_;
  mutable std::vector<double> dq_, dv_, dz_, dp_, dr_, rate_;
};

/// By LU with row exchanges; columns from the model's tangents, CATENA_DIRECTIONS at once.
class DenseNewtonMatrix : public NewtonMatrix {
 public:
  explicit DenseNewtonMatrix(const Model& model);
  int factor(Dynamics& dynamics, const catena_point& at, double gamma) override;
  void solve(double* x) const override;
  void solve_transposed(double* x) const override;

 private:
  void point_along(int first, int last, double dv, double dq, double da);

  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factors_;
  BatchTangents tangents_;
  std::vector<DirectionBatch> dq_, dv_, da_, dz_, dr_, rate_, none_;  // none_: zeros
  mutable Eigen::VectorXd permuted_;
};

/// The solver that `requested` names; writes its kind to `used`. Throws std::invalid_argument if
/// the structured one is requested for a model without structure.
std::unique_ptr<NewtonMatrix> make_newton_matrix(const Model& model, LinearSolver requested,
                                                 LinearSolver& used);

}  // namespace catena
