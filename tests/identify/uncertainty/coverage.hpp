// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>

#include "identify/least_squares/least_squares.hpp"
#include "identify/uncertainty/uncertainty.hpp"
#include "tests/identify/recordings.hpp"

namespace catena::testing {

/// The cable whose recordings tell whether intervals hold what they promise: three unknowns, all of
/// them identifiable, and recordings made by the model itself.
inline const char* const kCable = R"(
[model]
links = 2
[cable]
length = 1.0
density = 0.3
load_mass = 0.2
[[parameter]]
name = "k"
sets = "stiffness"
value = 0.1
free = true
lower = 0.001
upper = 10.0
[[parameter]]
name = "c"
sets = "damping"
value = 0.005
free = true
lower = 0.0001
upper = 1.0
[initial]
shape = "straight"
angle = 0.6
free = true
[optimiser]
method = "least_squares"
[simulation]
relative_tolerance = 1e-7
)";

/// Perfect data of the cable, 60 frames of three markers.
inline Problem perfect(const std::string& text = kCable) {
  Case the_case = sections(text);
  add_experiment(the_case, "run");
  const Model model = Model::built_in(2);
  return Problem(the_case, model,
                 {with_truth(the_case, model, empty_markers({0.3, 0.7, 1.0}, 60, 0.05))});
}

/// Noise of 2 mm on every channel: each frame `autocorrelation` times the one before plus something new.
inline Problem noisy(const Problem& problem, double autocorrelation, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(0, 2e-3);
  Recording recording = problem.experiments()[0].recording;
  Eigen::MatrixXd& measured = recording.measured;
  for (Eigen::Index c = 0; c < measured.rows(); ++c) {
    double noise = normal(generator);
    for (Eigen::Index k = 0; k < measured.cols(); ++k) {
      if (k)
        noise = autocorrelation * noise +
                std::sqrt(1 - autocorrelation * autocorrelation) * normal(generator);
      measured(c, k) += noise;
    }
  }
  return Problem(problem.the_case(), problem.model(), {recording});
}

/// Whether the 95 % interval of each unknown holds the truth, and how wide it is.
struct Covered {
  Eigen::RowVectorXi inside;
  Eigen::RowVectorXd width;
};

/// The same for one recording of perfect() with noise.
inline Covered covered(const Problem& problem, double autocorrelation, unsigned seed) {
  const Eigen::VectorXd truth = problem.start();
  const Problem seen = noisy(problem, autocorrelation, seed);
  FitOptions options;
  options.start = truth;
  const Uncertainty uncertainty = uncertainty_of(seen, fit_least_squares(seen, options).x);
  Covered covered{Eigen::RowVectorXi(truth.size()), Eigen::RowVectorXd(truth.size())};
  for (Eigen::Index j = 0; j < truth.size(); ++j) {
    const Estimate& estimate = uncertainty.estimates[static_cast<std::size_t>(j)];
    covered.inside[j] = estimate.lower <= truth[j] && truth[j] <= estimate.upper;
    covered.width[j] = estimate.upper - estimate.lower;
  }
  return covered;
}

}  // namespace catena::testing
