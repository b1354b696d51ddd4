// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/initial_state.hpp"

#include <doctest/doctest.h>

#include "common/input_error.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace {

/// Markers of a chain with angles a + b t.
Recording moving(const std::vector<double>& arcs, const Eigen::VectorXd& lengths,
                 const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Recording recording = testing::empty_markers(arcs, 8, 0.01);
  for (Eigen::Index k = 0; k < 8; ++k)
    for (std::size_t p = 0; p < arcs.size(); ++p) {
      double side = 0, down = 0, before = 0;
      for (Eigen::Index i = 0; i < lengths.size(); before += lengths[i++]) {
        const double part = std::clamp(arcs[p] - before, 0.0, lengths[i]);
        const double angle = a[i] + b[i] * 0.01 * static_cast<double>(k);
        side += part * std::sin(angle);
        down += part * std::cos(angle);
      }
      recording.measured(static_cast<Eigen::Index>(2 * p), k) = side;
      recording.measured(static_cast<Eigen::Index>(2 * p + 1), k) = down;
    }
  return recording;
}

}  // namespace

TEST_CASE("a start is found from the first frames") {
  const Eigen::VectorXd lengths = Eigen::VectorXd::Constant(6, 0.25);
  const Eigen::MatrixXd basis = shape_basis(Shape::kSmooth, 6, 3, lengths);
  const Eigen::Vector3d shape(0.8, 0.3, -0.2), rate(0.5, -0.4, 0.1);
  const Eigen::VectorXd a = basis * shape, b = basis * rate;
  struct Row {
    std::vector<double> arcs;
    double tolerance;  // few markers leave more to the assumption of little bending
  };
  const Row rows[] = {{{0.25, 0.5, 0.75, 1.0, 1.25, 1.5}, 0.01}, {{0.5, 1.0, 1.5}, 0.05}};
  for (const Row& row : rows) {
    InitialSpec initial;
    initial.shape = Shape::kSmooth;
    initial.terms = 3;
    initial.at_rest = false;
    initial.velocity_shape = Shape::kSmooth;
    initial.velocity_terms = 3;
    complete_from_data(initial, moving(row.arcs, lengths, a, b), lengths);
    CHECK((initial_angles(initial, lengths) - a).cwiseAbs().maxCoeff() < row.tolerance);
    CHECK((initial_rates(initial, lengths) - b).cwiseAbs().maxCoeff() < 5 * row.tolerance);
  }
}

TEST_CASE("what is given stays; beyond a right angle too; nothing seen is an error") {
  const Eigen::VectorXd lengths = Eigen::VectorXd::Constant(2, 0.5);
  const Eigen::Vector2d a(2.8, 3.0), b(0.3, 0.1);
  InitialSpec initial;
  initial.shape = Shape::kAngles;
  Recording recording = moving({0.5, 1.0}, lengths, a, Eigen::Vector2d::Zero());
  complete_from_data(initial, recording, lengths);
  CHECK(initial.coefficients[0] == catena::near(2.8, 1e-3));
  CHECK(initial.coefficients[1] == catena::near(3.0, 1e-3));

  initial.coefficients = {2.8, 3.0};
  initial.at_rest = false;
  initial.velocity_shape = Shape::kAngles;
  complete_from_data(initial, moving({0.5, 1.0}, lengths, a, b), lengths);
  CHECK(initial.coefficients == std::vector<double>{2.8, 3.0});
  CHECK(initial.velocity_coefficients[0] == catena::near(0.3, 1e-2));

  initial = {};
  initial.shape = Shape::kSmooth;
  recording.measured.setConstant(NAN);
  CHECK_THROWS_AS(complete_from_data(initial, recording, lengths), InputError);
}
