// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "identify/cases/case.hpp"
#include "identify/noise/noise_model.hpp"
#include "identify/problem/parameter_map.hpp"
#include "identify/recordings/recording.hpp"
#include "runtime/model.hpp"
#include "runtime/signals.hpp"

namespace catena {

/// One experiment of a case with its data, or one window of it.
struct Experiment {
  ExperimentSpec spec;
  Recording recording;
  InitialSpec initial;      ///< its own or the case's, with all coefficients found
  Signals signals;          ///< in the order of the model
  int source = -1;          ///< index into Case::experiments: several windows may be of one
  int meets = -1;           ///< multiple shooting: the experiment that starts where this one ends
  double ends = kNotGiven;  ///< s: when it does, if there is one
  /// What a shooting defect costs, as a multiple of a residual of the same number: so much that it
  /// closes. Lower while a fit is on its way.
  double defect_weight = 1e4;
  /// With which least squares make the fitted residuals white; none: they stay as they are, weighed
  /// with the noise that the case states.
  std::shared_ptr<const NoiseModel> noise = {};

  /// m or rad: what the fitted residuals are divided by; 1 where nothing is known of the noise.
  double noise_level() const {
    if (noise) return noise->level;
    return std::isnan(spec.noise) ? 1 : spec.noise;
  }

  /// Whether any of its frames are fitted; else it only validates.
  bool fitted() const { return spec.use == Use::kFit && recording.fit_frames > 0; }
};

/// The experiments of a case in its order, those with a `window` cut into one experiment per window.
///
/// `recordings`: one per experiment of the case, or none: then the files of the case are read.
/// `map`: the case's. Signals are read, and coefficients of the start that the case leaves open are
/// found from the first frames. What is read from files is held against what a cable can do
/// (plausibility.hpp): its recording has the warnings. Throws InputError for data that cannot be used
/// and for a window that is too short; std::invalid_argument for another number of recordings.
std::vector<Experiment> experiments_of(const Case& the_case, const Model& model,
                                       const ParameterMap& map, std::vector<Recording> recordings);

}  // namespace catena
