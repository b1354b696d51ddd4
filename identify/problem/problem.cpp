// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/problem.hpp"

#include <algorithm>
#include <cmath>

#include "common/impossible_value.hpp"
#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/number_text.hpp"
#include "identify/problem/camera.hpp"
#include "identify/problem/initial_state.hpp"
#include "identify/problem/marker_places.hpp"
#include "identify/problem/plausibility.hpp"
#include "runtime/clamp_direction.hpp"

namespace catena {
namespace {

ParameterMap checked_map(const Case& the_case, const Model& model) {
  ParameterMap map(the_case, model);
  map.check_values(the_case, model);
  return map;
}

/// What a case says has to be of the plane or of space, as its model is.
Model fitting_model(const Case& the_case, Model model) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(the_case.file.string() + ": " + problem);
  };
  const auto check = [&](const InitialSpec& initial) {
    if (!model.in_space() && !(initial.azimuths.empty() && initial.azimuth_rates.empty()))
      refuse(
          "initial: azimuth: the model moves in the plane; leave it out, or give a model with "
          "space = \"3d\"");
    if (!model.in_space() && !(initial.out_of_plane.empty() && initial.out_of_plane_rates.empty()))
      refuse(
          "initial: out_of_plane: the model moves in the plane; leave it out, or give a model with "
          "space = \"3d\"");
  };
  check(the_case.initial);
  for (const ExperimentSpec& experiment : the_case.experiments) {
    if (experiment.initial) check(*experiment.initial);
    if (model.in_space() && experiment.joined)
      refuse("experiment: joined: " + in_quotes(experiment.name) +
             "; windows of a model in space cannot be joined; leave joined out: each window then "
             "has a start of its own");
  }
  return model;
}

/// Clamps have a direction at all these times.
void check_clamps(const Model& model, const Eigen::VectorXd& parameters, const Signals& signals,
                  const std::vector<double>& times, const std::string& where) {
  if (signals.count() < model.signals()) return;
  std::string table;
  const auto at = std::find_if(times.begin(), times.end(), [&](double t) {
    table = clamp_without_direction(model, parameters, t, signals);
    return !table.empty();
  });
  if (at == times.end()) return;
  throw InputError(where + ": clamp_side, clamp_down and clamp_across of " + table +
                   " are zero at t = " + number_text(*at) +
                   " s, and the clamp has no direction; change the parameters or signals that they "
                   "are made of");
}

}  // namespace

Problem::Problem(Case the_case, Model model, std::vector<Recording> recordings)
    : case_(std::move(the_case)),
      model_(
          fitting_model(case_, with_marker_places(case_, with_cameras(case_, std::move(model))))),
      map_(checked_map(case_, model_)),
      experiments_(experiments_of(case_, model_, map_, std::move(recordings))),
      unknowns_(case_, map_, experiments_) {
  for (const Experiment& experiment : experiments_) {
    const Eigen::VectorXd parameters = map_(case_values(case_, experiment.spec.name));
    check_clamps(model_, parameters, experiment.signals, experiment.recording.time,
                 experiment.spec.where);
    check_start(model_, parameters, experiment.initial, experiment.signals, experiment.spec.start,
                experiment.spec.where);
  }
  const InitialSpec& own = case_.initial;
  const bool given =
      own.shape == Shape::kCatenary || own.shape == Shape::kHanging || !own.coefficients.empty();
  if (experiments_.empty())
    check_clamps(model_, map_(case_values(case_)), Signals(), {0}, case_.file.string());
  if (experiments_.empty() && given)
    check_start(model_, map_(case_values(case_)), own, Signals(), 0, case_.file.string());
}

Problem::Problem(Case the_case, Model model, std::vector<Experiment> experiments)
    : case_(std::move(the_case)),
      model_(with_marker_places(case_, with_cameras(case_, std::move(model)))),
      map_(case_, model_),
      experiments_(std::move(experiments)),
      unknowns_(case_, map_, experiments_) {}

std::vector<std::string> Problem::warnings() const {
  std::vector<std::string> all;
  const auto add = [&](const std::string& name, const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) all.push_back(name + ": " + warning);
  };
  if (experiments_.empty())
    add(case_.file.string(),
        check_numbers(case_.cable, case_.initial,
                      link_lengths(model_, model_parameters(start(), -1)).sum()));
  for (const Experiment& experiment : experiments_)
    add(experiment.spec.name, experiment.recording.warnings);
  return all;
}

