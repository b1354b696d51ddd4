// SPDX-License-Identifier: BSD-3-Clause
//
// Dense linear algebra: Eigen's decompositions, compiled once. Each source that includes Eigen/Dense
// compiles them anew, which takes ten seconds and more. Sizes must fit, as Eigen asks; nothing here
// throws, and what cannot be solved gives values that are not finite.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <memory>
#include <vector>

namespace catena {

/// x of A x = b, A n x n, by LU with exchanged rows.
Eigen::VectorXd solve_square(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// The same with exchanged rows and columns, for matrices that are close to singular.
Eigen::VectorXd solve_nearly_singular(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// X of A X = B, A n x n symmetric and positive definite, B n x m, by Cholesky's decomposition.
Eigen::MatrixXd solve_positive_definite(const Eigen::MatrixXd& matrix,
                                        const Eigen::MatrixXd& right);

/// A = P' L D L' P of an n x n symmetric, semidefinite matrix.
///
///     const Eigen::MatrixXd normal{{4, 2}, {2, 3}};
///     const Eigen::VectorXd right{{8, 8}};
///     const SymmetricFactors factors(normal);
///     const Eigen::VectorXd step = factors.solve(right);
class SymmetricFactors {
 public:
  /// Reads the lower triangle.
  explicit SymmetricFactors(const Eigen::MatrixXd& matrix);
  ~SymmetricFactors();

  /// x of A x = b.
  [[nodiscard]] Eigen::VectorXd solve(const Eigen::VectorXd& right) const;

  /// An estimate of 1 / (|A| |A^-1|), of the norm of largest column sums.
  [[nodiscard]] double reciprocal_condition() const;

 private:
  struct Factors;
  std::unique_ptr<const Factors> factors_;
};

/// x of A x = b by SymmetricFactors.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);

/// A^-1 of an n x n matrix.
Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);

/// x of least |A x - b|, A m x n, by QR with exchanged columns.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);
/// The same for each column of B.
Eigen::MatrixXd least_squares(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

/// Orthonormal columns that span those of the matrix, by QR with exchanged columns. Columns whose
/// share beyond the others is less than `threshold` of the largest give none.
Eigen::MatrixXd orthonormal_basis(const Eigen::MatrixXd& matrix, double threshold);

/// R of A = QR, min(m, n) x n and zero below its diagonal: R'R = A'A, without the squares.
Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& matrix);

/// Singular values, descending, and the right singular vectors that belong to them, in columns.
struct SingularDirections {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Of a matrix with at least as many rows as columns, by way of the triangle R of J = QR, which has
/// the same ones and is small. Eigen's BDCSVD of J itself is slow to compile.
SingularDirections singular_directions(const Eigen::MatrixXd& matrix);

/// Eigenvalues, ascending, and orthonormal eigenvectors, in columns.
struct EigenPairs {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// Of a symmetric matrix; only its lower triangle is read.
EigenPairs symmetric_eigenpairs(const Eigen::MatrixXd& matrix);

/// The values w, ascending, of K x = w M x, K symmetric, M symmetric and positive definite.
Eigen::VectorXd generalised_eigenvalues(const Eigen::MatrixXd& stiffness,
                                        const Eigen::MatrixXd& mass);

/// Of a square matrix, in no order.
std::vector<std::complex<double>> eigenvalues(const Eigen::MatrixXd& matrix);

}  // namespace catena
