// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/marker_places.hpp"

#include <algorithm>
#include <string_view>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "identify/problem/extended_model.hpp"

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kFarthestMark = 1e3;  // m: no cable of a case is that long
constexpr catena_parameter kPlace = {
    "",
    "m",
    "How much farther from the support a marker sits than the case says",
    0,
    -kFarthestMark,
    kFarthestMark,
    0};

/// What a parameter of the case names, if it is the place of a marker.
std::optional<std::string> marker_of(const std::string& sets) {
  const std::string prefix = marker_place_of("");
  if (!sets.starts_with(prefix)) return std::nullopt;
  return sets.substr(prefix.size());
}

bool at_arc_length(const PointSpec& point) { return !point.load && !point.joint && !point.link; }

}  // namespace

std::string marker_place_of(const std::string& marker) {
  return std::string(kMarkerPlaces) + "." + marker;
}

Model with_marker_places(const Case& the_case, const Model& model) {
  std::vector<SensorParameter> places;
  for (const ParameterSpec& parameter : the_case.parameters) {
    const std::optional<std::string> marker = marker_of(parameter.sets);
    const bool twice = std::any_of(places.begin(), places.end(), [&](const SensorParameter& each) {
      return each.name == parameter.sets;
    });
    if (marker && !twice && !index_of_place(model, *marker))
      places.push_back({parameter.sets, kPlace});
  }
  return places.empty() ? model : extended_model(model, places);
}

void check_marker_places(const Case& the_case, const std::vector<Experiment>& experiments) {
  const std::vector<std::string> markers = markers_at_arc_lengths(experiments);
  for (const ParameterSpec& parameter : the_case.parameters) {
    const std::optional<std::string> marker = marker_of(parameter.sets);
    if (!marker || std::find(markers.begin(), markers.end(), *marker) != markers.end()) continue;
    throw InputError(parameter.where + ": parameter " + in_quotes(parameter.name) +
                     ": sets = " + in_quotes(parameter.sets) +
                     ": no experiment has a marker of this name at an arc length" +
                     suggestion(*marker, markers));
  }
}

std::vector<std::string> markers_at_arc_lengths(const std::vector<Experiment>& experiments) {
  std::vector<std::string> markers;
  for (const Experiment& experiment : experiments)
    for (const PointSpec& point : experiment.recording.points)
      if (at_arc_length(point) &&
          std::find(markers.begin(), markers.end(), point.name) == markers.end())
        markers.push_back(point.name);
  return markers;
}

Index first_marker_place(const Model& model) {
  const catena_parameter* const begin = model.table().parameter;
  return std::find_if(
             begin, begin + model.parameters(),
             [](const catena_parameter& each) { return each.description == kPlace.description; }) -
         begin;
}

std::optional<Index> index_of_place(const Model& model, const std::string& marker) {
  const std::string name = marker_place_of(marker);
  for (Index i = first_marker_place(model); i < model.parameters(); ++i)
    if (name == model.table().parameter[i].name) return i;
  return std::nullopt;
}

MaterialPoint moved_point(const Model& model, const VectorXd& parameters, double arc_length,
                          double off) {
  MaterialPoint point = point_at_arc_length(model, parameters, arc_length);
  const VectorXd lengths = link_lengths(model, parameters);
  const double moved = std::clamp(arc_length + off, 0.0, lengths.sum());
  if (off != 0) point = point_at_arc_length(model, parameters, moved);
  point.fraction += (arc_length + off - moved) / lengths[point.link];
  return point;
}

}  // namespace catena
