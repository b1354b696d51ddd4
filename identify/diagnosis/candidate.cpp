// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/candidate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "description/expression_syntax.hpp"
#include "identify/diagnosis/doubted_knowns.hpp"
#include "identify/diagnosis/score.hpp"
#include "identify/problem/marker_places.hpp"

namespace catena {
namespace {

/// "side" of "side_phase" and "side_amplitude"; the whole name if it has no underscore.
std::string_view stem(std::string_view name) { return name.substr(0, name.rfind('_')); }

ParameterRole role_of(const EffectParameter& parameter) {
  if (std::isfinite(parameter.neutral)) return ParameterRole::kAmplitude;
  if (std::isinf(parameter.neutral)) return ParameterRole::kLimit;
  const bool full_turn = parameter.unit == "rad" && parameter.lower < -3 && parameter.upper > 3;
  return full_turn ? ParameterRole::kPhase : ParameterRole::kShape;
}

/// Whether what acts on the chain is a function of time. Sensors do not act; a measured series has no
/// free frequency.
bool depends_on_time(const Effect& effect) {
  const auto in = [](const Expression& expression) {
    return names_in(expression).contains("time");
  };
  const auto in_any = [&](const auto& expressions) {
    return std::any_of(expressions.begin(), expressions.end(),
                       [&](const Expression* each) { return in(*each); });
  };
  return in_any(effect.support.all()) || in(effect.flow.side) || in(effect.flow.down) ||
         in(effect.flow.across) || in_any(effect.kinematics.all()) ||
         in_any(effect.held_end.all()) ||
         std::any_of(effect.definitions.begin(), effect.definitions.end(),
                     [&](const Definition& each) { return in(each.value); }) ||
         std::any_of(effect.scalars.begin(), effect.scalars.end(),
                     [&](const ScalarTerm& each) { return in(each.value); }) ||
         std::any_of(effect.states.begin(), effect.states.end(),
                     [&](const ExtraState& each) { return in(each.rate); }) ||
         std::any_of(effect.forces.begin(), effect.forces.end(), [&](const ForceTerm& each) {
           return in(each.side) || in(each.down) || in(each.across) || in(each.normal) ||
                  in(each.tangential);
         });
}

}  // namespace

bool belongs_to(const std::string& parameter, const std::string& id) {
  return parameter == id || parameter.starts_with(id + ".");
}

Candidate candidate_of(Effect effect) {
  Candidate candidate;
  candidate.id = effect.id;
  candidate.title = effect.title;
  candidate.sensor = effect.sensor.given();
  candidate.own_model = !effect.coordinates.empty() || !effect.states.empty();
  candidate.driven = depends_on_time(effect);
  for (const EffectParameter& parameter : effect.parameters) {
    CandidateParameter entry;
    entry.name = effect.id + "." + parameter.name;
    entry.unit = parameter.unit;
    entry.description = parameter.description;
    entry.lower = parameter.lower;
    entry.upper = parameter.upper;
    entry.role = role_of(parameter);
    entry.neutral = parameter.neutral;
    constexpr double kNearlyTheLimit = 1e6;
    entry.value = entry.role == ParameterRole::kAmplitude ? parameter.neutral
                  : entry.role == ParameterRole::kLimit   ? kNearlyTheLimit
                                                          : parameter.default_value;
    candidate.parameters.push_back(entry);
  }
  for (std::size_t i = 0; i < candidate.parameters.size(); ++i) {
    if (candidate.parameters[i].role != ParameterRole::kPhase) continue;
    const auto amplitudes = candidate.with_role(ParameterRole::kAmplitude);
    for (const int j : amplitudes)
      if (amplitudes.size() == 1 || stem(effect.parameters[i].name) ==
                                        stem(effect.parameters[static_cast<std::size_t>(j)].name))
        candidate.parameters[i].amplitude = j;
    if (candidate.parameters[i].amplitude < 0) candidate.parameters[i].role = ParameterRole::kShape;
  }
  for (std::size_t i = 0; i < candidate.parameters.size(); ++i)
    for (std::size_t j = 0; j < candidate.parameters.size(); ++j)
      if (effect.parameters[j].name == effect.parameters[i].at_most)
        candidate.parameters[i].at_most = static_cast<int>(j);
  if (!effect.signals.empty())
    candidate.unavailable = "needs a measured series as its input";
  else if (candidate.with_role(ParameterRole::kAmplitude).empty() &&
           candidate.with_role(ParameterRole::kLimit).empty())
    candidate.unavailable = "no parameter has a value at which it vanishes";
  const std::size_t columns = candidate.with_role(ParameterRole::kAmplitude).size() *
                              (candidate.with_role(ParameterRole::kPhase).empty() ? 1 : 2);
  if (columns > kMostBoundedColumns)
    candidate.unavailable = "has more amplitudes than can be scored together";
  candidate.effect = std::move(effect);
  return candidate;
}

std::vector<int> Candidate::with_role(ParameterRole role) const {
  std::vector<int> found;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].role == role) found.push_back(static_cast<int>(i));
  return found;
}