bool Problem::joined() const {
  for (const Experiment& experiment : experiments_)
    if (experiment.meets >= 0) return true;
  return false;
}

Eigen::VectorXd Problem::model_parameters(const Eigen::VectorXd& x, int experiment) const {
  return map_(unknowns_.case_values(x, experiment));
}

InitialSpec Problem::initial_of(const Eigen::VectorXd& x, int experiment) const {
  return unknowns_.initial(x, experiment);
}

State Problem::initial_state(const Eigen::VectorXd& x, int experiment) const {
  return state_of(experiment, initial_of(x, experiment), model_parameters(x, experiment));
}

State Problem::state_of(int experiment, const InitialSpec& initial,
                        const Eigen::VectorXd& parameters) const {
  if (experiment < 0) return state_at_start(model_, parameters, initial, Signals(), 0);
  return state_at_start(model_, parameters, initial, at(experiment).signals,
                        at(experiment).spec.start);
}

std::vector<SensitivityDirection> Problem::directions(const Eigen::VectorXd& x,
                                                      int experiment) const {
  const Eigen::VectorXd values = unknowns_.case_values(x, experiment);
  const Eigen::MatrixXd by_value = map_.jacobian(values);
  const InitialSpec initial = initial_of(x, experiment);
  const Eigen::VectorXd parameters = map_(values);
  std::vector<SensitivityDirection> directions(unknowns().size());
  for (std::size_t j = 0; j < unknowns().size(); ++j) {
    const Unknown& unknown = unknowns()[j];
    SensitivityDirection& direction = directions[j];
    if (unknown.experiment >= 0 && unknown.experiment != experiment) continue;
    if (unknown.parameter >= 0) {
      direction.parameters = by_value.col(unknown.parameter);
      // A catenary, a hanging shape and one between two ends follow from the parameters: central
      // differences.
      if (initial.shape == Shape::kCatenary || initial.shape == Shape::kHanging || model_.held()) {
        const double h = 1e-6 * (1 + std::abs(values[unknown.parameter])) *
                         (unknown.scale == Scale::kLogarithmic ? 1e-3 : 1);
        const State more = state_of(experiment, initial, parameters + h * direction.parameters);
        const State less = state_of(experiment, initial, parameters - h * direction.parameters);
        direction.q = (more.q - less.q) / (2 * h);
        direction.v = (more.v - less.v) / (2 * h);  // in space they turn with the directions
      }
      continue;
    }
    direction = start_along(model_, parameters, initial, at(experiment).signals,
                            at(experiment).spec.start, unknown.coefficient);
  }
  return directions;
}

Prediction Problem::predict(const Eigen::VectorXd& x, int experiment, bool all_frames,
                            const std::vector<SensitivityDirection>& along,
                            const std::function<bool(double)>& keep_going) const {
  try {
    const Eigen::VectorXd parameters = model_parameters(x, experiment);
    return predict_experiment(model_, case_.simulation, at(experiment), parameters,
                              state_of(experiment, initial_of(x, experiment), parameters),
                              all_frames, along, keep_going);
  } catch (const ImpossibleValue& error) {
    return failed_prediction(at(experiment), error.what());
  }
}

Case Problem::with(const Eigen::VectorXd& x) const {
  Case changed = case_;
  for (std::size_t j = 0; j < unknowns().size(); ++j) {
    const Unknown& unknown = unknowns()[j];
    if (unknown.parameter < 0) continue;
    ParameterSpec& parameter = changed.parameters[static_cast<std::size_t>(unknown.parameter)];
    (unknown.experiment < 0 ? parameter.value
                            : parameter.values[at(unknown.experiment).spec.name]) =
        x[static_cast<Eigen::Index>(j)];
  }
  if (experiments_.size() == changed.experiments.size())  // no windows: every start has its place
    for (std::size_t e = 0; e < experiments_.size(); ++e) {
      const InitialSpec initial = initial_of(x, static_cast<int>(e));
      if (initial.free || (!initial.at_rest && initial.velocity_free))
        changed.experiments[e].initial = initial;
    }
  return changed;
}

}  // namespace catena
