// SPDX-License-Identifier: BSD-3-Clause
//
// catena::identify: finds the stiffness of the joints of a falling cable from a recording. The
// recording is made here by the model itself, with a millimetre of noise.
#include <cstdio>
#include <random>

#include "identify/fit/error.hpp"
#include "identify/fit/fit.hpp"
#include "identify/problem/problem.hpp"

namespace {

/// Four links, seen at the middle and at the load 50 times a second for two seconds.
catena::Case four_links() {
  catena::Case the_case;
  the_case.links = 4;
  the_case.cable.length = 1.0;   // m
  the_case.cable.density = 0.1;  // kg/m
  the_case.cable.load_mass = 0.2;
  the_case.initial.shape = catena::Shape::kStraight;
  the_case.initial.coefficients = {0.6};  // rad

  catena::ParameterSpec stiffness;
  stiffness.name = "k";
  stiffness.sets = "stiffness_2..4";
  stiffness.unit = "N m/rad";
  stiffness.value = 0.2;
  stiffness.lower = 0.01;
  stiffness.upper = 10;
  stiffness.scale = catena::Scale::kLogarithmic;
  stiffness.free = true;
  catena::ParameterSpec damping = stiffness;
  damping.name = "c";
  damping.sets = "damping";
  damping.unit = "N m s/rad";
  damping.value = 0.002;
  damping.lower = 1e-5;
  damping.upper = 0.1;
  catena::ParameterSpec clamp;
  clamp.name = "k_1";
  clamp.sets = "stiffness_1";
  clamp.unit = "N m/rad";
  the_case.parameters = {stiffness, damping, clamp};

  catena::ExperimentSpec run;
  run.name = "run";
  the_case.experiments = {run};
  return the_case;
}

catena::Recording blank_recording() {
  catena::Recording recording;
  for (int frame = 0; frame <= 100; ++frame) recording.time.push_back(0.02 * frame);
  catena::PointSpec middle, load;
  middle.name = "middle";
  middle.joint = 2;
  load.name = "load";
  load.load = true;
  recording.points = {middle, load};
  for (int point = 0; point < 2; ++point) {
    recording.channels.push_back({point, catena::Component::kSide, "side"});
    recording.channels.push_back({point, catena::Component::kDown, "down"});
  }
  recording.fit_frames = static_cast<Eigen::Index>(recording.time.size());
  recording.measured.setZero(4, recording.fit_frames);
  return recording;
}

}  // namespace

int main() {
  const catena::Model model = catena::Model::built_in(4);
  catena::Recording recording = blank_recording();

  // The truth: k = 0.5 N m/rad, c = 0.004 N m s/rad, seen with noise.
  {
    const catena::Problem truth(four_links(), model, {recording});
    recording.measured = truth.predict(Eigen::Vector2d(0.5, 0.004), 0, true).simulated;
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0.0, 0.001);  // m
    for (double& value : recording.measured.reshaped()) value += noise(random);
  }

  const catena::Problem problem(four_links(), model, {recording});
  const catena::FitResult fit = catena::fit(problem, {}, nullptr);
  if (fit.status != catena::FitStatus::kConverged) {
    std::fprintf(stderr, "%s: %s\n", catena::name_of(fit.status), fit.message.c_str());
    return 1;
  }
  std::printf("error %.2f mm before, %.2f mm after\n", 1e3 * fit.start_error, 1e3 * fit.error);
  for (std::size_t i = 0; i < problem.unknowns().size(); ++i)
    std::printf("%s = %.4f %s\n", problem.unknowns()[i].name.c_str(),
                fit.x[static_cast<Eigen::Index>(i)], problem.unknowns()[i].unit.c_str());
}
