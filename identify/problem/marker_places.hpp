// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "identify/cases/case.hpp"
#include "identify/problem/experiment.hpp"
#include "runtime/model.hpp"
#include "runtime/positions.hpp"

namespace catena {

/// Where markers sit is known to some millimetres. The parameter `marker_places.NAME` (m) is how much farther from
/// the support, along the cable, the marker NAME sits than its arc length says; the same in all recordings.
inline constexpr const char* kMarkerPlaces = "marker_places";

/// The parameter of a marker of this name.
std::string marker_place_of(const std::string& marker);

/// The model with those of these parameters that the case sets behind its own; a model that has them is returned as it
/// is.
Model with_marker_places(const Case& the_case, const Model& model);

/// Throws InputError for a parameter of a marker that no experiment has at an arc length.
void check_marker_places(const Case& the_case, const std::vector<Experiment>& experiments);

/// The markers at an arc length, each once, in the order in which the experiments have them.
std::vector<std::string> markers_at_arc_lengths(const std::vector<Experiment>& experiments);

/// The index of the first of these parameters, which are a model's last; the number of its parameters if it has
/// none.
Eigen::Index first_marker_place(const Model& model);

/// The index of a marker's parameter, if the model has it.
std::optional<Eigen::Index> index_of_place(const Model& model, const std::string& marker);

/// The point `off` (m) farther along the cable than `arc_length`: beyond an end of the cable on its last link drawn
/// out. Throws ImpossibleValue where `arc_length` is not on the cable.
MaterialPoint moved_point(const Model& model, const Eigen::VectorXd& parameters, double arc_length,
                          double off);

}  // namespace catena
