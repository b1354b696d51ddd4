// SPDX-License-Identifier: BSD-3-Clause
#include "linear_algebra/decompositions.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace catena {

using Eigen::MatrixXd;
using Eigen::VectorXd;

VectorXd solve_square(const MatrixXd& matrix, const VectorXd& right) {
  return matrix.partialPivLu().solve(right);
}

VectorXd solve_nearly_singular(const MatrixXd& matrix, const VectorXd& right) {
  return matrix.fullPivLu().solve(right);
}

MatrixXd solve_positive_definite(const MatrixXd& matrix, const MatrixXd& right) {
  return matrix.llt().solve(right);
}

struct SymmetricFactors::Factors {
  Eigen::LDLT<MatrixXd> of;
};

SymmetricFactors::SymmetricFactors(const MatrixXd& matrix)
    : factors_(std::make_unique<Factors>(Factors{Eigen::LDLT<MatrixXd>(matrix)})) {}

SymmetricFactors::~SymmetricFactors() = default;

VectorXd SymmetricFactors::solve(const VectorXd& right) const { return factors_->of.solve(right); }

double SymmetricFactors::reciprocal_condition() const { return factors_->of.rcond(); }

VectorXd solve_symmetric(const MatrixXd& matrix, const VectorXd& right) {
  return SymmetricFactors(matrix).solve(right);
}

MatrixXd inverse(const MatrixXd& matrix) { return matrix.inverse(); }

VectorXd least_squares(const MatrixXd& matrix, const VectorXd& right) {
  return matrix.colPivHouseholderQr().solve(right);
}

MatrixXd least_squares(const MatrixXd& matrix, const MatrixXd& right) {
  return matrix.colPivHouseholderQr().solve(right);
}

MatrixXd orthonormal_basis(const MatrixXd& matrix, double threshold) {
  Eigen::ColPivHouseholderQR<MatrixXd> qr(matrix);
  qr.setThreshold(threshold);
  return qr.householderQ() * MatrixXd::Identity(matrix.rows(), qr.rank());
}

MatrixXd triangle_of(const MatrixXd& matrix) {
  return Eigen::HouseholderQR<MatrixXd>(matrix)
      .matrixQR()
      .topRows(std::min(matrix.rows(), matrix.cols()))
      .triangularView<Eigen::Upper>();
}

SingularDirections singular_directions(const MatrixXd& matrix) {
  const Eigen::JacobiSVD<MatrixXd, Eigen::NoQRPreconditioner> svd(triangle_of(matrix),
                                                                  Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixV()};
}

EigenPairs symmetric_eigenpairs(const MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

VectorXd generalised_eigenvalues(const MatrixXd& stiffness, const MatrixXd& mass) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(stiffness, mass, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

std::vector<std::complex<double>> eigenvalues(const MatrixXd& matrix) {
  const auto values = Eigen::EigenSolver<MatrixXd>(matrix, false).eigenvalues().eval();
  return {values.begin(), values.end()};
}

}  // namespace catena
