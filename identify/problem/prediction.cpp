// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/prediction.hpp"

#include <algorithm>
#include <array>

#include "runtime/positions.hpp"
#include "runtime/sensitivity.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// Where a point is on the chain. Material points keep their place when the cable bends; those
/// given by arc length also move along a link whose length changes.
struct Place {
  MaterialPoint point;
  bool at_arc_length = false;
  bool load = false;
};

Place place_of(const Model& model, const VectorXd& parameters, const PointSpec& point) {
  if (point.load) return {{model.links() - 1, 1.0}, false, true};
  if (point.joint) return {{point.joint - 1, 1.0}, false, false};
  if (point.link) return {{point.link - 1, 0.0}, false, false};
  return {point_at_arc_length(model, parameters, point.arc_length), true, false};
}

/// Model times of the frames, where each is in the list of distinct, increasing times that is
/// simulated, and whether the cable is still held then.
struct Clock {
  std::vector<double> times;  // to simulate; the first is the start
  std::vector<Index> column;  // of each frame
  std::vector<bool> held;
};

Clock clock_of(const Model& model, const Experiment& experiment, const VectorXd& parameters,
               Index frames) {
  const double start = experiment.spec.start;
  std::vector<double> tau(static_cast<std::size_t>(frames));
  for (std::size_t k = 0; k < tau.size(); ++k) {
    const double t = experiment.recording.time[k];
    tau[k] = model.table().observes ? model.clock(t, parameters.data()) : t;
  }
  Clock clock;
  clock.times = {start};
  for (const double t : tau)
    if (t > start) clock.times.push_back(t);
  if (experiment.meets >= 0) clock.times.push_back(experiment.ends);
  std::sort(clock.times.begin(), clock.times.end());
  clock.times.erase(std::unique(clock.times.begin(), clock.times.end()), clock.times.end());
  for (const double t : tau) {
    clock.held.push_back(t < start);
    const auto found = std::lower_bound(clock.times.begin(), clock.times.end(), std::max(t, start));
    clock.column.push_back(found - clock.times.begin());
  }
  return clock;
}

VectorXd or_zero(const VectorXd& vector, Index size) {
  return vector.size() ? vector : VectorXd::Zero(size);
}

/// What a sensor tells of a point, or its derivative: side and down (m) and the angle of its link
/// (rad).
using Sight = std::array<double, 3>;

/// Reads a simulation as the sensors of one experiment do.
class Observer {
 public:
  /// `along`: the directions of which derivatives will be asked for.
  Observer(const Model& model, const Experiment& experiment, const VectorXd& parameters,
           const std::vector<SensitivityDirection>& along)
      : model_(model),
        experiment_(experiment),
        parameters_(parameters),
        directions_(along),
        accelerations_(VectorXd::Zero(model.coordinates())),
        signals_(VectorXd::Zero(3 * model.signals())),
        no_signals_(signals_),
        here_(sized(model)),
        rates_(here_),
        change_(here_) {
    for (const PointSpec& point : experiment.recording.points)
      places_.push_back(place_of(model, parameters, point));
    for (const SensitivityDirection& direction : directions_) {
      std::vector<double>& moved = moved_.emplace_back();
      for (const Place& place : places_)
        moved.push_back(place.at_arc_length
                            ? fraction_tangent(model, parameters, direction.parameters, place.point)
                            : 0);
    }
    true_.resize(places_.size());
    seen_.resize(places_.size());
  }

