// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/cases/case.hpp"
#include "identify/problem/experiment.hpp"
#include "identify/problem/parameter_map.hpp"

namespace catena {

/// One number the fit may change.
struct Unknown {
  enum class Group { kPhysics, kInitial, kSensor };
  std::string name;  ///< "k", "run 1: angle 2"
  std::string unit;
  double start = 0, lower = 0, upper = 0;  ///< the case's bounds
  Scale scale = Scale::kLinear;
  /// Within the case's bounds and the model's. A fit, a profile and a verdict `at_bound` go by these; what the case
  /// says is where the value is expected.
  double least = 0, most = 0;
  int at_most = -1;  ///< another unknown, which this one does not exceed; -1: none
  Group group = Group::kPhysics;
  int experiment = -1;  ///< the one experiment it belongs to; -1: all
  int parameter = -1;   ///< index into Case::parameters; -1: a coefficient of the initial state
  int coefficient =
      -1;  ///< index into InitialSpec::coefficient_lists() of the experiment, end to end
};

/// The unknowns of a case with its data, and what values of them say. They are: each free parameter
/// of the case once, or, where it is `per_experiment`, once for each fitted experiment; then the
/// free coefficients of the start of each fitted experiment.
///
/// x always has one value per unknown, in their order and units. `experiment` is an index into the
/// experiments; -1 stands for none: the case's own values and initial state.
class Unknowns {
 public:
  Unknowns(const Case& the_case, const ParameterMap& map,
           const std::vector<Experiment>& experiments);

  const std::vector<Unknown>& list() const { return list_; }

  /// The values at which the case starts them.
  Eigen::VectorXd start() const;

  /// The values of all parameters of the case, in its order, in one experiment.
  Eigen::VectorXd case_values(const Eigen::VectorXd& x, int experiment) const;

  /// How one experiment starts.
  InitialSpec initial(const Eigen::VectorXd& x, int experiment) const;

 private:
  /// What the case says of one experiment, or of none.
  struct Given {
    Eigen::VectorXd values;
    InitialSpec initial;
  };
  void add_parameters(const Case& the_case, const ParameterMap& map,
                      const std::vector<Experiment>& experiments);
  /// Where one parameter does not exceed another: an order of two unknowns, or a bound where one is known.
  void order(const std::vector<ParameterSpec>& parameters);
  void add_coefficients(const Experiment& experiment, int index);
  const Given& given(int experiment) const {
    return given_[static_cast<std::size_t>(experiment + 1)];
  }

  std::vector<Unknown> list_;
  std::vector<Given> given_;  // of no experiment, then of each
};

}  // namespace catena
