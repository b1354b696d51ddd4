// SPDX-License-Identifier: BSD-3-Clause
//
// Windows that are held out: how one begins is measured, not predicted.
#include <doctest/doctest.h>

#include "identify/diagnosis/fitted_model.hpp"
#include "identify/diagnosis/remainder.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace held_out_starts_test {
namespace {

const char* const kAnyStart = R"(
[initial]
shape = "angles"
free = true
velocity = {shape = "angles", free = true}
[optimiser]
method = "least_squares"
)";
constexpr double kNoise = 2e-3;  // rad
constexpr int kFrames = 400, kFitted = 250;

Case two_links() {
  const std::string cable = testing::kTwoLinks;
  Case the_case = testing::sections(cable.substr(0, cable.find("[initial]")) + kAnyStart);
  testing::add_experiment(the_case, "run", DataKind::kAngles);
  return the_case;
}

/// Both angles at 100 Hz, with noise; the last 1.5 s held out.
Recording film() {
  Case truth = two_links();
  truth.parameters[0].value = 0.1;
  truth.parameters[1].value = 0.005;
  truth.initial.coefficients = {0.6, 0.7};
  truth.initial.velocity_coefficients = {0.0, 0.0};
  Recording recording;
  for (int k = 0; k < kFrames; ++k) recording.time.push_back(0.01 * k);
  for (int link = 1; link <= 2; ++link) {
    PointSpec point;
    point.name = "link " + std::to_string(link);
    point.link = link;
    recording.points.push_back(point);
    recording.channels.push_back({link - 1, Component::kAngle, point.name});
  }
  recording.measured.setZero(2, kFrames);
  recording.fit_frames = kFitted;
  return testing::with_truth(truth, Model::built_in(2), recording, kNoise, 5);
}

}  // namespace

TEST_CASE(
    "windows held out are left with the noise by the right model, and with more by a wrong one") {
  Case the_case = two_links();
  the_case.experiments[0].window = 0.5;
  const auto problem =
      std::make_shared<const Problem>(the_case, Model::built_in(2), std::vector<Recording>{film()});
  const FittedModel found = fit_model(problem, problem->start(), {}, fit_least_squares, nullptr);
  REQUIRE(found.ok);
  const std::vector<NoiseModel> noise(problem->experiments().size(), {.level = kNoise});
  const GapTest held_out = held_out_gap(found, noise);
  CHECK(held_out.count == 2 * (kFrames - kFitted));
  CHECK(held_out.ratio() == catena::near(1, 0.1));

  Eigen::VectorXd wrong = found.x;
  wrong[0] *= 3;
  const FittedModel other = assess(problem, wrong, fit_least_squares, nullptr);
  REQUIRE(other.ok);
  CHECK(held_out_gap(other, noise).ratio() > 2);

  // Of windows that are held out only some unknowns have derivatives.
  CHECK_FALSE(tested_held_out_gap(found, noise).present);
  CHECK(tested_held_out_gap(other, noise).present);
}

}  // namespace held_out_starts_test
