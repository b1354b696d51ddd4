// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/compare.hpp"

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/fit/error.hpp"
#include "identify/forces/force_law.hpp"

namespace catena {

double sum_of_squares(const FittedModel& model, const std::vector<NoiseModel>& noise) {
  double sum = stacked(model.fit_residual, model.fit_residual, noise).squaredNorm();
  for (const Prior& prior : priors_of(*model.problem))
    sum += std::pow((model.x[prior.unknown] - prior.measured) / prior.deviation, 2);
  return sum;
}

namespace {

double unknowns(const FittedModel& model) {
  return static_cast<double>(model.problem->unknowns().size());
}

}  // namespace

Comparison compare(const FittedModel& base, const FittedModel& larger,
                   const std::vector<NoiseModel>& noise) {
  Comparison result;
  const double before = sum_of_squares(base, noise), after = sum_of_squares(larger, noise);
  const double count = static_cast<double>(fit_gap(base, noise).count);
  result.removed = before - after;
  result.added = static_cast<int>(unknowns(larger) - unknowns(base));
  result.autocorrelation = autocorrelation_factor(white_residuals(larger, noise));
  const double effective = std::max(2.0, count / result.autocorrelation);
  const double added = std::max(1, result.added);
  result.criterion = effective * std::log(after / before) + result.added * std::log(effective);
  // The variance of what is left stands for the noise where it is larger than the noise.
  const double variance = std::max(1.0, after / std::max(1.0, count - unknowns(larger)));
  result.log10_p = log10_chi_square_tail(
      std::max(0.0, result.removed) / (variance * result.autocorrelation), static_cast<int>(added));
  const double misfit_before = std::pow(fit_gap(base, noise).misfit, 2);
  const double misfit_after = std::pow(fit_gap(larger, noise).misfit, 2);
  result.misfit_share = misfit_before > 0 ? 1 - misfit_after / misfit_before : 0;
  return result;
}

double chance_of_any(const Comparison& comparison, int tried) {
  return std::min(1.0, std::pow(10, comparison.log10_p) * std::max(1, tried));
}

double error_shared(const GapTest& left) {
  return std::max(kLawThresholds.shared_error, left.noise > 0 ? left.misfit / left.noise : 0.0);
}

Decision decide(const FittedModel& better, const FittedModel& worse,
                const std::vector<NoiseModel>& noise) {
  Decision decision;
  decision.difference = prediction_distance(better, worse, noise);
  decision.lead = sum_of_squares(worse, noise) - sum_of_squares(better, noise);
  const GapTest left = fit_gap(better, noise);
  const double count = static_cast<double>(left.count);
  const double shared = error_shared(left);
  const double by_error =
      count * std::max(0.0, decision.difference * (2 * shared - decision.difference));
  const double autocorrelation = autocorrelation_factor(white_residuals(better, noise));
  decision.needed = by_error + 2 * std::log(kThresholds.odds) * autocorrelation +
                    std::log(std::max(2.0, count)) * (unknowns(better) - unknowns(worse));
  decision.decided = decision.lead > decision.needed &&
                     predicts_as_well(held_out_gap(better, noise), held_out_gap(worse, noise));
  return decision;
}

}  // namespace catena
