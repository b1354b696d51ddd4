// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/marker_places.hpp"

#include <doctest/doctest.h>

#include "tests/identify/problem/prediction_difference.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/failure.hpp"

using namespace catena;

namespace {

/// Two links whose markers are known to some millimetres.
Case with_doubted_marks(const std::vector<std::pair<std::string, double>>& off) {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  for (const auto& [marker, farther] : off) {
    ParameterSpec place;
    place.name = "place of " + marker;
    place.sets = marker_place_of(marker);
    place.unit = "m";
    place.value = farther;
    place.lower = -0.1;
    place.upper = 0.1;
    place.free = true;
    place.where = "case.toml:40";
    the_case.parameters.push_back(place);
  }
  return the_case;
}

Problem seen_at(const std::vector<double>& places, const Case& the_case) {
  return Problem(the_case, Model::built_in(2),
                 std::vector<Recording>{testing::empty_markers(places, 30, 0.05)});
}

Eigen::MatrixXd prediction(const Problem& problem) {
  return problem.predict(problem.start(), 0, true).simulated;
}

}  // namespace

TEST_CASE("a marker that sits farther is seen there, on another link if need be") {
  const Problem moved =
      seen_at({0.25, 0.49}, with_doubted_marks({{"marker 1", -0.05}, {"marker 2", 0.03}}));
  const Problem there = seen_at({0.20, 0.52}, with_doubted_marks({}));
  CHECK((prediction(moved) - prediction(there)).norm() < 1e-12);
  CHECK((prediction(moved) - prediction(seen_at({0.25, 0.49}, with_doubted_marks({})))).norm() >
        0.1);
}

TEST_CASE("beyond the ends of the cable the last links are drawn out") {
  const Problem problem =
      seen_at({0.01, 1.0}, with_doubted_marks({{"marker 1", -0.02}, {"marker 2", 0.02}}));
  const Eigen::MatrixXd seen = prediction(problem);
  const Eigen::MatrixXd inside = prediction(seen_at({0.01, 0.98}, with_doubted_marks({})));
  const Eigen::MatrixXd end = prediction(seen_at({0.01, 1.0}, with_doubted_marks({})));
  CHECK((seen.topRows(2) + end.topRows(2)).norm() < 1e-12);
  CHECK((seen.bottomRows(2) - (2 * end - inside).bottomRows(2)).norm() < 1e-12);
}

TEST_CASE("derivatives by places are those of differences, beside those of what moves the cable") {
  const Problem problem =
      seen_at({0.25, 0.7, 1.0}, with_doubted_marks({{"marker 2", 0.01}, {"marker 3", 0.004}}));
  const Eigen::VectorXd x = problem.start();
  const Prediction at = problem.predict(x, 0, true, problem.directions(x, 0));
  REQUIRE(at.ok());
  REQUIRE(x.size() == 4);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    CAPTURE(problem.unknowns()[static_cast<std::size_t>(j)].name);
    const Eigen::MatrixXd by_differences = testing::difference_along(problem, x, j);
    CHECK((at.sensitivity[static_cast<std::size_t>(j)] - by_differences).norm() <
          1e-3 * by_differences.norm());
  }
}

TEST_CASE("markers spread over the cable stay so where its length is unknown") {
  Case the_case = with_doubted_marks({});
  ParameterSpec length;
  length.name = length.sets = "cable.length";
  length.value = 1.1;  // m; the case says 1
  length.lower = 0.5;
  length.upper = 2;
  length.free = true;
  the_case.parameters.push_back(length);
  Recording recording = testing::empty_markers({0.5, 0.75, 1.0}, 30, 0.05);
  for (PointSpec& point : recording.points) point.share = point.arc_length;
  const Problem spread(the_case, Model::built_in(2), std::vector<Recording>{recording});
  const Problem there = seen_at({0.55, 0.825, 1.1}, the_case);
  CHECK((prediction(spread) - prediction(there)).norm() < 1e-12);
  const Eigen::VectorXd x = spread.start();
  const Eigen::MatrixXd by_differences = testing::difference_along(spread, x, x.size() - 1);
  CHECK((spread.predict(x, 0, true, spread.directions(x, 0)).sensitivity.back() - by_differences)
            .norm() < 1e-3 * by_differences.norm());
}

TEST_CASE("a place of a marker that no recording has is refused") {
  const testing::TemporaryFolder folder;
  const Recording film = testing::with_truth(with_doubted_marks({}), Model::built_in(2),
                                             testing::empty_markers({0.5, 1.0}, 30, 0.05));
  const Case the_case = testing::measured(with_doubted_marks({{"marker 3", 0}}), folder, film);
  const std::string said = failure([&] { Problem(the_case, Model::built_in(2)); });
  CAPTURE(said);
  CHECK(said.find(
            "case.toml:40: parameter \"place of marker 3\": sets = \"marker_places.marker 3\": no "
            "experiment has a marker of this name at an arc length") == 0);
}