  /// Moves on to frame k, which is column `column` of the path.
  void move_to(const Trajectory& path, Index column, double t) {
    path_ = &path;
    column_ = column;
    t_ = t;
    experiment_.signals.evaluate(path.time[static_cast<std::size_t>(column)], signals_.data());
    const catena_point at = point(path, signals_, parameters_);
    model_.positions(at, here_.side.data(), here_.down.data());
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Place& place = places_[i];
      const CablePoint there = place.load ? load_of(here_) : position_of(here_, place.point);
      true_[i] = {there.side, there.down, path.q(place.point.link, column)};
      if (model_.table().observes)
        model_.observe(t_, parameters_.data(), true_[i].data(), seen_[i].data());
      else
        seen_[i] = true_[i];
    }
  }

  /// From there to the derivatives along direction number `direction`.
  void look_along(const Trajectory& sensitivity, std::size_t direction, bool held) {
    const VectorXd& by_parameter = directions_[direction].parameters;
    const catena_point at = point(*path_, signals_, parameters_);
    const catena_point along = point(sensitivity, no_signals_, by_parameter);
    model_.positions_tangent(at, along, change_.side.data(), change_.down.data());
    double clock_shift = 0;
    if (model_.table().observes && !held) {
      clock_shift = model_.clock_tangent(t_, parameters_.data(), by_parameter.data());
      model_.velocities(at, rates_.side.data(), rates_.down.data());
      change_.side += clock_shift * rates_.side;
      change_.down += clock_shift * rates_.down;
    }
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Place& place = places_[i];
      const CablePoint change =
          place.load ? load_of(change_)
                     : position_tangent_of(here_, change_, place.point, moved_[direction][i]);
      const Index link = place.point.link;
      const Sight din{change.side, change.down,
                      sensitivity.q(link, column_) + clock_shift * path_->v(link, column_)};
      if (model_.table().observes)
        model_.observe_tangent(t_, parameters_.data(), by_parameter.data(), true_[i].data(),
                               din.data(), seen_[i].data());
      else
        seen_[i] = din;
    }
  }

  /// What was seen last.
  double operator()(const Channel& channel) const {
    return seen_[static_cast<std::size_t>(channel.point)]
                [static_cast<std::size_t>(channel.component)];
  }

 private:
  static Positions sized(const Model& model) {
    return {VectorXd::Zero(model.links() + 2), VectorXd::Zero(model.links() + 2)};
  }

  static CablePoint load_of(const Positions& at) {
    return {at.side[at.side.size() - 1], at.down[at.down.size() - 1]};
  }

  catena_point point(const Trajectory& path, const VectorXd& signals, const VectorXd& p) const {
    return {path.time.empty() ? 0.0 : path_->time[static_cast<std::size_t>(column_)],
            path.q.col(column_).data(),
            path.v.col(column_).data(),
            accelerations_.data(),
            path.z.col(column_).data(),
            signals.data(),
            p.data()};
  }

  const Model& model_;
  const Experiment& experiment_;
  const VectorXd& parameters_;
  const std::vector<SensitivityDirection>& directions_;
  std::vector<Place> places_;
  std::vector<std::vector<double>> moved_;  // per direction and place: of points at an arc length
  VectorXd accelerations_, signals_, no_signals_;  // positions and velocities do not ask for a
  Positions here_, rates_, change_;
  std::vector<Sight> true_, seen_;  // per place
  const Trajectory* path_ = nullptr;
  Index column_ = 0;
  double t_ = 0;
};

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
                              const std::function<bool()>& keep_going) {
  const Recording& recording = experiment.recording;
  const auto channels = static_cast<Index>(recording.channels.size());
  const Index frames =
      all_frames ? static_cast<Index>(recording.time.size()) : recording.fit_frames;
  const Clock clock = clock_of(model, experiment, parameters, frames);

  SimulationOptions options = simulation_options(settings);
  options.energy = false;
  if (keep_going) options.keep_going = [&](double) { return keep_going(); };
  std::vector<SensitivityDirection> directions;
  std::vector<std::size_t> index_of;  // into `along`, of each that is not zero
  for (std::size_t j = 0; j < along.size(); ++j) {
    const SensitivityDirection& direction = along[j];
    if (!direction.parameters.size() && !direction.q.size() && !direction.v.size()) continue;
    index_of.push_back(j);
    directions.push_back({or_zero(direction.parameters, model.parameters()),
                          or_zero(direction.q, model.coordinates()),
                          or_zero(direction.v, model.coordinates()),
                          VectorXd::Zero(model.states())});
  }
  SensitiveSimulation simulation;
  if (directions.empty())
    static_cast<Simulation&>(simulation) =
        simulate(model, parameters, initial, clock.times, options, experiment.signals);
  else
    simulation = simulate_with_sensitivities(model, parameters, initial, directions, clock.times,
                                             options, experiment.signals);
  Prediction prediction;
  prediction.status = simulation.status;
  prediction.message = simulation.message;
  prediction.simulated = Eigen::MatrixXd::Constant(channels, frames, kNotGiven);
  if (simulation.status != Status::kSuccess) return prediction;

  prediction.sensitivity.resize(along.size());
  for (const std::size_t j : index_of) prediction.sensitivity[j].resize(channels, frames);
  Observer observer(model, experiment, parameters, directions);
  for (Index k = 0; k < frames; ++k) {
    const auto frame = static_cast<std::size_t>(k);
    observer.move_to(simulation.trajectory, clock.column[frame], recording.time[frame]);
    for (Index c = 0; c < channels; ++c)
      prediction.simulated(c, k) = observer(recording.channels[static_cast<std::size_t>(c)]);
    for (std::size_t s = 0; s < directions.size(); ++s) {
      observer.look_along(simulation.sensitivity[s], s, clock.held[frame]);
      for (Index c = 0; c < channels; ++c)
        prediction.sensitivity[index_of[s]](c, k) =
            observer(recording.channels[static_cast<std::size_t>(c)]);
    }
  }
  if (experiment.spec.joined) {
    const double ends = experiment.meets >= 0 ? experiment.ends : clock.times.back();
    const Index end =
        std::lower_bound(clock.times.begin(), clock.times.end(), ends) - clock.times.begin();
    const auto state = [](const Trajectory& path, Index column) {
      VectorXd out(2 * path.q.rows());
      out << path.q.col(column), path.v.col(column);
      return out;
    };
    prediction.first = state(simulation.trajectory, 0);
    prediction.last = state(simulation.trajectory, end);
    prediction.first_along.setZero(prediction.first.size(), static_cast<Index>(along.size()));
    prediction.last_along = prediction.first_along;
    for (std::size_t s = 0; s < directions.size(); ++s) {
      const auto j = static_cast<Index>(index_of[s]);
      prediction.first_along.col(j) = state(simulation.sensitivity[s], 0);
      prediction.last_along.col(j) = state(simulation.sensitivity[s], end);
    }
  }
  bool finite = prediction.simulated.allFinite();
  for (const auto& sensitivity : prediction.sensitivity) finite &= sensitivity.allFinite();
  if (!finite) {
    prediction.status = Status::kNotFinite;
    prediction.message = "what the sensors would see is not finite";
  }
  prediction.trajectory = std::move(simulation.trajectory);
  return prediction;
}

}  // namespace catena
