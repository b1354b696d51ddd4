// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "identify/cases/case.hpp"
#include "identify/problem/experiment.hpp"
#include "identify/problem/parameter_map.hpp"
#include "identify/problem/prediction.hpp"
#include "identify/problem/unknowns.hpp"
#include "identify/recordings/recording.hpp"
#include "runtime/model.hpp"
#include "runtime/state.hpp"

namespace catena {

/// A case, its model and its data: what a fit compares. A value of an unknown takes this way:
///
///   Unknowns            x -> parameters of the case, start of an experiment   unknowns.hpp
///   ParameterMap        parameters of the case -> array of the model          parameter_map.hpp
///   state_at_start      start, array -> angles and rates at the start         initial_state.hpp
///   predict_experiment  array, state -> what the sensors would see            prediction.hpp
///   residuals_of        prediction minus measurement                          identify/fit/error.hpp
///
/// A problem never changes. Whoever wants another one (shorter, rougher, with one parameter held)
/// builds it from a changed case or changed experiments. All functions may be called from several
/// threads at once.
///
///     #include "identify/cases/case_reader.hpp"
///     #include "identify/fit/error.hpp"
///     const Problem problem(read_case("case.toml"), Model::built_in(4));
///     const Evaluation at_start = evaluate(problem, problem.start(), false, false);
///     const double error = error_of(problem, at_start, Part::kFit);
///
/// x always has one value per unknown, in their order and units. `experiment` is an index into
/// experiments(); -1 stands for none: the case's own values and initial state.
class Problem {
 public:
  /// Reads the data, or takes `recordings`: one per experiment of the case. Throws InputError for
  /// parameters that the model does not have, values outside its bounds, data that cannot be used
  /// and experiments that cannot begin; std::invalid_argument for another number of recordings.
  Problem(Case the_case, Model model, std::vector<Recording> recordings = {});

  /// From experiments of another problem of the same model, all or some of them, changed or not.
  Problem(Case the_case, Model model, std::vector<Experiment> experiments);

  const Case& the_case() const { return case_; }
  const Model& model() const { return model_; }
  const std::vector<Experiment>& experiments() const { return experiments_; }
  const std::vector<Unknown>& unknowns() const { return unknowns_.list(); }

  /// The values at which the case starts the unknowns.
  Eigen::VectorXd start() const { return unknowns_.start(); }

  /// The model's array of parameters in one experiment.
  Eigen::VectorXd model_parameters(const Eigen::VectorXd& x, int experiment) const;

  /// The start of one experiment as the case describes it.
  InitialSpec initial_of(const Eigen::VectorXd& x, int experiment) const;

  /// The state at the start of one experiment. Throws ImpossibleValue where there is none.
  State initial_state(const Eigen::VectorXd& x, int experiment) const;

  /// The derivatives of both by every unknown, one per unknown. A vector that is empty is zero; all
  /// of an unknown of another experiment are. Throws ImpossibleValue as initial_state.
  std::vector<SensitivityDirection> directions(const Eigen::VectorXd& x, int experiment) const;

  /// Simulates one experiment at its frames (all, or those to be fitted), with the sensitivities
  /// along `along` (e.g. directions(), or any other). `keep_going`: asked at every step with its time
  /// (s); false ends the simulation. What fails, and values that are impossible, say so in the status; nothing is
  /// thrown for them.
  Prediction predict(const Eigen::VectorXd& x, int experiment, bool all_frames,
                     const std::vector<SensitivityDirection>& along = {},
                     const std::function<bool(double)>& keep_going = {}) const;

  /// The case with the values of x where it gave its own: reading it again gives a problem that
  /// starts at x. The starts of windows have no place in a case; they are found again.
  Case with(const Eigen::VectorXd& x) const;

  /// What is odd about the recordings, or without any about the case (plausibility.hpp): "NAME:
  /// key: what is seen; what to change".
  std::vector<std::string> warnings() const;

  /// Multiple shooting: the windows of an experiment are to meet.
  bool joined() const;

 private:
  const Experiment& at(int experiment) const {
    return experiments_[static_cast<std::size_t>(experiment)];
  }
  State state_of(int experiment, const InitialSpec& initial,
                 const Eigen::VectorXd& parameters) const;

  Case case_;
  Model model_;
  ParameterMap map_;
  std::vector<Experiment> experiments_;
  Unknowns unknowns_;
};

}  // namespace catena
