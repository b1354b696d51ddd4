// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/unknowns.hpp"

#include <algorithm>
#include <limits>

namespace catena {

Unknowns::Unknowns(const Case& the_case, const ParameterMap& map,
                   const std::vector<Experiment>& experiments) {
  given_.push_back({catena::case_values(the_case), the_case.initial});
  for (const Experiment& experiment : experiments)
    given_.push_back({catena::case_values(the_case, experiment.spec.name), experiment.initial});
  add_parameters(the_case, map, experiments);
  order(the_case.parameters);
  for (std::size_t e = 0; e < experiments.size(); ++e)
    add_coefficients(experiments[e], static_cast<int>(e));
}

void Unknowns::add_parameters(const Case& the_case, const ParameterMap& map,
                              const std::vector<Experiment>& experiments) {
  for (std::size_t j = 0; j < the_case.parameters.size(); ++j) {
    const ParameterSpec& spec = the_case.parameters[j];
    if (!spec.free) continue;
    Unknown unknown{spec.name, spec.unit, spec.value, spec.lower, spec.upper, spec.scale};
    const ParameterMap::Range admitted = map.admitted(j);
    unknown.least = std::max(spec.lower, admitted.lower);
    unknown.most = std::min(spec.upper, admitted.upper);
    unknown.parameter = static_cast<int>(j);
    if (!spec.per_experiment) {
      list_.push_back(unknown);
      continue;
    }
    unknown.group = Unknown::Group::kSensor;
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      if (!experiments[e].fitted()) continue;
      unknown.experiment = static_cast<int>(e);
      unknown.name = experiments[e].spec.name + ": " + spec.name;
      unknown.start = given(unknown.experiment).values[static_cast<Eigen::Index>(j)];
      list_.push_back(unknown);
    }
  }
}

void Unknowns::order(const std::vector<ParameterSpec>& parameters) {
  const auto unknown_of = [&](const ParameterSpec& spec) {
    return std::find_if(list_.begin(), list_.end(),
                        [&](const Unknown& unknown) { return unknown.name == spec.name; });
  };
  for (const ParameterSpec& lesser : parameters)
    for (const ParameterSpec& greater : parameters) {
      if (lesser.at_most.empty() || lesser.at_most != greater.name) continue;
      const auto less = unknown_of(lesser), more = unknown_of(greater);
      if (less != list_.end() && more != list_.end())
        less->at_most = static_cast<int>(more - list_.begin());
      else if (less != list_.end())
        less->most = std::min(less->most, greater.value);
      else if (more != list_.end())
        more->least = std::max(more->least, lesser.value);
    }
}

void Unknowns::add_coefficients(const Experiment& experiment, int index) {
  if (!experiment.fitted()) return;  // no data may move its start: it comes from the first frames
  std::size_t offset = 0;
  const auto add = [&](const std::vector<double>& values, const char* what, const char* unit,
                       bool free) {
    for (std::size_t k = 0; free && k < values.size(); ++k) {
      constexpr double infinity = std::numeric_limits<double>::infinity();
      Unknown unknown{experiment.spec.name + ": " + what + " " + std::to_string(k + 1),
                      unit,
                      values[k],
                      -infinity,
                      infinity,
                      Scale::kLinear,
                      -infinity,
                      infinity};
      unknown.group = Unknown::Group::kInitial;
      unknown.experiment = index;
      unknown.coefficient = static_cast<int>(offset + k);
      list_.push_back(std::move(unknown));
    }
    offset += values.size();
  };
  const InitialSpec& initial = experiment.initial;
  const bool velocity_free = !initial.at_rest && initial.velocity_free;
  add(initial.coefficients, "angle", "rad", initial.free);
  add(initial.out_of_plane, "angle out of plane", "rad", initial.free);
  add(initial.velocity_coefficients, "rate", "rad/s", velocity_free);
  add(initial.out_of_plane_rates, "rate out of plane", "rad/s", velocity_free);
}

Eigen::VectorXd Unknowns::start() const {
  Eigen::VectorXd x(static_cast<Eigen::Index>(list_.size()));
  for (std::size_t j = 0; j < list_.size(); ++j) x[static_cast<Eigen::Index>(j)] = list_[j].start;
  return x;
}

Eigen::VectorXd Unknowns::case_values(const Eigen::VectorXd& x, int experiment) const {
  Eigen::VectorXd values = given(experiment).values;
  for (std::size_t j = 0; j < list_.size(); ++j) {
    const Unknown& unknown = list_[j];
    if (unknown.parameter >= 0 && (unknown.experiment < 0 || unknown.experiment == experiment))
      values[unknown.parameter] = x[static_cast<Eigen::Index>(j)];
  }
  return values;
}

InitialSpec Unknowns::initial(const Eigen::VectorXd& x, int experiment) const {
  InitialSpec initial = given(experiment).initial;
  for (std::size_t j = 0; j < list_.size(); ++j) {
    const Unknown& unknown = list_[j];
    if (unknown.coefficient < 0 || unknown.experiment != experiment) continue;
    auto k = static_cast<std::size_t>(unknown.coefficient);
    for (std::vector<double>* list : initial.coefficient_lists()) {
      if (k < list->size()) {
        (*list)[k] = x[static_cast<Eigen::Index>(j)];
        break;
      }
      k -= list->size();
    }
  }
  return initial;
}

}  // namespace catena
