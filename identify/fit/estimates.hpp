// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "common/cpu_seconds.hpp"
#include "common/large_work.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {

/// The memory of the motion of an experiment, or with -1 of the case alone, and of the files that a
/// command makes of it.
double memory_of_motion(const Problem& problem, int experiment);

/// Of all that the case has. They are in memory until they are written, whole.
double memory_of_motions(const Problem& problem);

/// Simulations' worth of time that a fit takes, by experience: of least squares about 10 evaluations
/// with sensitivities, of which each costs a third of a simulation.
double simulations_of_a_fit(const Problem& problem);

/// What a fit that begins near its end takes of that.
inline constexpr double kShareOfRefit = 0.3;

/// The time of work that takes `seconds_of(s)` where a simulation at the case's own start takes s
/// seconds, with the memory of its motions. The simulation is put into `start`. It ends early where
/// it alone shows that the work takes longer than what is begun unasked, unless `yes`, and where
/// `stopped` says so.
WorkEstimate estimate_of(const Problem& problem, const std::function<double(double)>& seconds_of,
                         bool yes, const std::function<bool()>& stopped, Evaluation& start);

/// Ends simulations of this thread that would take longer than what is begun unasked. What is left
/// is reckoned from how far they came.
class Forecast {
 public:
  /// `whole`: s of motion in all; `times`: so often is each simulated.
  Forecast(bool yes, double whole, double times) : yes_(yes), whole_(whole), times_(times) {}

  /// False where the work is too long. `done`: s of motion so far. Nothing is said in the first
  /// 0.3 s, and up to 3 s only of what would take 30 times as long as is begun unasked.
  bool goes_on(double done);
  /// Throws InputError "WHAT needs about 3 hours; ..." where it was too long.
  void require_yes(const std::string& what) const { catena::require_yes(yes_, what, estimate_); }

 private:
  bool yes_;
  double whole_, times_;
  double begin_ = cpu_seconds();
  WorkEstimate estimate_;
};

}  // namespace catena
