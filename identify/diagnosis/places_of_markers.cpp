// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/places_of_markers.hpp"

#include <algorithm>

#include "identify/diagnosis/thresholds.hpp"
#include "identify/problem/marker_places.hpp"

namespace catena {
namespace {

constexpr double kFarthest = 20;  // standard deviations

/// "marker 3" of the name "marker 3", "marker tip" of "tip".
std::string called(const std::string& marker) {
  return marker.starts_with("marker") ? marker : "marker " + marker;
}

}  // namespace

std::optional<Candidate> places_of_markers(const Case& the_case,
                                           const std::vector<Experiment>& experiments) {
  const auto& impossible = the_case.diagnosis.impossible;
  if (std::find(impossible.begin(), impossible.end(), kMarkerPlaces) != impossible.end())
    return std::nullopt;
  Candidate candidate;
  candidate.sensor = candidate.of_case = true;
  candidate.id = candidate.effect.id = kMarkerPlaces;
  candidate.title = candidate.effect.title = "Places of the markers";
  candidate.effect.description =
      "Markers sit elsewhere along the cable than the case says, each by an amount of its own.";
  for (const std::string& marker : markers_at_arc_lengths(experiments)) {
    CandidateParameter place;
    place.name = marker_place_of(marker);
    if (std::any_of(the_case.parameters.begin(), the_case.parameters.end(),
                    [&](const ParameterSpec& known) { return known.sets == place.name; }))
      continue;
    place.unit = "m";
    place.description = "How much farther from the support " + called(marker) + " sits";
    place.deviation = kThresholds.errors_of_knowns.place;
    place.lower = -kFarthest * place.deviation;
    place.upper = kFarthest * place.deviation;
    EffectParameter words;
    words.name = marker;
    words.unit = place.unit;
    words.neutral = place.neutral;
    words.description = place.description;
    words.above = called(marker) + " sits {} farther from the support than the case says";
    words.below = called(marker) + " sits {} nearer to the support than the case says";
    candidate.effect.parameters.push_back(std::move(words));
    candidate.parameters.push_back(std::move(place));
  }
  if (candidate.parameters.empty()) return std::nullopt;
  return candidate;
}

}  // namespace catena
