// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/diagnosis/fitted_model.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {

/// Is what a model leaves more than noise and laws that are a little wrong leave?
///
/// A model of the right effects leaves, where it was fitted (f) and where it was held out (h),
///
///     r_f = (1 - J_f J_f^+) (e_f + m_f),    r_h = e_h + m_h - J_h J_f^+ (e_f + m_f):
///
/// e is the noise, m what the laws get wrong, J the derivative by the unknowns. So what is held out
/// has the errors of the unknowns, too. 199 such recordings are drawn (parametric bootstrap of the
/// linearised model). e is white, all residuals being made white before; its level is as uncertain
/// as that of the data. m has the spectrum and the correlations between channels of what is left
/// beyond the noise where it was fitted, and the mean square that is tolerated. The statistic of a
/// part is its mean square.

/// The residuals of a model and how its unknowns change them, all made white.
struct Remainder {
  /// Channels x frames of every experiment, NaN where nothing was seen; no columns where an
  /// experiment has no such part.
  std::vector<Eigen::MatrixXd> fitted, held_out;
  /// One column per unknown; a row for every residual that was seen: experiment, frame, channel.
  /// `fitted` ends with a row for every prior, in units of its standard deviation.
  Eigen::MatrixXd fitted_along, held_out_along;
};

/// One number for each part.
struct OfParts {
  double fitted = 0, held_out = 0;
};

/// Mean squares of the residuals, less 1: the misfit in units of the noise; 0 where nothing is seen.
OfParts excess(const Remainder& remainder);

/// The probability that noise and errors of laws leave as much as `remainder`, from 1/200 to 1.
/// `tolerated`: mean squares of the errors of laws, in units of the noise. 1 where nothing is seen.
OfParts chance_of_remainder(const Remainder& remainder, const OfParts& tolerated);

/// One simulation with derivatives of the whole recordings. Throws std::runtime_error where it fails.
Evaluation evaluated_with_derivatives(const FittedModel& model);
Remainder remainder_of(const FittedModel& model, const std::vector<NoiseModel>& noise);
/// From that simulation.
Remainder remainder_of(const FittedModel& model, const std::vector<NoiseModel>& noise,
                       const Evaluation& evaluation);

/// held_out_gap(), with `present`: more is left than errors of the unknowns, noise, and a misfit that is no
/// gap where it is fitted explain, by chance in fewer than 1 of 100 (DiagnosisThresholds::chance).
GapTest tested_held_out_gap(const FittedModel& model, const std::vector<NoiseModel>& noise);

/// Whether noise and errors of laws of these mean squares leave as much as a model does, in both
/// parts; what the case accepts counts as nothing.
bool leaves_no_more(const FittedModel& model, const std::vector<NoiseModel>& noise,
                    const OfParts& tolerated);

/// In which parts there is a gap.
struct GapIn {
  bool fitted = false, held_out = false;
};

/// Whether what is left where there is a gap is no more than noise and errors of laws
/// (DiagnosisThresholds::law_error) leave by chance. Laws are wrong by a share of what they explain:
/// of what is left without them (`without_laws`). What is exact, a mass or the tilt of a camera, has
/// no such errors, so it excuses no remaining gap.
bool only_errors_of_laws(const Remainder& left, const Remainder& without_laws, GapIn gap);

/// Whether a model leaves no gap, or only errors of its laws. `without_laws`: the model with those
/// of its effects only that are exact; the model itself where all are.
bool closes_gap(const FittedModel& model, const FittedModel& without_laws,
                const std::vector<NoiseModel>& noise);
/// The same of what was fitted, at a glance: without a test. `before`: without the effects.
bool nearly_closes(const GapTest& fit, const GapTest& before);

}  // namespace catena
