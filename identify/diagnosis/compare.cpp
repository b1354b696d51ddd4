// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/compare.hpp"

#include <algorithm>
#include <cmath>

namespace catena {

double sum_of_squares(const FittedModel& model, const std::vector<double>& floors) {
  return stacked(model.fit_residual, model.fit_residual, floors).squaredNorm();
}

namespace {

double unknowns(const FittedModel& model) {
  return static_cast<double>(model.problem->unknowns().size());
}

std::vector<Eigen::MatrixXd> weighted(const FittedModel& model, const std::vector<double>& floors) {
  std::vector<Eigen::MatrixXd> result;
  for (std::size_t e = 0; e < model.fit_residual.size(); ++e)
    if (model.fit_residual[e].cols() > 0) result.push_back(model.fit_residual[e] / floors[e]);
  return result;
}

}  // namespace

Comparison compare(const FittedModel& base, const FittedModel& larger,
                   const std::vector<double>& floors) {
  Comparison result;
  const double before = sum_of_squares(base, floors), after = sum_of_squares(larger, floors);
  const double count = static_cast<double>(fit_gap(base, floors).count);
  result.removed = before - after;
  result.added = static_cast<int>(unknowns(larger) - unknowns(base));
  result.colour = colour_factor(weighted(larger, floors));
  const double effective = std::max(2.0, count / result.colour);
  const double added = std::max(1, result.added);
  result.criterion = effective * std::log(after / before) + result.added * std::log(effective);
  // The variance of what is left stands for the noise where it is larger than the floor.
  const double variance = std::max(1.0, after / std::max(1.0, count - unknowns(larger)));
  result.log10_p = log10_chi_square_tail(std::max(0.0, result.removed) / (variance * result.colour),
                                         static_cast<int>(added));
  const double misfit_before = std::pow(fit_gap(base, floors).misfit, 2);
  const double misfit_after = std::pow(fit_gap(larger, floors).misfit, 2);
  result.misfit_removed = misfit_before - misfit_after;
  result.misfit_share = misfit_before > 0 ? 1 - misfit_after / misfit_before : 0;
  return result;
}

Decision decide(const FittedModel& better, const FittedModel& worse,
                const std::vector<double>& floors) {
  constexpr double kOdds = 1000;
  constexpr double kSharedError = 0.1;  // of the noise, at least
  Decision decision;
  decision.difference = prediction_distance(better, worse, floors);
  decision.lead = sum_of_squares(worse, floors) - sum_of_squares(better, floors);
  const GapTest left = fit_gap(better, floors);
  const double count = static_cast<double>(left.count);
  const double shared = std::max(kSharedError, left.floor > 0 ? left.misfit / left.floor : 0.0);
  const double by_error =
      count * std::max(0.0, decision.difference * (2 * shared - decision.difference));
  const double colour = colour_factor(weighted(better, floors));
  const double needed = 2 * std::log(kOdds) * colour +
                        std::log(std::max(2.0, count)) * (unknowns(better) - unknowns(worse));
  decision.decided = decision.lead > by_error + needed;
  return decision;
}

}  // namespace catena
