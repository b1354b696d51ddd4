// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/motion.hpp"

#include <cmath>

#include "common/input_error.hpp"
#include "identify/problem/prediction.hpp"
#include "identify/recordings/signal_reader.hpp"
#include "runtime/positions.hpp"

namespace catena {
namespace {

/// Every `step` from 0 to `duration`, s.
std::vector<double> output_times(const SimulationSpec& settings) {
  const auto count = static_cast<std::size_t>(std::floor(settings.duration / settings.step + 1e-9));
  std::vector<double> times;
  for (std::size_t k = 0; k <= count; ++k) times.push_back(static_cast<double>(k) * settings.step);
  if (times.size() < 2) times.push_back(settings.duration);
  return times;
}

Motion motion_at(const std::vector<double>& times, const Problem& problem, const Eigen::VectorXd& x,
                 int experiment, const Signals& signals,
                 const std::function<bool(double)>& keep_going) {
  const Model& model = problem.model();
  const Eigen::VectorXd parameters = problem.model_parameters(x, experiment);
  SimulationOptions options = simulation_options(problem.the_case().simulation);
  // A model for fits has neither energies nor internal forces.
  options.energy = options.energy && model.energies() > 0;
  options.events = true;
  if (keep_going) options.keep_going = keep_going;
  Motion motion;
  motion.simulation =
      simulate(model, parameters, problem.initial_state(x, experiment), times, options, signals);
  Trajectory& path = motion.simulation.trajectory;
  if (model.in_space()) normalise_directions(path, model.links());
  const auto count = static_cast<Eigen::Index>(path.time.size());
  motion.side.resize(model.links() + 2, count);
  motion.down.resize(model.links() + 2, count);
  if (model.in_space()) motion.across.resize(model.links() + 2, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Positions at = positions(model, parameters, path.time[static_cast<std::size_t>(k)],
                                   path.q.col(k), signals);
    motion.side.col(k) = at.side;
    motion.down.col(k) = at.down;
    if (model.in_space()) motion.across.col(k) = at.across;
  }
  if (motion.simulation.status == Status::kSuccess && model.table().internal_forces != nullptr)
    motion.forces = internal_forces(model, parameters, path, signals);
  return motion;
}

}  // namespace

Motion motion_alone(const Problem& problem, const Eigen::VectorXd& x,
                    const std::function<bool(double)>& keep_going) {
  const Case& the_case = problem.the_case();
  if (std::isnan(the_case.simulation.duration))
    throw InputError(
        the_case.file.string() +
        ": simulation.duration: missing; without an [[experiment]] it says how long to simulate");
  return motion_at(output_times(the_case.simulation), problem, x, -1,
                   read_signals(the_case.signals, problem.model(), the_case.file.string()),
                   keep_going);
}

Motion motion_of(const Problem& problem, const Eigen::VectorXd& x, int experiment,
                 const std::function<bool(double)>& keep_going) {
  const Experiment& chosen = problem.experiments()[static_cast<std::size_t>(experiment)];
  std::vector<double> times = {chosen.spec.start};
  for (const double t : chosen.recording.time)
    if (t > times.back()) times.push_back(t);
  return motion_at(times, problem, x, experiment, chosen.signals, keep_going);
}

SeenChain seen_chain(const Problem& problem, const Eigen::VectorXd& x, int experiment) {
  const Model& model = problem.model();
  Experiment watched = problem.experiments()[static_cast<std::size_t>(experiment)];
  const bool angles = watched.recording.channels.front().component == Component::kAngle;
  watched.recording.points.clear();
  watched.recording.channels.clear();
  const auto watch = [&](PointSpec point) {
    const auto index = static_cast<int>(watched.recording.points.size());
    watched.recording.points.push_back(std::move(point));
    if (angles) {
      watched.recording.channels.push_back({index, Component::kAngle, ""});
    } else {
      watched.recording.channels.push_back({index, Component::kSide, ""});
      watched.recording.channels.push_back({index, Component::kDown, ""});
      if (model.in_space()) watched.recording.channels.push_back({index, Component::kAcross, ""});
    }
  };
  for (int link = 1; link <= model.links(); ++link) {
    PointSpec upper_end, lower_end;
    upper_end.link = lower_end.joint = link;
    watch(upper_end);
    if (!angles) watch(lower_end);
  }
  PointSpec load;
  load.load = true;
  if (!angles) watch(load);
  const Eigen::VectorXd parameters = problem.model_parameters(x, experiment);
  const Eigen::MatrixXd reported =
      predict_experiment(model, problem.the_case().simulation, watched, parameters,
                         problem.initial_state(x, experiment), true, {}, {})
          .simulated;
  SeenChain seen{watched.recording.time, {}, {}, {}};
  if (!angles) {
    const Eigen::Index components = watched.recording.components();
    const auto every = [&](Eigen::Index first) {
      return reported(Eigen::seq(first, Eigen::last, components), Eigen::all);
    };
    seen.side = every(0);
    seen.down = every(1);
    if (model.in_space()) seen.across = every(2);
    return seen;
  }
  const Eigen::VectorXd lengths =
      parameters.segment(model.parameter_index("length_1"), model.links());
  seen.side.setZero(model.links() + 1, reported.cols());
  seen.down = seen.side;
  for (Eigen::Index i = 0; i < lengths.size(); ++i) {
    seen.side.row(i + 1) = seen.side.row(i) + lengths[i] * reported.row(i).array().sin().matrix();
    seen.down.row(i + 1) = seen.down.row(i) + lengths[i] * reported.row(i).array().cos().matrix();
  }
  return seen;
}

}  // namespace catena
