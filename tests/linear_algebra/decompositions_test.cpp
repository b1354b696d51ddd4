// SPDX-License-Identifier: BSD-3-Clause
#include "linear_algebra/decompositions.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace catena;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

MatrixXd matrix(std::initializer_list<std::initializer_list<double>> rows) {
  MatrixXd result(rows.size(), rows.begin()->size());
  Eigen::Index i = 0;
  for (const auto& row : rows) {
    Eigen::Index j = 0;
    for (const double value : row) result(i, j++) = value;
    ++i;
  }
  return result;
}

VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const VectorXd>(values.begin(), static_cast<Eigen::Index>(values.size()));
}

double difference(const MatrixXd& a, const MatrixXd& b) {
  REQUIRE(a.rows() == b.rows());
  REQUIRE(a.cols() == b.cols());
  return (a - b).cwiseAbs().maxCoeff();
}

constexpr double kRounding = 1e-14;

}  // namespace

TEST_CASE("systems with as many rows as unknowns") {
  CHECK(difference(solve_square(matrix({{0, 2}, {1, 3}}), vector({4, 7})), vector({1, 2})) <
        kRounding);
  CHECK(difference(solve_nearly_singular(matrix({{1, 1}, {1, 1}}), vector({2, 2})).colwise().sum(),
                   matrix({{2}})) < kRounding);
  const MatrixXd positive = matrix({{4, 2}, {2, 3}});
  CHECK(difference(solve_positive_definite(positive, matrix({{8, 4}, {8, 2}})),
                   matrix({{1, 1}, {2, 0}})) < kRounding);
  CHECK(difference(solve_symmetric(matrix({{1, 2}, {2, 1}}), vector({5, 4})), vector({1, 2})) <
        kRounding);
  CHECK(difference(inverse(positive), matrix({{0.375, -0.25}, {-0.25, 0.5}})) < kRounding);
}

TEST_CASE("the condition of a symmetric matrix") {
  CHECK(SymmetricFactors(MatrixXd::Identity(3, 3)).reciprocal_condition() == 1);
  CHECK(SymmetricFactors(matrix({{1, 0}, {0, 1e-12}})).reciprocal_condition() ==
        doctest::Approx(1e-12).scale(0));
}

TEST_CASE("least squares") {
  // The line through (0, 1), (1, 3), (2, 4): intercept 7/6, slope 3/2.
  const MatrixXd powers = matrix({{1, 0}, {1, 1}, {1, 2}});
  const VectorXd places = vector({1, 3, 4});
  CHECK(difference(least_squares(powers, places), vector({7.0 / 6, 1.5})) < kRounding);
  MatrixXd both(3, 2);
  both << places, 2 * places;
  CHECK(difference(least_squares(powers, both), matrix({{7.0 / 6, 7.0 / 3}, {1.5, 3}})) <
        kRounding);
}

TEST_CASE("an orthonormal basis leaves out columns that depend on others") {
  const MatrixXd columns = matrix({{1, 1, 2}, {1, -1, 0}, {0, 0, 0}});
  const MatrixXd basis = orthonormal_basis(columns, 1e-10);
  REQUIRE(basis.cols() == 2);
  CHECK(difference(basis.transpose() * basis, MatrixXd::Identity(2, 2)) < kRounding);
  CHECK(difference(basis * (basis.transpose() * columns), columns) < kRounding);
}

TEST_CASE("singular values and directions") {
  const SingularDirections found = singular_directions(matrix({{0, 2}, {3, 0}, {0, 0}}));
  CHECK(difference(found.values, vector({3, 2})) < kRounding);
  CHECK(difference(found.vectors.cwiseAbs(), MatrixXd::Identity(2, 2)) < kRounding);
}

TEST_CASE("eigenvalues") {
  const double root = std::sqrt(0.5);
  const EigenPairs pairs = symmetric_eigenpairs(matrix({{2, 7}, {1, 2}}));  // 7 is not read
  CHECK(difference(pairs.values, vector({1, 3})) < kRounding);
  CHECK(difference(pairs.vectors.cwiseAbs(), matrix({{root, root}, {root, root}})) < kRounding);

  CHECK(difference(generalised_eigenvalues(matrix({{2, 0}, {0, 12}}), matrix({{2, 0}, {0, 3}})),
                   vector({1, 4})) < kRounding);

  std::vector<std::complex<double>> turning = eigenvalues(matrix({{0, -2}, {2, 0}}));
  std::sort(turning.begin(), turning.end(),
            [](const auto& a, const auto& b) { return a.imag() < b.imag(); });
  REQUIRE(turning.size() == 2);
  CHECK(std::abs(turning[0] - std::complex<double>(0, -2)) < kRounding);
  CHECK(std::abs(turning[1] - std::complex<double>(0, 2)) < kRounding);
}
