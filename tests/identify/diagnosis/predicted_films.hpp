// SPDX-License-Identifier: BSD-3-Clause
//
// Films that a right model predicts, and what it had to expect of its predictions.
#pragma once

#include <cmath>
#include <memory>
#include <random>

#include "identify/diagnosis/prediction_errors.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/noise/cosine_spectrum.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/temporary_folder.hpp"

namespace catena::testing {

constexpr double kFrameTime = 0.05;   // s
constexpr double kFilmNoise = 1e-3;   // m
constexpr Eigen::Index kSealed = 20;  // frames

/// A film of two links, one marker at the tip: a fitted part, one held out, 20 sealed frames.
struct Film {
  int fitted = 60, frames = 160;
  double correlation = 0;  ///< of the noise of a frame with the one before
  double shift = 0;        ///< m: of the sealed part, to the side
};

inline FittedModel fitted_to(const Film& film, unsigned seed) {
  Case the_case = sections(kTwoLinks);
  add_experiment(the_case, "run");
  const Model model = Model::built_in(2);
  Recording recording = with_truth(the_case, model, empty_markers({1.0}, film.frames, kFrameTime));

  std::mt19937_64 random(seed);
  Eigen::Vector2d noise = Eigen::Vector2d::Zero();
  for (Eigen::Index k = 0; k < film.frames; ++k) {
    const double fresh = k == 0 ? 1 : std::sqrt(1 - film.correlation * film.correlation);
    for (double& value : noise) value = film.correlation * value + fresh * normal_number(random);
    recording.measured.col(k) += kFilmNoise * noise;
  }
  recording.fit_frames = film.fitted;
  if (film.fitted < film.frames) {
    recording.measured.row(0).tail(kSealed).array() += film.shift;
    recording.sealed = Eigen::MatrixXd::Constant(2, film.frames, std::nan(""));
    recording.sealed.rightCols(kSealed) = recording.measured.rightCols(kSealed);
    recording.measured.rightCols(kSealed).setConstant(std::nan(""));
  }
  const auto problem =
      std::make_shared<const Problem>(the_case, model, std::vector<Recording>{recording});
  return fit_model(problem, problem->start(), {{.level = kFilmNoise}}, fit_least_squares, nullptr);
}

inline PredictionErrors errors_of(const FittedModel& model, const FittedModel& without_laws) {
  const TemporaryFolder folder;
  DiagnosisContext context(model.problem->the_case(), {}, folder.path(), fit_least_squares, {});
  return prediction_errors(model, without_laws, {{.level = kFilmNoise}}, context);
}
inline PredictionErrors errors_of(const FittedModel& model) { return errors_of(model, model); }

inline bool holds(const PredictionError& error) {
  return error.low <= error.observed && error.observed <= error.high;
}

}  // namespace catena::testing
