// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/residuals.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace catena::report {
namespace {

TEST_CASE("residuals: measured minus predicted in mm, gaps kept") {
  Experiment experiment;
  experiment.measured = Measured{"markers",
                                 {{"a", 1.0}},
                                 {{0, 1}, {{1.003, kAbsent}}, {{2.0, 2.0}}, {}},
                                 {{0, 1}, {{1.0, 1.0}}, {{2.004, 2.0}}, {}}};
  const Residuals residuals = residuals_of(experiment);
  CHECK(residuals.unit == "mm");
  CHECK(residuals.side[0][0] == doctest::Approx(3));
  CHECK(residuals.down[0][0] == doctest::Approx(-4));
  CHECK(residuals.size[0][0] == doctest::Approx(5));
  CHECK(std::isnan(residuals.size[0][1]));
  CHECK(mean_over_points({{1, kAbsent}, {3, kAbsent}}, 2)[0] == 2);
  CHECK(std::isnan(mean_over_points({{1, kAbsent}, {3, kAbsent}}, 2)[1]));
  CHECK(root_mean_square({3, kAbsent, 4}) == doctest::Approx(std::sqrt(12.5)));
}

TEST_CASE("radial residuals are differences of the distance from the support") {
  Experiment experiment;
  experiment.measured = Measured{};
  experiment.measured->points = {{"load", 1}};
  experiment.measured->values = {{0, 1}, {{3, 0.6}}, {{4, 0.8}}, {}};
  experiment.measured->predicted = {{0, 1}, {{0, 0.6}}, {{4.9, 0.8}}, {}};
  const Residuals residuals = residuals_of(experiment);
  REQUIRE(residuals.radial.size() == 1);
  CHECK(residuals.radial[0][0] == doctest::Approx(100));  // mm
  CHECK(residuals.radial[0][1] == 0);
  CHECK(mean_absolute(residuals.radial[0]) == doctest::Approx(50));
  CHECK(residuals.size[0][0] == doctest::Approx(1e3 * std::hypot(3, 0.9)));
}

}  // namespace
}  // namespace catena::report
