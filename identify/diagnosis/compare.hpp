// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// How much better one fitted model explains the same data than another. Residuals are weighted
/// with the noise `noise`. They are not independent where something is still missing, so that both
/// the likelihood and the counts are divided by the autocorrelation factor of the better model's residuals.
struct Comparison {
  double removed = 0;          ///< fall of the sum of squares, in units of the noise squared
  int added = 0;               ///< further unknowns
  double autocorrelation = 1;  ///< autocorrelation factor of the larger model's residuals
  double criterion = 0;        ///< change of the Bayesian information criterion; negative: better
  double log10_p = 0;          ///< of so large a fall by chance, for one model tried
  double misfit_share = 0;     ///< fall of the squared misfit, as a share of what it was
};

/// An upper bound (Bonferroni) of the probability that the best of so many models removes as much.
double chance_of_any(const Comparison& comparison, int tried);

/// From `base` to `larger`, which has `base` as a special case.
Comparison compare(const FittedModel& base, const FittedModel& larger,
                   const std::vector<NoiseModel>& noise);

/// Sum of squares of the fitted part in units of the noise squared, and of how far unknowns with a prior are
/// from what it says, in its standard deviations.
double sum_of_squares(const FittedModel& model, const std::vector<NoiseModel>& noise);

/// Over the noise, rms: the error that models share, of which one left this. What even that leaves, and
/// LawThresholds::shared_error at least.
double error_shared(const GapTest& left);

/// Whether the data decide between two models that stand for different explanations, `better` being
/// the one with the smaller sum of squares. If the worse one were right but for an error of rms
/// s noise that both share (error_shared of the better one), that error could
/// put the better one ahead by N d (2 s - d), d the rms difference of the two predictions over the
/// noise. The data decide if the lead exceeds this bound plus what chance gives at odds of one in a thousand, and if
/// the better model also predicts the held-out part as well: a lead that is lost there shows freedom, not truth.
struct Decision {
  bool decided = false;
  double difference = 0;  ///< d, fitted and held-out parts
  double lead = 0;        ///< fall of the sum of squares from the worse to the better
  double needed = 0;      ///< of that, to decide
};
/// `noise`: of every experiment.
Decision decide(const FittedModel& better, const FittedModel& worse,
                const std::vector<NoiseModel>& noise);

}  // namespace catena
