// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/cosine_spectrum.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/near.hpp"

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Mean of the products of one channel with another, `lag` frames later, over many draws.
double covariance(const std::vector<MatrixXd>& draws, Index a, Index b, Index lag) {
  double sum = 0, count = 0;
  for (const MatrixXd& x : draws)
    for (Index k = 0; k + lag < x.cols(); ++k) sum += x(a, k) * x(b, k + lag), count += 1;
  return sum / count;
}

TEST_CASE("draws have the correlations of the series, in time and between channels") {
  std::mt19937_64 random(3);
  // Two channels share a smooth process; the second has white noise of its own beside it.
  MatrixXd series(2, 397);
  double shared = 0;
  for (Index k = 0; k < series.cols(); ++k) {
    shared = 0.8 * shared + 0.6 * catena::normal_number(random);
    series(0, k) = shared;
    series(1, k) = shared + catena::normal_number(random);
  }
  const MatrixXd spectrum = catena::cosine_spectrum(series);
  CHECK(spectrum.squaredNorm() == catena::near(series.squaredNorm(), 1e-12));
  std::vector<MatrixXd> draws(400);
  for (MatrixXd& draw : draws) draw = catena::random_series(spectrum, series.cols(), random);
  REQUIRE(draws[0].rows() == 2);
  REQUIRE(draws[0].cols() == 397);
  // 400 draws of some 50 independent values each: 1 % of the variance of 1, and 3 % for the power that
  // goes into the few frames by which a fast transform is longer.
  for (const Index lag : {0, 1, 2, 5})
    for (const Index b : {0, 1}) {
      CAPTURE(lag);
      CAPTURE(b);
      const double asked = covariance({series}, 0, b, lag);
      CHECK(std::abs(covariance(draws, 0, b, lag) - asked) < 0.05 * (1 + asked));
    }
  // And the sums of their products with another series scatter as they are said to.
  const MatrixXd other = MatrixXd::NullaryExpr(
      2, 397, [](Index c, Index k) { return std::sin(0.3 * static_cast<double>(k + 20 * c)); });
  double squares = 0;
  for (const MatrixXd& draw : draws) squares += std::pow((draw.array() * other.array()).sum(), 2);
  CHECK(squares / 400 ==
        catena::near(catena::variance_along(spectrum, catena::cosine_spectrum(other)),
                     0.25));  // of 400 squares: 7 %, three times that and what was cut off
  // Nothing else of the series is in them.
  double same = 0;
  for (const MatrixXd& draw : draws) same += (draw.array() * series.array()).mean();
  CHECK(std::abs(same / 400) < 0.05);
}

}  // namespace