namespace {

bool has(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

bool has_data_of_kind(const Case& the_case, DataKind kind) {
  return std::any_of(the_case.experiments.begin(), the_case.experiments.end(),
                     [&](const ExperimentSpec& experiment) { return experiment.kind == kind; });
}

/// Whether the case says that these bodies weigh nothing.
struct Weightless {
  bool links = false, load = false;
};

Weightless weightless(const Case& the_case) {
  const CableGeometry& cable = the_case.cable;
  const auto unknown = [&](const std::string& family) {
    return std::any_of(the_case.parameters.begin(), the_case.parameters.end(),
                       [&](const ParameterSpec& spec) { return spec.sets.starts_with(family); });
  };
  const auto zero = [](double mass) { return mass == 0; };
  const bool no_link = cable.link_masses.empty()
                           ? cable.density == 0
                           : std::all_of(cable.link_masses.begin(), cable.link_masses.end(), zero);
  return {no_link && !unknown("mass") && !unknown("cable.density"),
          cable.load_mass == 0 && !unknown("load_mass") && !unknown("cable.load_mass")};
}

/// Whether all that an effect does, it does to bodies that weigh nothing.
bool acts_on_nothing(const Effect& effect, const Weightless& bodies) {
  const auto on_nothing = [&](const auto& term) {
    const bool on_link = term.at == Place::kLink || term.at == Place::kLinkCentre;
    return on_link ? bodies.links : term.at == Place::kLoad && bodies.load;
  };
  return effect.forces.size() + effect.scalars.size() > 0 &&
         std::all_of(effect.forces.begin(), effect.forces.end(), on_nothing) &&
         std::all_of(effect.scalars.begin(), effect.scalars.end(), on_nothing);
}

/// Why an effect cannot be there in this case; empty: it can.
std::string why_impossible(const Effect& effect, Space space, const Case& the_case) {
  const DiagnosisSpec& spec = the_case.diagnosis;
  if (const std::string why = why_not_in(space, effect); !why.empty()) return why;
  if (effect.held_end.holds())
    return "it holds the cable at all values of its parameters; have it in the model";
  if (has(spec.impossible, effect.id)) return "the case says that it is impossible";
  if (effect.rare && !has(spec.possible, effect.id))
    return "rare; tried where the case has it in diagnosis.possible";
  if (acts_on_nothing(effect, weightless(the_case)))
    return "acts on a body to which the case gives no mass";
  const Sensor& sensor = effect.sensor;
  const bool of_camera = sensor.moves();
  if (of_camera && !has_data_of_kind(the_case, DataKind::kMarkers))
    return "a camera would report it; the data are angles";
  if (sensor.angle.given() && !of_camera && !has_data_of_kind(the_case, DataKind::kAngles))
    return "an encoder would report it; the data are markers";
  return "";
}

void check_known(const std::vector<std::string>& ids, const char* key, const Case& the_case,
                 const std::vector<std::string>& known) {
  for (const std::string& id : ids)
    if (!has(known, id))
      throw InputError(the_case.file.string() + ": diagnosis." + key + ": " + in_quotes(id) +
                       " is no effect" + suggestion(id, known));
}

}  // namespace

std::vector<Candidate> library_of_candidates(const std::vector<std::filesystem::path>& files,
                                             const Description& present, const Case& the_case) {
  std::vector<Candidate> library;
  std::vector<std::string> known = built_in_effect_ids();
  const auto add = [&](Effect effect) {
    for (const Effect& other : present.effects)
      if (other.id == effect.id) return;
    // A file of the user's own comes before the built-in effect of the same name.
    std::erase_if(library, [&](const Candidate& known) { return known.id == effect.id; });
    const std::string reason = why_impossible(effect, present.space, the_case);
    library.push_back(candidate_of(std::move(effect)));
    if (!reason.empty()) library.back().unavailable = reason;
  };
  for (const std::string& id : built_in_effect_ids()) add(built_in_effect(id));
  for (const auto& file : files) {
    Effect effect = read_effect(file);
    known.push_back(effect.id);
    add(std::move(effect));
  }
  for (const Effect& effect : present.effects) known.push_back(effect.id);
  for (const char* id : {kMarkerPlaces, kCableKnowns}) known.emplace_back(id);
  check_known(the_case.diagnosis.possible, "possible", the_case, known);
  check_known(the_case.diagnosis.impossible, "impossible", the_case, known);
  std::sort(library.begin(), library.end(),
            [](const Candidate& a, const Candidate& b) { return a.id < b.id; });
  return library;
}

std::vector<Eigen::VectorXd> shape_grid(const Candidate& candidate,
                                        const std::vector<double>& frequencies) {
  std::vector<Eigen::VectorXd> grid = {Eigen::VectorXd(0)};
  for (const int index : candidate.with_role(ParameterRole::kShape)) {
    const CandidateParameter& parameter = candidate.parameters[static_cast<std::size_t>(index)];
    std::vector<double> values;
    if (parameter.unit == "Hz") {
      values = frequencies;
    } else if (parameter.lower < 0 && parameter.upper > 0) {
      for (const double share : {1.0 / 60, 1.0 / 20, 1.0 / 6}) {
        values.push_back(share * parameter.upper);
        values.push_back(share * parameter.lower);
      }
    } else {
      for (const double factor : {0.25, 1.0, 4.0}) values.push_back(factor * parameter.value);
    }
    std::erase_if(values, [&](double value) {
      return !std::isfinite(value) || value < parameter.lower || value > parameter.upper;
    });
    if (values.empty()) values.push_back(parameter.value);
    std::vector<Eigen::VectorXd> finer;
    for (const Eigen::VectorXd& point : grid)
      for (const double value : values) {
        finer.emplace_back(point.size() + 1);
        finer.back() << point, value;
      }
    grid = std::move(finer);
  }
  return grid;
}

}  // namespace catena
