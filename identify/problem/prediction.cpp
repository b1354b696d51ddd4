// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/prediction.hpp"

#include <algorithm>
#include <optional>

#include "common/impossible_value.hpp"
#include "common/number_text.hpp"
#include "identify/problem/marker_places.hpp"
#include "identify/problem/observer.hpp"
#include "runtime/sensitivity.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

VectorXd or_zero(const VectorXd& vector, Index size) {
  return vector.size() ? vector : VectorXd::Zero(size);
}

/// Whether the motion is the same along a direction, in which only places of markers change.
bool motion_stays(const Model& model, const SensitivityDirection& direction) {
  return direction.q.isZero(0) && direction.v.isZero(0) &&
         direction.parameters.head(first_marker_place(model)).isZero(0);
}

/// A motion of which nothing changes, at the times of a path.
Trajectory unchanged(const Trajectory& path) {
  const auto zero = [](const Eigen::MatrixXd& values) {
    return Eigen::MatrixXd::Zero(values.rows(), values.cols());
  };
  return {path.time, zero(path.q), zero(path.v), zero(path.z), {}};
}

void check_signals(const Experiment& experiment, const FrameClock& clock, Index frames) {
  // Signals that end before the recording are a mistake of the case, which simulate() refuses. Here the recording
  // has them, and an unknown took the clock beyond them.
  const Signals& signals = experiment.signals;
  const std::vector<double>& time = experiment.recording.time;
  if (signals.count() > 0 && clock.times.back() > signals.last_time() &&
      time[static_cast<std::size_t>(frames - 1)] <= signals.last_time())
    throw ImpossibleValue(
        "the model's clock is ahead of the recording's and asks for signals until " +
        number_text(clock.times.back()) + " s, which end at " + number_text(signals.last_time()) +
        " s");
}

/// The coordinates and rates in one column of a path.
VectorXd state_in(const Trajectory& path, Index column) {
  VectorXd state(2 * path.q.rows());
  state << path.q.col(column), path.v.col(column);
  return state;
}

/// Where the path of an experiment ends that another one continues.
Index last_column(const Experiment& experiment, const FrameClock& clock) {
  const double ends = experiment.meets >= 0 ? experiment.ends : clock.times.back();
  return std::lower_bound(clock.times.begin(), clock.times.end(), ends) - clock.times.begin();
}

void refuse_what_is_not_finite(Prediction& prediction, const Experiment& experiment) {
  bool finite = prediction.simulated.allFinite();
  for (const auto& changes : prediction.sensitivity) finite &= changes.allFinite();
  if (finite) return;
  prediction.status = Status::kNotFinite;
  prediction.message = "what the sensors would see is not finite";
  const std::vector<PointSpec>& points = experiment.recording.points;
  if (!points.empty() && !points.front().camera.empty())
    prediction.message +=
        "; a camera sees only what lies before it: look at the places and directions of the "
        "cameras";
}

}  // namespace

Prediction failed_prediction(const Experiment& experiment, const std::string& message) {
  Prediction failed;
  failed.status = Status::kNotFinite;
  failed.message = message;
  failed.simulated.setConstant(static_cast<Index>(experiment.recording.channels.size()),
                               static_cast<Index>(experiment.recording.time.size()), kNotGiven);
  return failed;
}

SimulationOptions simulation_options(const SimulationSpec& settings) {
  SimulationOptions options;
  options.relative_tolerance = settings.relative_tolerance;
  options.absolute_tolerance_position = settings.absolute_tolerance_position;
  options.absolute_tolerance_velocity = settings.absolute_tolerance_velocity;
  options.max_steps = settings.max_steps;
  return options;
}

