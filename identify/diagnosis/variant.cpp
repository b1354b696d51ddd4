// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/variant.hpp"

#include <charconv>
#include <cmath>

#include "identify/problem/marker_places.hpp"

namespace catena {
namespace {

/// "stiffness", "stiffness_3" or "stiffness_2..12" taken apart.
struct JointFamily {
  std::string family;
  int first = 0, last = 0;  // 0: all
};

std::optional<JointFamily> joint_family(const std::string& sets) {
  for (const std::string family : {"stiffness", "damping"}) {
    if (sets == family) return JointFamily{family};
    if (!sets.starts_with(family + "_")) continue;
    JointFamily result{family};
    const char* at = sets.data() + family.size() + 1;
    const char* end = sets.data() + sets.size();
    auto parsed = std::from_chars(at, end, result.first);
    if (parsed.ec != std::errc()) return std::nullopt;  // "damping_length"
    result.last = result.first;
    if (parsed.ptr != end) {
      if (!std::string_view(parsed.ptr, end).starts_with("..")) return std::nullopt;
      parsed = std::from_chars(parsed.ptr + 2, end, result.last);
      if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
    }
    return result;
  }
  return std::nullopt;
}

bool names_one_link(const std::string& sets) {
  if (sets.starts_with(marker_place_of(""))) return false;  // markers have names, too
  for (const char* family : {"length", "mass", "inertia", "torque"})
    if (sets == family || sets.starts_with(std::string(family) + "_")) return true;
  // an effect's parameter of one joint or link: "effect.name_3"
  const std::size_t dot = sets.find('.'), bar = sets.rfind('_');
  return dot != std::string::npos && bar != std::string::npos && bar > dot &&
         bar + 1 < sets.size() && std::isdigit(static_cast<unsigned char>(sets[bar + 1]));
}

void free_start(InitialSpec& initial, int more_terms, int rate_terms) {
  if (initial.shape == Shape::kStraight) {  // the first of the polynomials
    initial.shape = Shape::kSmooth;
    initial.terms = 1;
  }
  initial.terms += more_terms;
  initial.coefficients.resize(
      initial.coefficients.empty() ? 0 : static_cast<std::size_t>(initial.terms));
  initial.free = true;
  if (rate_terms == 0) return;
  if (initial.at_rest) {
    initial.velocity_shape = Shape::kSmooth;
    initial.velocity_terms = rate_terms;
    initial.velocity_coefficients.assign(static_cast<std::size_t>(rate_terms), 0.0);
  }
  initial.at_rest = false;
  initial.velocity_free = true;
}

/// What a problem takes the start's coefficient to be that is an unknown of another one with the same
/// experiments; zero where its start has none.
double known_start(const Problem& from, const Unknown& unknown, const Problem& to) {
  const auto e = static_cast<std::size_t>(unknown.experiment);
  InitialSpec freer = to.experiments()[e].initial, known = from.experiments()[e].initial;
  auto k = static_cast<std::size_t>(unknown.coefficient);
  const auto lists = freer.coefficient_lists(), values = known.coefficient_lists();
  std::size_t list = 0;
  for (; k >= lists[list]->size(); ++list) k -= lists[list]->size();
  return k < values[list]->size() ? (*values[list])[k] : 0;
}

bool polynomial(const InitialSpec& initial) {
  return initial.shape == Shape::kSmooth || initial.shape == Shape::kStraight;
}

}  // namespace

Case with_effects(const Case& the_case, const std::vector<Candidate>& candidates, bool shapes) {
  Case result = the_case;
  for (const Candidate& candidate : candidates) {
    for (const CandidateParameter& parameter : candidate.parameters) {
      ParameterSpec spec;
      spec.name = spec.sets = parameter.name;
      spec.unit = parameter.unit;
      spec.value = parameter.value;
      spec.lower = parameter.lower;
      spec.upper = parameter.upper;
      spec.free = parameter.role == ParameterRole::kAmplitude ||
                  parameter.role == ParameterRole::kLimit || shapes;
      spec.where = "effect " + candidate.id;
      if (!std::isnan(parameter.deviation)) {
        spec.measured = parameter.neutral;
        spec.standard_deviation = parameter.deviation;
      }
      if (parameter.at_most >= 0)
        spec.at_most = candidate.parameters[static_cast<std::size_t>(parameter.at_most)].name;
      if (parameter.role == ParameterRole::kLimit) spec.scale = Scale::kLogarithmic;
      result.parameters.push_back(spec);
    }
  }
  return result;
}

Case without_effect(const Case& the_case, const std::string& id) {
  Case result = the_case;
  std::erase_if(result.parameters,
                [&](const ParameterSpec& spec) { return belongs_to(spec.sets, id); });
  return result;
}

std::optional<Case> with_links(const Case& the_case, int links, std::string& why_not) {
  const auto refuse = [&](const std::string& reason) -> std::optional<Case> {
    why_not = reason;
    return std::nullopt;
  };
  if (!the_case.cable.link_lengths.empty() || !the_case.cable.link_masses.empty() ||
      !the_case.cable.link_inertias.empty())
    return refuse("the links are real parts, given one by one");
  const double ratio = static_cast<double>(links) / the_case.links;
  // Joint i of the case is joint (i - 1) ratio + 1 of the other chain, if there is one.
  const auto whole = [&](int joint) {
    const double place = (joint - 1) * ratio;
    return std::abs(place - std::round(place)) < 1e-9;
  };
  const auto joint_of = [&](int joint) {
    return static_cast<int>(std::lround((joint - 1) * ratio)) + 1;
  };
  Case result = the_case;
  result.links = links;
  for (ParameterSpec& parameter : result.parameters) {
    if (names_one_link(parameter.sets))
      return refuse("parameter " + parameter.name + " belongs to single links");
    const auto family = joint_family(parameter.sets);
    if (!family) continue;
    parameter.factor *= ratio;  // stiffness and damping of a joint go with 1 / spacing
    if (family->first == 0) continue;
    if ((family->first > 2 && !whole(family->first)) ||
        (family->last != 1 && !whole(family->last + 1)))
      return refuse("parameter " + parameter.name + " belongs to joints that chain has not");
    const int first = family->first <= 2 ? family->first : joint_of(family->first);
    const int last = family->last == 1 ? 1 : joint_of(family->last + 1) - 1;
    parameter.sets = family->family + "_" + std::to_string(first);
    if (last > first) parameter.sets += ".." + std::to_string(last);
  }
  const auto refit_start = [](InitialSpec& initial, int old_links) {
    if (initial.shape == Shape::kAngles) {
      initial.shape = Shape::kSmooth;
      initial.terms = std::min(old_links, 8);
      initial.coefficients.clear();
    }
    if (initial.velocity_shape == Shape::kAngles) {
      initial.velocity_shape = Shape::kSmooth;
      initial.velocity_terms = std::min(old_links, 4);
      initial.velocity_coefficients.clear();
    }
  };
  refit_start(result.initial, the_case.links);
  for (ExperimentSpec& experiment : result.experiments) {
    if (experiment.kind == DataKind::kAngles) return refuse("the data are angles of links");
    if (experiment.initial) refit_start(*experiment.initial, the_case.links);
    for (PointSpec& point : experiment.points)
      if (point.joint > 0) {
        if (!whole(point.joint + 1)) return refuse("a marker sits at a joint that chain has not");
        point.joint = joint_of(point.joint + 1) - 1;
      }
  }
  return result;
}

std::optional<Case> with_freer_start(const Case& the_case, int more_terms, int rate_terms) {
  if (the_case.links < 2) return std::nullopt;
  Case result = the_case;
  if (!polynomial(result.initial)) return std::nullopt;
  free_start(result.initial, more_terms, rate_terms);
  for (ExperimentSpec& experiment : result.experiments) {
    if (!experiment.initial) continue;
    if (!polynomial(*experiment.initial)) return std::nullopt;
    free_start(*experiment.initial, more_terms, rate_terms);
  }
  return result;
}

Eigen::VectorXd transfer(const Problem& from, const Eigen::VectorXd& x, const Problem& to) {
  Eigen::VectorXd result = to.start();
  for (std::size_t j = 0; j < to.unknowns().size(); ++j) {
    const Unknown& unknown = to.unknowns()[j];
    const Eigen::Index known = unknown_index(from, unknown.name);
    if (known >= 0)
      result[static_cast<Eigen::Index>(j)] = x[known];
    else if (unknown.group == Unknown::Group::kInitial)
      result[static_cast<Eigen::Index>(j)] = known_start(from, unknown, to);
  }
  return result;
}

Eigen::Index unknown_index(const Problem& problem, const std::string& name) {
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j)
    if (problem.unknowns()[j].name == name) return static_cast<Eigen::Index>(j);
  return -1;
}

}  // namespace catena
