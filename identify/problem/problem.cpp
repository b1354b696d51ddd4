// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/problem.hpp"

#include <algorithm>
#include <cmath>

#include "common/input_error.hpp"
#include "common/number_text.hpp"
#include "common/toml_reader.hpp"
#include "identify/problem/prediction.hpp"
#include "runtime/rest_states.hpp"

namespace catena {
namespace {

double cable_length(const Case& the_case) {
  if (the_case.cable.link_lengths.empty()) return the_case.cable.length;
  double length = 0;
  for (const double link : the_case.cable.link_lengths) length += link;
  return length;
}

/// Frames first .. last - 1 of a recording.
Recording part_of(const Recording& whole, Eigen::Index first, Eigen::Index last, bool fitted) {
  Recording part;
  part.time.assign(whole.time.begin() + first, whole.time.begin() + last);
  part.points = whole.points;
  part.channels = whole.channels;
  part.measured = whole.measured.middleCols(first, last - first);
  part.fit_frames = fitted ? last - first : 0;
  return part;
}

/// Cuts an experiment into windows, each an experiment with a start of its own. A window with
/// frames beyond fit_until validates.
void cut_windows(const ExperimentSpec& spec, const Recording& whole, std::vector<Experiment>& out) {
  const auto frames = static_cast<Eigen::Index>(whole.time.size());
  const double begin = whole.time.front();
  Eigen::Index first = 0;
  while (first < frames) {
    const double number =
        std::floor((whole.time[static_cast<std::size_t>(first)] - begin) / spec.window + 1e-9);
    const double end = begin + (number + 1) * spec.window;
    Eigen::Index last = first;
    while (last < frames && whole.time[static_cast<std::size_t>(last)] < end - 1e-9) ++last;
    constexpr Eigen::Index kFewest = 8;  // too few frames say nothing beyond their own start
    if (last - first >= kFewest) {
      Experiment experiment;
      experiment.spec = spec;
      experiment.spec.window = kNotGiven;
      experiment.spec.from = whole.time[static_cast<std::size_t>(first)];
      experiment.spec.to = whole.time[static_cast<std::size_t>(last - 1)];
      experiment.spec.name = spec.name + " from " + shortest_number(experiment.spec.from) + " s";
      const bool fitted = last <= whole.fit_frames;
      if (!fitted) experiment.spec.use = Use::kValidate;
      experiment.recording = part_of(whole, first, last, fitted);
      out.push_back(std::move(experiment));
    }
    first = last;
  }
}

}  // namespace

Problem::Problem(Case the_case, Model model) : Problem(std::move(the_case), std::move(model), {}) {}

Problem::Problem(Case the_case, Model model, std::vector<Recording> recordings)
    : case_(std::move(the_case)), model_(std::move(model)), map_(case_, model_) {
  if (!recordings.empty() && recordings.size() != case_.experiments.size())
    throw std::invalid_argument("recordings: one per experiment of the case is wanted");
  for (std::size_t e = 0; e < case_.experiments.size(); ++e) {
    const ExperimentSpec& spec = case_.experiments[e];
    Recording recording = recordings.empty()
                              ? read_recording(spec, case_.links, cable_length(case_))
                              : std::move(recordings[e]);
    if (!std::isnan(spec.window)) {
      const std::size_t before = experiments_.size();
      cut_windows(spec, recording, experiments_);
      if (spec.joined) join(before);
    } else {
      experiments_.emplace_back();
      experiments_.back().spec = spec;
      experiments_.back().recording = std::move(recording);
    }
    for (auto window = experiments_.rbegin(); window != experiments_.rend() && window->source < 0;
         ++window)
      window->source = static_cast<int>(e);
  }
  prepare();
}

void Problem::join(std::size_t first) {
  const InitialSpec& initial = experiments_[first].spec.initial.value_or(case_.initial);
  const auto refuse = [&](const std::string& what) {
    throw InputError(experiments_[first].spec.where + ": joined: " + what);
  };
  if (case_.optimiser.method != FitMethod::kLeastSquares ||
      case_.error.measure != Measure::kLeastSquares)
    refuse("multiple shooting needs method and measure least_squares");
  if (!case_.optimiser.growing_windows.empty())
    refuse("and growing_windows; choose one of the two");
  if (!initial.free || initial.shape != Shape::kAngles || initial.at_rest ||
      !initial.velocity_free || initial.velocity_shape != Shape::kAngles)
    refuse(
        "every window needs a start of its own that can be any: initial with shape = \"angles\", "
        "free = true and velocity = { shape = \"angles\", free = true }");
  for (std::size_t e = first; e + 1 < experiments_.size(); ++e)
    if (experiments_[e].fitted() && experiments_[e + 1].fitted()) {
      experiments_[e].meets = static_cast<int>(e) + 1;
      experiments_[e].ends = experiments_[e + 1].recording.time.front();
    }
}

bool Problem::joined() const {
  for (const Experiment& experiment : experiments_)
    if (experiment.meets >= 0) return true;
  return false;
}

Problem Problem::with_defect_weight(double weight) const {
  Problem other = *this;
  other.defect_weight_ = weight;
  return other;
}

void Problem::prepare() {
  const Eigen::VectorXd parameters = map_(map_.values());
  const Eigen::VectorXd lengths =
      parameters.segment(model_.parameter_index("length_1"), case_.links);
  for (Experiment& experiment : experiments_) {
    experiment.initial = experiment.spec.initial.value_or(case_.initial);
    complete_from_data(experiment.initial, experiment.recording, lengths);
    if (std::isnan(experiment.spec.start))
      experiment.spec.start = experiment.recording.time.front();
    experiment.signals =
        read_signals(experiment.spec.signals.empty() ? case_.signals : experiment.spec.signals,
                     model_, experiment.spec.where);
  }
  for (int e = -1; e < static_cast<int>(experiments_.size()); ++e) check_start(e);
  const auto add = [&](Unknown unknown) { unknowns_.push_back(std::move(unknown)); };
  for (std::size_t j = 0; j < case_.parameters.size(); ++j) {
    const ParameterSpec& spec = case_.parameters[j];
    if (!spec.free) continue;
    Unknown unknown{spec.name, spec.unit, spec.value, spec.lower, spec.upper, spec.scale};
    unknown.parameter = static_cast<int>(j);
    if (!spec.per_experiment) {
      add(unknown);
      continue;
    }
    unknown.group = Unknown::Group::kSensor;
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
      if (!experiments_[e].fitted()) continue;
      unknown.experiment = static_cast<int>(e);
      unknown.name = experiments_[e].spec.name + ": " + spec.name;
      add(unknown);
    }
  }
  for (std::size_t e = 0; e < experiments_.size(); ++e) {
    const Experiment& experiment = experiments_[e];
    if (!experiment.fitted())
      continue;  // no data may move its start: it comes from the first frames
    const auto add_coefficients = [&](const std::vector<double>& values, const char* what,
                                      const char* unit, std::size_t offset) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        Unknown unknown;
        unknown.name = experiment.spec.name + ": " + what + " " + std::to_string(k + 1);
        unknown.unit = unit;
        unknown.start = values[k];
        unknown.lower = -std::numeric_limits<double>::infinity();
        unknown.upper = std::numeric_limits<double>::infinity();
        unknown.group = Unknown::Group::kInitial;
        unknown.experiment = static_cast<int>(e);
        unknown.coefficient = static_cast<int>(offset + k);
        add(unknown);
      }
    };
    const InitialSpec& initial = experiment.initial;
    if (initial.free) add_coefficients(initial.coefficients, "angle", "rad", 0);
    if (!initial.at_rest && initial.velocity_free)
      add_coefficients(initial.velocity_coefficients, "rate", "rad/s", initial.coefficients.size());
  }
}

