// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// How far predictions are off where nothing was fitted, and how far one had to expect them to be.
///
/// One has to expect errors like those that the model leaves where it was fitted, noise and what it lacks: random
/// series of the same spectra and the same correlations between channels, of all frames (parametric bootstrap).
/// The model is fitted to its own prediction with such an error, and predicts the rest. The fit is one linearised
/// step, within the bounds of the unknowns, and the simulation with it. If that leaves more than it should, the
/// motion is not linear in the unknowns that far, and the fit is a full one.
///
/// A direction of the unknowns along which the fitted part does not change at all stays as it is. Laws are taken to
/// hold where nothing was fitted as they do where it was. With errors of a share of what the laws explain there
/// (DiagnosisThresholds::law_error), more may be left: such a motion the fitted part does not determine either.

/// Of one part of the recordings, root mean squares, m or rad; NaN where there is no such part.
struct PredictionError {
  double observed = kNotGiven;
  /// The interval of what is expected; `high` may be infinite.
  double low = kNotGiven, high = kNotGiven;
  double explained = 0;  ///< by laws: the root of the fall of the mean square
  /// The largest that is expected where laws are wrong by law_error.
  double high_with_errors_of_laws() const;
};

struct PredictionErrors {
  PredictionError held_out, sealed;
  /// Whether any part was predicted.
  bool known() const { return !std::isnan(held_out.observed) || !std::isnan(sealed.observed); }
};

/// Of a model that was fitted with this noise. `without_laws`: the same without its effects that are laws; the model
/// itself where none is. Experiments that only validate and start as fits them best are no
/// predictions and not counted. Throws std::runtime_error where the simulation with derivatives fails, and
/// Interrupted.
PredictionErrors prediction_errors(const FittedModel& model, const FittedModel& without_laws,
                                   const std::vector<NoiseModel>& noise, DiagnosisContext& context);

/// What the errors say, a sentence for each part: that the fitted part does not determine the motion, or that the
/// model lacks something. Nothing of one that is as expected and not far above `fitted`, what is left where the
/// model was fitted. `milli_unit`: "mm".
std::vector<std::string> words_of(const PredictionErrors& errors, double fitted,
                                  const std::string& milli_unit);

}  // namespace catena
