// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "identify/cases/case.hpp"
#include "identify/problem/initial_state.hpp"
#include "identify/problem/parameter_map.hpp"
#include "identify/recordings/recording.hpp"
#include "identify/recordings/signal_reader.hpp"
#include "runtime/model.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/simulation.hpp"
#include "runtime/state.hpp"

namespace catena {

/// One number the fit may change.
struct Unknown {
  enum class Group { kPhysics, kInitial, kSensor };
  std::string name;  ///< "k", "run 1: angle coefficient 2"
  std::string unit;
  double start = 0, lower = 0, upper = 0;
  Scale scale = Scale::kLinear;
  Group group = Group::kPhysics;
  int experiment = -1;   ///< the one experiment it belongs to; -1: all
  int parameter = -1;    ///< index into Case::parameters; -1: a coefficient of the initial state
  int coefficient = -1;  ///< index into the angle, then the rate coefficients of the experiment
};

/// One experiment of the case (windows are cut already) with its data.
struct Experiment {
  ExperimentSpec spec;
  Recording recording;
  InitialSpec initial;      ///< its own or the case's, with all coefficients found
  Signals signals;          ///< in the order of the model
  int source = -1;          ///< index into Case::experiments: several windows may be of one
  int meets = -1;           ///< multiple shooting: the experiment that starts where this one ends
  double ends = kNotGiven;  ///< s: when it does, if there is one
  bool fitted() const { return spec.use == Use::kFit && recording.fit_frames > 0; }
};

/// What the model says about one experiment. Where the simulation failed, `simulated` is NaN.
struct Prediction {
  Status status = Status::kNotRun;
  std::string message;
  Eigen::MatrixXd simulated;                 ///< channels x frames
  std::vector<Eigen::MatrixXd> sensitivity;  ///< one per direction, channels x frames
  Trajectory trajectory;                     ///< at the frames
  /// Joined windows: q and v at the start, and where the next one starts.
  Eigen::VectorXd first, last;
  Eigen::MatrixXd first_along, last_along;  ///< their derivatives, one column per direction
  bool ok() const { return status == Status::kSuccess; }
};

/// A case, its model and its data: from the unknowns to predictions and back to a case.
/// All functions may be called from several threads at once.
///
///     Problem problem(read_case("case.toml"), model);
///     Evaluation at_start = problem.evaluate(problem.start(), Part::kFit);
///     double error = error_of(problem, at_start, Part::kFit);       // identify/fit/error.hpp
class Problem {
 public:
  /// Reads the data. Throws InputError.
  Problem(Case the_case, Model model);
  /// The same case with data given: one recording per experiment of the case.
  Problem(Case the_case, Model model, std::vector<Recording> recordings);

  const Case& the_case() const { return case_; }
  const Model& model() const { return model_; }
  const std::vector<Experiment>& experiments() const { return experiments_; }
  const std::vector<Unknown>& unknowns() const { return unknowns_; }
  /// Starting values, in the units of the unknowns.
  Eigen::VectorXd start() const;

  /// The model's parameters in one experiment; -1: in none (the case's own initial state).
  Eigen::VectorXd model_parameters(const Eigen::VectorXd& x, int experiment) const;
  /// The start of one experiment as the case describes it; -1: the case's own.
  InitialSpec initial_of(const Eigen::VectorXd& x, int experiment) const;
  /// The state at the start of one experiment. Throws std::invalid_argument or std::runtime_error
  /// where there is none (held farther away than the cable is long, no equilibrium).
  State initial_state(const Eigen::VectorXd& x, int experiment) const;
  /// The derivatives of both by every unknown. A vector that is empty is zero; all of an unknown of
  /// another experiment are.
  std::vector<Seed> directions(const Eigen::VectorXd& x, int experiment) const;

  /// Simulates one experiment at its frames (all, or those to be fitted), with the sensitivities
  /// along `along` (model parameters and initial state: e.g. directions(), or any other).
  Prediction predict(const Eigen::VectorXd& x, int experiment, bool all_frames,
                     const std::vector<Seed>& along = {},
                     const std::function<bool()>& keep_going = {}) const;

  /// The case with the values of `x` as its starting values.
  Case with(const Eigen::VectorXd& x) const;

  /// Multiple shooting: the windows of an experiment are to meet.
  bool joined() const;
  /// What a gap between windows costs, in residuals of the same size: so much that it closes. Lower
  /// while a fit is on its way.
  double defect_weight() const { return defect_weight_; }
  Problem with_defect_weight(double weight) const;

  /// The same, only the first `seconds` of each experiment.
  Problem shortened(double seconds) const;
  /// The same, the optimiser's tolerance another.
  Problem with_tolerance(double tolerance) const;
  /// The same as closely as the way to a minimum needs it, for a start of the fit proper: simulated
  /// with a relative tolerance of 1e-4 (absolute ones in proportion), every so many frames only,
  /// the optimiser's tolerance 1e-2.
  Problem rough() const;
  /// rough() costs much less.
  bool finer_than_rough() const;
  /// The same problem with one unknown of the physics at a value, no longer free.
  Problem fixed(int unknown, double value) const;
  /// One experiment alone, all of it to be fitted, by its start only: everything else is as in x.
  Problem alone(const Eigen::VectorXd& x, int experiment) const;
  /// The same problem, other starts of some experiments.
  Problem started(const std::map<int, InitialSpec>& starts) const;
  /// The same problem with other measurements: one matrix (channels x frames) per experiment.
  Problem measured_as(const std::vector<Eigen::MatrixXd>& measured) const;

 private:
  /// Joins the windows from experiment `first` on.
  void join(std::size_t first);
  void prepare();
  /// Throws InputError where an experiment (-1: the case alone) cannot begin.
  void check_start(int experiment) const;
  /// Of the case's parameters, in their order.
  Eigen::VectorXd parameter_values(const Eigen::VectorXd& x, int experiment) const;
  State state_of(int experiment, const InitialSpec& initial,
                 const Eigen::VectorXd& parameters) const;

  Case case_;
  Model model_;
  ParameterMap map_;
  std::vector<Experiment> experiments_;
  std::vector<Unknown> unknowns_;
  double defect_weight_ = 1e4;
};

/// Predictions of all experiments (those to be fitted, or all) and, if asked for, their
/// derivatives by the unknowns.
struct Evaluation {
  std::vector<Prediction> predictions;  ///< one per experiment; kNotRun where not asked for
  bool with_jacobian = false;
  /// Every prediction asked for succeeded and is finite.
  bool ok = false;
  std::string message;  ///< of the first failure: "run 1: theta_7 at t = 1.23 s"
};

enum class Part { kFit, kValidation };

/// `all`: validation too (longer simulations), else only what is fitted.
Evaluation evaluate(const Problem& problem, const Eigen::VectorXd& x, bool all, bool jacobian,
                    const std::function<bool()>& keep_going = {});

}  // namespace catena