void Problem::check_start(int experiment) const {
  const bool known = experiment >= 0;
  const InitialSpec& initial =
      known ? experiments_[static_cast<std::size_t>(experiment)].initial : case_.initial;
  const bool linear = initial.shape != Shape::kCatenary && initial.shape != Shape::kHanging;
  if (!known && (!experiments_.empty() || (linear && initial.coefficients.empty()))) return;
  const std::string where =
      known ? experiments_[static_cast<std::size_t>(experiment)].spec.where : case_.file.string();
  const Eigen::VectorXd parameters = map_(map_.values());
  State state;
  try {
    state = state_of(experiment, initial, parameters);
  } catch (const std::invalid_argument& error) {
    throw InputError(where + ": initial: " + error.what());
  }
  const Signals& signals =
      known ? experiments_[static_cast<std::size_t>(experiment)].signals : Signals();
  if (signals.count() < model_.signals()) return;
  Eigen::VectorXd acceleration(model_.coordinates()), signal_values(3 * model_.signals());
  const double time = known ? experiments_[static_cast<std::size_t>(experiment)].spec.start : 0;
  signals.evaluate(time, signal_values.data());
  const catena_point at{time,           state.q.data(),       state.v.data(),   acceleration.data(),
                        state.z.data(), signal_values.data(), parameters.data()};
  if (const int pivot = model_.acceleration(at, acceleration.data()))
    throw InputError(where + ": cable: the mass matrix is not positive definite (at " +
                     model_.table().coordinate[pivot - 1].name +
                     "); links without mass need a load or neighbours that have some");
}

