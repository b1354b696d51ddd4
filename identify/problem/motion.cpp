// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/motion.hpp"

#include "identify/problem/prediction.hpp"
#include "runtime/positions.hpp"

namespace catena {

Motion simulate_motion(const Model& model, const Eigen::VectorXd& parameters, const State& initial,
                       const std::vector<double>& times, const SimulationSpec& settings,
                       const Signals& signals, const std::function<bool()>& keep_going) {
  SimulationOptions options = simulation_options(settings);
  if (keep_going) options.keep_going = [&](double) { return keep_going(); };
  Motion motion;
  motion.simulation = simulate(model, parameters, initial, times, options, signals);
  const Trajectory& path = motion.simulation.trajectory;
  const auto count = static_cast<Eigen::Index>(path.time.size());
  motion.side.resize(model.links() + 2, count);
  motion.down.resize(model.links() + 2, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Positions at = positions(model, parameters, path.time[static_cast<std::size_t>(k)],
                                   path.q.col(k), signals);
    motion.side.col(k) = at.side;
    motion.down.col(k) = at.down;
  }
  return motion;
}

Motion motion_of(const Problem& problem, const Eigen::VectorXd& x, int experiment,
                 const std::function<bool()>& keep_going) {
  const Experiment& chosen = problem.experiments()[static_cast<std::size_t>(experiment)];
  std::vector<double> times = {chosen.spec.start};
  for (const double t : chosen.recording.time)
    if (t > times.back()) times.push_back(t);
  return simulate_motion(problem.model(), problem.model_parameters(x, experiment),
                         problem.initial_state(x, experiment), times, problem.the_case().simulation,
                         chosen.signals, keep_going);
}

}  // namespace catena
