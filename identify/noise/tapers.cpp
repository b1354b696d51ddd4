// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/tapers.hpp"

#include <cmath>
#include <numbers>

#include "linear_algebra/decompositions.hpp"

namespace catena {

namespace {

constexpr double kTaperReach = 3;  // frequencies
constexpr int kTapers = 3;         // of six that would fit: the others leak

}  // namespace

Eigen::MatrixXd slepian_tapers(int length) {
  // They are eigenvectors of a tridiagonal matrix, too, whose eigenvalues are far apart.
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(length, length);
  for (int k = 0; k < length; ++k) {
    matrix(k, k) =
        std::pow((length - 1) / 2.0 - k, 2) * std::cos(2 * std::numbers::pi * kTaperReach / length);
    if (k > 0) matrix(k, k - 1) = k * (length - k) / 2.0;
  }
  return symmetric_eigenpairs(matrix).vectors.rightCols(kTapers);
}

}  // namespace catena