Eigen::VectorXd Problem::start() const {
  Eigen::VectorXd x(static_cast<Eigen::Index>(unknowns_.size()));
  for (std::size_t j = 0; j < unknowns_.size(); ++j)
    x[static_cast<Eigen::Index>(j)] = unknowns_[j].start;
  return x;
}

Eigen::VectorXd Problem::parameter_values(const Eigen::VectorXd& x, int experiment) const {
  Eigen::VectorXd values = map_.values();
  for (std::size_t j = 0; j < unknowns_.size(); ++j) {
    const Unknown& unknown = unknowns_[j];
    if (unknown.parameter >= 0 && (unknown.experiment < 0 || unknown.experiment == experiment))
      values[unknown.parameter] = x[static_cast<Eigen::Index>(j)];
  }
  return values;
}

InitialSpec Problem::initial_of(const Eigen::VectorXd& x, int experiment) const {
  InitialSpec initial =
      experiment < 0 ? case_.initial : experiments_[static_cast<std::size_t>(experiment)].initial;
  const std::size_t angles = initial.coefficients.size();
  for (std::size_t j = 0; j < unknowns_.size(); ++j) {
    const Unknown& unknown = unknowns_[j];
    if (unknown.coefficient < 0 || unknown.experiment != experiment) continue;
    const auto k = static_cast<std::size_t>(unknown.coefficient);
    (k < angles ? initial.coefficients[k] : initial.velocity_coefficients[k - angles]) =
        x[static_cast<Eigen::Index>(j)];
  }
  return initial;
}

Eigen::VectorXd Problem::model_parameters(const Eigen::VectorXd& x, int experiment) const {
  return map_(parameter_values(x, experiment));
}

State Problem::initial_state(const Eigen::VectorXd& x, int experiment) const {
  return state_of(experiment, initial_of(x, experiment), model_parameters(x, experiment));
}

State Problem::state_of(int experiment, const InitialSpec& initial,
                        const Eigen::VectorXd& parameters) const {
  const Eigen::VectorXd lengths =
      parameters.segment(model_.parameter_index("length_1"), case_.links);
  State state = State::zero(model_);
  if (initial.shape == Shape::kCatenary) {
    state = catenary(model_, parameters, {initial.held[0], initial.held[1]},
                     initial.ends_at_held ? CatenaryFit::kEndHeld : CatenaryFit::kChords);
  } else if (initial.shape == Shape::kHanging) {
    const bool known = experiment >= 0;
    const Equilibrium equilibrium = hanging_equilibrium(
        model_, parameters,
        known ? experiments_[static_cast<std::size_t>(experiment)].spec.start : 0,
        known ? experiments_[static_cast<std::size_t>(experiment)].signals : Signals());
    if (equilibrium.status != Status::kSuccess)
      throw std::runtime_error("hanging equilibrium: " + equilibrium.message);
    state = equilibrium.state;
  } else {
    state.q.head(case_.links) = initial_angles(initial, lengths);
  }
  state.v.head(case_.links) = initial_rates(initial, lengths);
  return state;
}

