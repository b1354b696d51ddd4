// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/cases/case.hpp"
#include "runtime/model.hpp"

namespace catena {

/// From the values of a case's parameters to the parameter array of the model, for any number of
/// links:
///
///   length_i, mass_i, inertia_i   from the geometry
///   "name", "name_3", "name_2..12", "name" for name_1..n    factor * value
///   "bending_stiffness" (EI, N m^2)        stiffness_i = factor * value / spacing_i
///   "damping_length" (N m^2 s/rad)         damping_i   = factor * value / spacing_i
///                                          (both also for a range: "bending_stiffness_2..12")
///   "cable.length" (m)                     all lengths in proportion; masses, inertias follow
///   "cable.density" (kg/m)                 masses, and inertias in proportion
///
/// spacing_i is the length of cable whose bending joint i stands for: from the middle of link i-1
/// to that of link i, for joint 1 from the clamp to the middle of link 1. (A cable on a hinge has
/// no bending stiffness at joint 1: use a range from 2 on.)
class ParameterMap {
 public:
  /// Throws InputError naming line and key for an unknown name, a wrong unit, a model parameter
  /// that is set twice or not at all.
  ParameterMap(const Case& the_case, const Model& model);

  /// Throws InputError naming the line where a value in the case is outside the model's bounds.
  void check_values(const Case& the_case, const Model& model) const;

  /// The values of a parameter of the case that the model's own bounds admit; with others no simulation begins.
  struct Range {
    double lower, upper;
  };
  /// `parameter`: its index in the case.
  Range admitted(std::size_t parameter) const { return assignments_[parameter].admitted; }

  /// `values`: one per parameter of the case, in its order and unit. Returns the model's array.
  Eigen::VectorXd operator()(const Eigen::VectorXd& values) const;

  /// d(model's array)/d(values): parameters of the model x parameters of the case.
  Eigen::MatrixXd jacobian(const Eigen::VectorXd& values) const;

 private:
  enum class Kind { kModel, kPerSpacing, kLength, kDensity };
  struct Assignment {
    Kind kind = Kind::kModel;
    double factor = 1;
    std::vector<int> targets;  // indices of model parameters
    int first = 0;             // kPerSpacing: 0-based joint of the first target
    Range admitted;
  };

  static Range admitted_by(const Model& model, const Assignment& assignment);
  template <class T>
  Eigen::Vector<T, Eigen::Dynamic> map(const Eigen::Vector<T, Eigen::Dynamic>& values) const;

  int links_;
  bool masses_given_, inertias_given_;
  double length_, density_;
  Eigen::VectorXd relative_lengths_, masses_, inertias_;  // masses and inertias as given
  Eigen::VectorXd base_;                                  // what no parameter sets
  std::vector<Assignment> assignments_;
  int length_index_, mass_index_, inertia_index_;
};

/// The values of a case's parameters, in its order, in the experiment of that name; without a name
/// those that hold in no particular one.
Eigen::VectorXd case_values(const Case& the_case, const std::string& experiment = "");

/// The lengths of the links (m), from the model's array of parameters.
Eigen::VectorXd link_lengths(const Model& model, const Eigen::VectorXd& parameters);

}  // namespace catena
