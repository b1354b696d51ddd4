// SPDX-License-Identifier: BSD-3-Clause
#include "identify/uncertainty/profile.hpp"

#include <atomic>
#include <cmath>

#include "common/parallel.hpp"
#include "identify/fit/error.hpp"
#include "identify/fit/loss.hpp"

namespace catena {
namespace {

using Eigen::VectorXd;

VectorXd without(const VectorXd& x, Eigen::Index j) {
  VectorXd rest(x.size() - 1);
  rest << x.head(j), x.tail(x.size() - 1 - j);
  return rest;
}

/// Twice the negative logarithm of the likelihood but for a constant: the sum of squared residuals
/// over their noise, or, where the noise is found from them, what its sizes leave of it.
double minus_log_likelihood(const Problem& problem, const Residuals& residuals) {
  const VectorXd noise = noise_of(problem, residuals);
  if (problem.the_case().error.measure == Measure::kLikelihood)
    return 2 * noise.array().log().sum();
  double sum = 0;
  for (const double r : residuals.value.cwiseQuotient(noise))
    sum += loss_of(problem.the_case().error, r * r).value;
  return sum;
}

/// The problem with one unknown of the physics held at a value.
Problem held_at(const Problem& problem, int unknown, double value) {
  Case the_case = problem.the_case();
  const int parameter = problem.unknowns()[static_cast<std::size_t>(unknown)].parameter;
  ParameterSpec& held = the_case.parameters[static_cast<std::size_t>(parameter)];
  held.value = value;
  held.free = false;
  return Problem(std::move(the_case), problem.model(), problem.experiments());
}

/// The same, at the best the others can do; infinite if it failed.
double best_square(const Problem& problem, int unknown, double value, VectorXd& rest,
                   const LeastSquares& least_squares, const std::atomic<bool>* stop) {
  const Problem held = held_at(problem, unknown, value);
  const auto square_at = [&](const VectorXd& x) {
    const Evaluation evaluation = evaluate(held, x, false, false);
    if (!evaluation.ok) return std::numeric_limits<double>::infinity();
    const Residuals residuals = fitted_residuals(held, evaluation);
    return minus_log_likelihood(held, residuals);
  };
  if (rest.size() == 0) return square_at(rest);
  FitOptions options;
  options.start = rest;
  options.stop = stop;
  const FitResult fit = least_squares(held, options);
  rest = fit.x;
  return square_at(rest);
}

/// The value so many standard deviations away, within the bounds.
double moved(const Unknown& unknown, double best, const Estimate& estimate, double deviations) {
  const bool logarithmic = unknown.scale == Scale::kLogarithmic;
  double step = logarithmic ? estimate.standard_error / std::abs(best) : estimate.standard_error;
  const double widest = logarithmic ? 1.0 : 0.25 * (unknown.upper - unknown.lower);
  if (!std::isfinite(step) || step > widest) step = widest;
  const double value = logarithmic ? best * std::exp(deviations * step) : best + deviations * step;
  return std::clamp(value, unknown.least, unknown.most);
}

/// What a log keeps of a profile: its verdict, its values, their costs.
VectorXd values_of(const Profile& profile) {
  const auto count = static_cast<Eigen::Index>(profile.value.size());
  VectorXd values(1 + 2 * count);
  values << static_cast<double>(profile.verdict),
      Eigen::Map<const VectorXd>(profile.value.data(), count),
      Eigen::Map<const VectorXd>(profile.cost.data(), count);
  return values;
}

void put_values(const VectorXd& values, Profile& profile) {
  const Eigen::Index count = values.size() / 2;
  profile.verdict = static_cast<Verdict>(values[0]);
  profile.value.assign(values.begin() + 1, values.begin() + 1 + count);
  profile.cost.assign(values.begin() + 1 + count, values.end());
}

}  // namespace

std::vector<Profile> profiles_of(const Problem& problem, const FitResult& fit,
                                 const Uncertainty& uncertainty, const LeastSquares& least_squares,
                                 int threads, const std::atomic<bool>* stop, RunLog* log,
                                 const Shard& shard) {
  std::vector<int> chosen;
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j)
    if (problem.unknowns()[j].parameter >= 0 && problem.unknowns()[j].experiment < 0)
      chosen.push_back(static_cast<int>(j));
  const Evaluation best = evaluate(problem, fit.x, false, false);
  const Residuals residuals = fitted_residuals(problem, best);
  const double least = minus_log_likelihood(problem, residuals);
  const bool by_likelihood = problem.the_case().error.measure == Measure::kLikelihood;
  const double variance = by_likelihood ? 1 : uncertainty.noise * uncertainty.noise;
  // A residual that repeats the one before says less than a new one (AR(1)).
  const double repeated =
      uncertainty.autocorrelated && uncertainty.autocorrelation > 0
          ? (1 + uncertainty.autocorrelation) / (1 - uncertainty.autocorrelation)
          : 1;
  std::vector<Profile> profiles(chosen.size());
  std::atomic<bool> complete = true;
  const std::string name = name_of(fit);
  in_parallel(chosen.size(), threads, [&](std::size_t p) {
    Profile& profile = profiles[p];
    profile.unknown = chosen[p];
    const Refit refit{kProfileRefit, static_cast<int>(p), name};
    if (log)
      if (const auto known = log->refitted(refit)) {
        put_values(*known, profile);
        return;
      }
    if (!shard.has(p)) {
      complete = false;
      return;
    }
    const auto j = static_cast<std::size_t>(chosen[p]);
    const Unknown& unknown = problem.unknowns()[j];
    const double centre = fit.x[chosen[p]];
    bool crossed[2] = {false, false};
    std::vector<std::pair<double, double>> points = {{centre, 0.0}};
    for (const int side : {-1, 1}) {
      VectorXd rest = without(fit.x, chosen[p]);
      double last = centre;
      for (const double deviations : {0.5, 1.0, 1.5, 2.0, 2.5, 3.5, 5.0, 8.0}) {
        const double value = moved(unknown, centre, uncertainty.estimates[j], side * deviations);
        if (value == last) break;  // the bound
        if (stop && *stop) return;
        last = value;
        const double square = best_square(problem, chosen[p], value, rest, least_squares, stop);
        points.emplace_back(value, (square - least) / (variance * repeated));
        if (points.back().second > profile.threshold) {
          crossed[side > 0] = true;
          break;
        }
      }
    }
    std::sort(points.begin(), points.end());
    double highest = 0;
    for (const auto& [value, cost] : points) {
      profile.value.push_back(value);
      profile.cost.push_back(cost);
      highest = std::max(highest, cost);
    }
    constexpr double kFlat = 0.05;  // a likelihood that changes by less says nothing
    profile.verdict = crossed[0] && crossed[1] ? Verdict::kIdentifiable
                      : highest < kFlat        ? Verdict::kStructurallyNot
                                               : Verdict::kPracticallyNot;
    if (log && !(stop && *stop)) log->finish(refit, values_of(profile));
  });
  if (!complete || (stop && *stop)) profiles.clear();
  return profiles;
}

}  // namespace catena