std::vector<Seed> Problem::directions(const Eigen::VectorXd& x, int experiment) const {
  const Eigen::VectorXd values = parameter_values(x, experiment);
  const Eigen::MatrixXd by_value = map_.jacobian(values);
  const InitialSpec initial = initial_of(x, experiment);
  const Eigen::VectorXd parameters = map_(values);
  const Eigen::Index length_1 = model_.parameter_index("length_1");
  const Eigen::VectorXd lengths = parameters.segment(length_1, case_.links);
  const Eigen::Index n = case_.links;
  std::vector<Seed> directions(unknowns_.size());
  for (std::size_t j = 0; j < unknowns_.size(); ++j) {
    const Unknown& unknown = unknowns_[j];
    Seed& direction = directions[j];
    if (unknown.experiment >= 0 && unknown.experiment != experiment) continue;
    if (unknown.parameter >= 0) {
      direction.parameters = by_value.col(unknown.parameter);
      // A catenary and a hanging shape follow from the parameters: central differences.
      if (initial.shape == Shape::kCatenary || initial.shape == Shape::kHanging) {
        const double h = 1e-6 * (1 + std::abs(values[unknown.parameter])) *
                         (unknown.scale == Scale::kLogarithmic ? 1e-3 : 1);
        const auto moved_angles = [&](double step) {
          return state_of(experiment, initial, parameters + step * direction.parameters).q;
        };
        direction.q = (moved_angles(h) - moved_angles(-h)) / (2 * h);
      }
      continue;
    }
    const auto k = static_cast<Eigen::Index>(unknown.coefficient);
    const auto angles = static_cast<Eigen::Index>(initial.coefficients.size());
    const bool angle = k < angles;
    Eigen::VectorXd& moved = angle ? direction.q : direction.v;
    moved = Eigen::VectorXd::Zero(model_.coordinates());
    moved.head(n) =
        angle ? shape_basis(initial.shape, case_.links, initial.terms, lengths).col(k)
              : shape_basis(initial.velocity_shape, case_.links, initial.velocity_terms, lengths)
                    .col(k - angles);
  }
  return directions;
}

Prediction Problem::predict(const Eigen::VectorXd& x, int experiment, bool all_frames,
                            const std::vector<Seed>& along,
                            const std::function<bool()>& keep_going) const {
  const Experiment& chosen = experiments_[static_cast<std::size_t>(experiment)];
  try {
    const Eigen::VectorXd parameters = model_parameters(x, experiment);
    return predict_experiment(model_, case_.simulation, chosen, parameters,
                              state_of(experiment, initial_of(x, experiment), parameters),
                              all_frames, along, keep_going);
  } catch (const std::exception& error) {  // parameters or a start that cannot be
    Prediction failed;
    failed.status = Status::kNotFinite;
    failed.message = error.what();
    failed.simulated.setConstant(static_cast<Eigen::Index>(chosen.recording.channels.size()),
                                 static_cast<Eigen::Index>(chosen.recording.time.size()),
                                 kNotGiven);
    return failed;
  }
}

Case Problem::with(const Eigen::VectorXd& x) const {
  Case the_case = case_;
  for (std::size_t j = 0; j < unknowns_.size(); ++j)
    if (unknowns_[j].parameter >= 0 && unknowns_[j].experiment <= 0)
      the_case.parameters[static_cast<std::size_t>(unknowns_[j].parameter)].value =
          x[static_cast<Eigen::Index>(j)];
  if (experiments_.size() == the_case.experiments.size())  // no windows: every start has its place
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
      const InitialSpec initial = initial_of(x, static_cast<int>(e));
      if (initial.free || (!initial.at_rest && initial.velocity_free))
        the_case.experiments[e].initial = initial;
    }
  return the_case;
}

Problem Problem::shortened(double seconds) const {
  Problem shorter = *this;
  for (Experiment& experiment : shorter.experiments_) {
    const std::vector<double>& time = experiment.recording.time;
    const double end = experiment.spec.start + seconds + 1e-9;
    const auto seen = std::upper_bound(time.begin(), time.end(), end) - time.begin();
    experiment.recording.fit_frames =
        std::min<Eigen::Index>(experiment.recording.fit_frames, std::max<Eigen::Index>(seen, 2));
  }
  return shorter;
}

Problem Problem::with_tolerance(double tolerance) const {
  Problem other = *this;
  other.case_.optimiser.tolerance = tolerance;
  return other;
}

namespace {

constexpr double kRoughTolerance = 1e-4;         // of simulations
constexpr double kRoughlyThere = 1e-2;           // of the optimiser
constexpr Eigen::Index kRoughFrames = 100;       // are kept of an experiment that has more,
constexpr Eigen::Index kValuesPerUnknown = 100;  // and at least so many numbers of all

}  // namespace

bool Problem::finer_than_rough() const {
  return case_.simulation.relative_tolerance <= kRoughTolerance / 10 &&
         case_.optimiser.tolerance < kRoughlyThere;
}

