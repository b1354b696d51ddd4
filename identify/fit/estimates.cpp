// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/estimates.hpp"

#include <algorithm>
#include <cmath>

namespace catena {

double memory_of_motion(const Problem& problem, int experiment) {
  constexpr double kBytes = 1100;  // an output and link: measured with 12 links, 50 000 outputs
  const SimulationSpec& simulation = problem.the_case().simulation;
  const double outputs =
      experiment < 0
          ? simulation.duration / simulation.step
          : static_cast<double>(
                problem.experiments()[static_cast<std::size_t>(experiment)].recording.time.size());
  return kBytes * outputs * (problem.model().links() + 1);
}

double memory_of_motions(const Problem& problem) {
  const auto experiments = static_cast<int>(problem.experiments().size());
  if (experiments == 0) return memory_of_motion(problem, -1);
  double bytes = 0;
  for (int e = 0; e < experiments; ++e) bytes += memory_of_motion(problem, e);
  return bytes;
}

double simulations_of_a_fit(const Problem& problem) {
  const auto unknowns = static_cast<double>(problem.unknowns().size());
  const OptimiserSpec& spec = problem.the_case().optimiser;
  if (spec.method == FitMethod::kNelderMead)
    return std::min<double>(40 * unknowns, spec.max_evaluations);
  const double evaluations = spec.method == FitMethod::kLeastSquares ? 10 : 30;
  return std::min<double>(evaluations, spec.max_evaluations) * (1 + unknowns / 3);
}

WorkEstimate estimate_of(const Problem& problem, const std::function<double(double)>& seconds_of,
                         bool yes, const std::function<bool()>& stopped, Evaluation& start) {
  WorkEstimate estimate = {.bytes = memory_of_motions(problem)};
  const double begin = cpu_seconds();
  constexpr double kPatience = 1;  // s; a simulation that is shorter is measured whole
  const auto keep_going = [&](double) {
    const double simulation = cpu_seconds() - begin;
    estimate.seconds = seconds_of(simulation);
    estimate.or_more = simulation > kPatience && estimate.seconds > kMostUnasked.seconds;
    return (yes || !estimate.or_more) && !stopped();
  };
  start = evaluate(problem, problem.start(), true, false, keep_going);
  estimate.seconds = seconds_of(cpu_seconds() - begin);
  return estimate;
}

bool Forecast::goes_on(double done) {
  // s; the beginning may be slower than the rest, but hardly so many times
  constexpr double kFirstLook = 0.3, kPatience = 3, kTimesSlower = 30;
  const double seconds = cpu_seconds() - begin_;
  if (yes_ || seconds < kFirstLook || !(done > 0)) return true;
  const double all = times_ * seconds * whole_ / done;
  if (all <= kMostUnasked.seconds * (seconds < kPatience ? kTimesSlower : 1)) return true;
  estimate_.seconds = all;
  return false;
}

}  // namespace catena