Prediction predict_experiment(const Model& model, const SimulationSpec& settings,
                              const Experiment& experiment, const VectorXd& parameters,
                              const State& initial, bool all_frames,
                              const std::vector<SensitivityDirection>& along,
                              const std::function<bool(double)>& keep_going) {
  const Recording& recording = experiment.recording;
  const auto channels = static_cast<Index>(recording.channels.size());
  const Index frames =
      all_frames ? static_cast<Index>(recording.time.size()) : recording.fit_frames;
  const FrameClock clock = frame_clock(model, experiment, parameters, frames);
  check_signals(experiment, clock, frames);

  SimulationOptions options = simulation_options(settings);
  options.energy = false;
  if (keep_going) options.keep_going = keep_going;
  std::vector<SensitivityDirection> directions;
  std::vector<std::size_t> index_of;  // into `along`, of each that is not zero
  for (std::size_t j = 0; j < along.size(); ++j) {
    const SensitivityDirection& direction = along[j];
    if (!direction.parameters.size() && !direction.q.size() && !direction.v.size()) continue;
    // As where an unknown of the start is so large that a step beside it is none.
    if (!direction.parameters.allFinite() || !direction.q.allFinite() || !direction.v.allFinite())
      throw ImpossibleValue("the start has no derivative by one of its unknowns there");
    index_of.push_back(j);
    directions.push_back({or_zero(direction.parameters, model.parameters()),
                          or_zero(direction.q, model.coordinates()),
                          or_zero(direction.v, model.coordinates()),
                          VectorXd::Zero(model.states())});
  }
  std::vector<SensitivityDirection> moving;
  std::vector<std::optional<std::size_t>> moving_of(directions.size());  // of each direction
  for (std::size_t s = 0; s < directions.size(); ++s) {
    if (motion_stays(model, directions[s])) continue;
    moving_of[s] = moving.size();
    moving.push_back(directions[s]);
  }
  SensitiveSimulation simulation;
  if (moving.empty())
    static_cast<Simulation&>(simulation) =
        simulate(model, parameters, initial, clock.times, options, experiment.signals);
  else
    simulation = simulate_with_sensitivities(model, parameters, initial, moving, clock.times,
                                             options, experiment.signals);
  Prediction prediction;
  prediction.status = simulation.status;
  prediction.message = simulation.message;
  prediction.simulated = Eigen::MatrixXd::Constant(channels, frames, kNotGiven);
  if (simulation.status != Status::kSuccess) return prediction;
  const Trajectory still = unchanged(simulation.trajectory);
  const auto sensitivity = [&](std::size_t s) -> const Trajectory& {
    return moving_of[s] ? simulation.sensitivity[*moving_of[s]] : still;
  };

  prediction.sensitivity.resize(along.size());
  for (const std::size_t j : index_of) prediction.sensitivity[j].resize(channels, frames);
  Observer observer(model, experiment, parameters, directions);
  for (Index k = 0; k < frames; ++k) {
    const auto frame = static_cast<std::size_t>(k);
    observer.move_to(simulation.trajectory, clock.column[frame], recording.time[frame]);
    for (Index c = 0; c < channels; ++c)
      prediction.simulated(c, k) = observer(recording.channels[static_cast<std::size_t>(c)]);
    for (std::size_t s = 0; s < directions.size(); ++s) {
      observer.look_along(sensitivity(s), s, clock.held[frame]);
      for (Index c = 0; c < channels; ++c)
        prediction.sensitivity[index_of[s]](c, k) =
            observer(recording.channels[static_cast<std::size_t>(c)]);
    }
  }
  if (experiment.spec.joined) {
    const Index end = last_column(experiment, clock);
    prediction.first = state_in(simulation.trajectory, 0);
    prediction.last = state_in(simulation.trajectory, end);
    prediction.first_along.setZero(prediction.first.size(), static_cast<Index>(along.size()));
    prediction.last_along = prediction.first_along;
    for (std::size_t s = 0; s < directions.size(); ++s) {
      const auto j = static_cast<Index>(index_of[s]);
      prediction.first_along.col(j) = state_in(sensitivity(s), 0);
      prediction.last_along.col(j) = state_in(sensitivity(s), end);
    }
  }
  refuse_what_is_not_finite(prediction, experiment);
  prediction.trajectory = std::move(simulation.trajectory);
  return prediction;
}

}  // namespace catena