Problem Problem::rough() const {
  Problem other = with_tolerance(std::max(kRoughlyThere, case_.optimiser.tolerance));
  SimulationSpec& simulation = other.case_.simulation;
  const double coarser = std::max(1.0, kRoughTolerance / simulation.relative_tolerance);
  simulation.relative_tolerance *= coarser;
  simulation.absolute_tolerance_position *= coarser;
  simulation.absolute_tolerance_velocity *= coarser;
  Eigen::Index values = 0;
  for (const Experiment& experiment : experiments_)
    if (experiment.fitted())
      values += experiment.recording.fit_frames *
                static_cast<Eigen::Index>(experiment.recording.channels.size());
  const Eigen::Index enough = kValuesPerUnknown * static_cast<Eigen::Index>(unknowns_.size());
  for (Experiment& experiment : other.experiments_) {
    if (!experiment.fitted()) continue;
    Recording& recording = experiment.recording;
    const Eigen::Index every =
        std::min(recording.fit_frames / kRoughFrames, values / std::max<Eigen::Index>(enough, 1));
    if (every < 2) continue;
    const Eigen::Index kept = (recording.fit_frames + every - 1) / every;
    for (Eigen::Index k = 0; k < kept; ++k) {
      recording.time[static_cast<std::size_t>(k)] =
          recording.time[static_cast<std::size_t>(every * k)];
      recording.measured.col(k) = recording.measured.col(every * k).eval();
    }
    recording.time.resize(static_cast<std::size_t>(kept));
    recording.measured.conservativeResize(Eigen::NoChange, kept);
    recording.fit_frames = kept;
  }
  return other;
}

Problem Problem::alone(const Eigen::VectorXd& x, int experiment) const {
  const Experiment& chosen = experiments_[static_cast<std::size_t>(experiment)];
  Case the_case = case_;
  const Eigen::VectorXd values = parameter_values(x, experiment);
  for (std::size_t j = 0; j < the_case.parameters.size(); ++j) {
    the_case.parameters[j].value = values[static_cast<Eigen::Index>(j)];
    the_case.parameters[j].free = false;
  }
  the_case.optimiser.growing_windows.clear();
  the_case.experiments = {chosen.spec};
  ExperimentSpec& spec = the_case.experiments.front();
  spec.use = Use::kFit;
  spec.initial = initial_of(x, experiment);
  Recording recording = chosen.recording;
  recording.fit_frames = static_cast<Eigen::Index>(recording.time.size());
  return Problem(std::move(the_case), model_, {std::move(recording)});
}

Problem Problem::started(const std::map<int, InitialSpec>& starts) const {
  Problem other = *this;
  for (const auto& [experiment, initial] : starts)
    other.experiments_[static_cast<std::size_t>(experiment)].initial = initial;
  return other;
}

Problem Problem::fixed(int unknown, double value) const {
  Problem other = *this;
  const int parameter = unknowns_[static_cast<std::size_t>(unknown)].parameter;
  if (parameter < 0 || unknowns_[static_cast<std::size_t>(unknown)].experiment >= 0)
    throw std::invalid_argument("only an unknown of the physics can be fixed");
  other.map_.set_value(parameter, value);
  other.case_.parameters[static_cast<std::size_t>(parameter)].value = value;
  other.case_.parameters[static_cast<std::size_t>(parameter)].free = false;
  other.unknowns_.erase(other.unknowns_.begin() + unknown);
  return other;
}

Problem Problem::measured_as(const std::vector<Eigen::MatrixXd>& measured) const {
  Problem other = *this;
  for (std::size_t e = 0; e < measured.size(); ++e)
    other.experiments_[e].recording.measured = measured[e];
  return other;
}

Evaluation evaluate(const Problem& problem, const Eigen::VectorXd& x, bool all, bool jacobian,
                    const std::function<bool()>& keep_going) {
  Evaluation evaluation;
  evaluation.with_jacobian = jacobian;
  evaluation.ok = true;
  evaluation.predictions.resize(problem.experiments().size());
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const Experiment& experiment = problem.experiments()[e];
    if (!all && !experiment.fitted()) continue;
    const int index = static_cast<int>(e);
    Prediction& prediction = evaluation.predictions[e];
    prediction = problem.predict(
        x, index, all, jacobian ? problem.directions(x, index) : std::vector<Seed>{}, keep_going);
    if (prediction.ok()) continue;
    evaluation.ok = false;
    evaluation.message = experiment.spec.name + ": " + prediction.message;
    if (!all) break;
  }
  return evaluation;
}

}  // namespace catena
