// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/doubted_knowns.hpp"

#include <algorithm>
#include <cmath>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/problem/marker_places.hpp"

namespace catena {
namespace {

constexpr double kFarthest = 20;  // standard deviations

bool sets(const Case& the_case, const std::string& beginning) {
  return std::any_of(the_case.parameters.begin(), the_case.parameters.end(),
                     [&](const ParameterSpec& known) { return known.sets.starts_with(beginning); });
}

Candidate of_case(const std::string& id, const std::string& title, const std::string& description) {
  Candidate candidate;
  candidate.sensor = candidate.of_case = true;
  candidate.id = candidate.effect.id = id;
  candidate.title = candidate.effect.title = title;
  candidate.effect.description = description;
  return candidate;
}

/// One known, in m: `known` by the case, and what a larger or smaller one means.
void add_amplitude(Candidate& candidate, const std::string& name, double known, double deviation,
                   const std::string& description, const std::string& above,
                   const std::string& below) {
  CandidateParameter amplitude;
  amplitude.name = candidate.id + "." + name;
  amplitude.unit = "m";
  amplitude.description = description;
  amplitude.neutral = amplitude.value = known;
  amplitude.deviation = deviation;
  amplitude.lower = known - kFarthest * deviation;
  amplitude.upper = known + kFarthest * deviation;
  EffectParameter words;
  words.name = name;
  words.unit = amplitude.unit;
  words.description = description;
  words.neutral = known;
  words.above = above;
  words.below = below;
  candidate.effect.parameters.push_back(std::move(words));
  candidate.parameters.push_back(std::move(amplitude));
}

/// "marker 3" of the name "marker 3", "marker tip" of "tip".
std::string called(const std::string& marker) {
  return marker.starts_with("marker") ? marker : "marker " + marker;
}

Candidate places_of_markers(const Case& the_case, const std::vector<Experiment>& experiments) {
  Candidate candidate = of_case(
      kMarkerPlaces, "Places of the markers",
      "Markers sit elsewhere along the cable than the case says, each by an amount of its own.");
  for (const std::string& marker : markers_at_arc_lengths(experiments))
    if (!sets(the_case, marker_place_of(marker)))
      add_amplitude(candidate, marker, 0, kThresholds.errors_of_knowns.place,
                    "How much farther from the support " + called(marker) + " sits",
                    called(marker) + " sits {} farther from the support than the case says",
                    called(marker) + " sits {} nearer to the support than the case says");
  return candidate;
}

Candidate length_of_cable(const Case& the_case, const std::vector<Experiment>& experiments) {
  Candidate candidate = of_case(kCableKnowns, "Length of the cable",
                                "The cable is longer or shorter than the case says.");
  const CableGeometry& cable = the_case.cable;
  if (cable.link_lengths.empty() && !sets(the_case, "cable.") &&
      !markers_at_arc_lengths(experiments).empty())
    add_amplitude(candidate, "length", cable.length,
                  kThresholds.errors_of_knowns.length * cable.length, "Length of the cable",
                  "the cable is {} longer than the case says",
                  "the cable is {} shorter than the case says");
  return candidate;
}

}  // namespace

std::vector<Candidate> doubted_knowns(const Case& the_case,
                                      const std::vector<Experiment>& experiments) {
  if (the_case.error.measure != Measure::kLeastSquares) return {};
  std::vector<Candidate> candidates = {places_of_markers(the_case, experiments),
                                       length_of_cable(the_case, experiments)};
  const auto& impossible = the_case.diagnosis.impossible;
  std::erase_if(candidates, [&](const Candidate& each) {
    return each.parameters.empty() ||
           std::find(impossible.begin(), impossible.end(), each.id) != impossible.end();
  });
  return candidates;
}

std::vector<Candidate> doubtful_parameters(const Case& the_case, const Model& model) {
  const catena_model& table = model.table();
  std::vector<std::string> known;
  for (int k = 0; k < table.parameters; ++k)
    if (std::isfinite(table.parameter[k].default_value))
      known.emplace_back(table.parameter[k].name);
  std::vector<Candidate> candidates;
  for (const std::string& name : the_case.diagnosis.doubtful) {
    const auto refuse = [&](const std::string& why) {
      throw InputError(the_case.file.string() + ": diagnosis.doubtful: " + in_quotes(name) + why);
    };
    if (std::find(known.begin(), known.end(), name) == known.end())
      refuse(" is no parameter of the model that has a default" + suggestion(name, known));
    if (sets(the_case, name))
      refuse(" is set by the case; leave its parameter away, or set it free");
    const catena_parameter& entry = table.parameter[model.parameter_index(name)];
    Candidate candidate = of_case(name, name, entry.description);
    CandidateParameter amplitude;
    amplitude.name = name;
    amplitude.unit = entry.unit;
    amplitude.description = entry.description;
    amplitude.neutral = amplitude.value = entry.default_value;
    amplitude.lower = entry.lower;
    amplitude.upper = entry.upper;
    candidate.parameters.push_back(std::move(amplitude));
    candidates.push_back(std::move(candidate));
  }
  return candidates;
}

}  // namespace catena
