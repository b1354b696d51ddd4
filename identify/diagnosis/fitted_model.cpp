// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/fitted_model.hpp"

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/stacking.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/fit/error.hpp"
#include "identify/fit/estimated_noise.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// One experiment alone, all of it to be fitted, by its start only: everything else is as in x.
Problem only_start_of(const Problem& problem, const VectorXd& x, int experiment) {
  const Experiment& chosen = problem.experiments()[static_cast<std::size_t>(experiment)];
  Case the_case = problem.with(x);
  for (ParameterSpec& parameter : the_case.parameters) {
    parameter.value = parameter.value_in(chosen.spec.name);
    parameter.values.clear();
    parameter.free = false;
  }
  the_case.optimiser.growing_windows.clear();
  the_case.experiments = {chosen.spec};
  ExperimentSpec& spec = the_case.experiments.front();
  spec.use = Use::kFit;
  spec.initial = problem.initial_of(x, experiment);
  Recording recording = chosen.recording;
  recording.fit_frames = static_cast<Index>(recording.time.size());
  return Problem(std::move(the_case), problem.model(), {std::move(recording)});
}

/// What starts as it fits, everything else as in x: how a window begins says nothing of the model.
std::shared_ptr<const Problem> with_held_out_starts(std::shared_ptr<const Problem> problem,
                                                    const VectorXd& x,
                                                    const LeastSquares& least_squares,
                                                    const std::atomic<bool>* stop) {
  FitOptions options;
  options.stop = stop;
  std::vector<Experiment> experiments = problem->experiments();
  bool changed = false;
  for (std::size_t e = 0; e < problem->experiments().size(); ++e) {
    const Experiment& experiment = problem->experiments()[e];
    if (!starts_as_it_fits(experiment)) continue;
    const Problem alone = only_start_of(*problem, x, static_cast<int>(e));
    const FitResult result = least_squares(alone, options);
    if (result.status == FitStatus::kFailed || result.x.size() == 0) continue;
    experiments[e].initial = alone.initial_of(result.x, 0);
    changed = true;
  }
  if (!changed) return problem;
  return std::make_shared<const Problem>(problem->the_case(), problem->model(),
                                         std::move(experiments));
}

}  // namespace

bool starts_as_it_fits(const Experiment& experiment) {
  const InitialSpec& initial = experiment.initial;
  return !experiment.fitted() && (initial.free || (!initial.at_rest && initial.velocity_free));
}

FittedModel assess(std::shared_ptr<const Problem> problem, const VectorXd& x,
                   const LeastSquares& least_squares, const std::atomic<bool>* stop) {
  problem = with_held_out_starts(std::move(problem), x, least_squares, stop);
  FittedModel model;
  model.x = x;
  const Evaluation evaluation = evaluate(*problem, x, true, false);
  model.ok = evaluation.ok;
  model.message = evaluation.message;
  for (std::size_t e = 0; e < problem->experiments().size(); ++e) {
    const Experiment& experiment = problem->experiments()[e];
    const MatrixXd& measured = experiment.recording.measured;
    MatrixXd predicted = evaluation.predictions[e].simulated;
    if (predicted.cols() != measured.cols()) {
      predicted = MatrixXd::Constant(measured.rows(), measured.cols(), kNotGiven);
      model.ok = false;
    }
    const MatrixXd residual = predicted - measured;
    const Index fitted = experiment.fitted() ? experiment.recording.fit_frames : 0;
    model.fit_residual.push_back(residual.leftCols(fitted));
    model.held_out_residual.push_back(residual.rightCols(residual.cols() - fitted));
    model.predicted.push_back(std::move(predicted));
  }
  model.problem = std::move(problem);
  return model;
}

namespace {

/// Least squares are of white residuals.
Problem to_fit(const Problem& problem, const std::vector<NoiseModel>& noise) {
  const bool squares = problem.the_case().error.measure == Measure::kLeastSquares;
  return squares ? with_noise(problem, noise) : problem;
}

}  // namespace

double error_to_fit(const Problem& problem, const VectorXd& x, const std::vector<NoiseModel>& noise,
                    const std::function<bool(double)>& keep_going) {
  const Problem fitted = to_fit(problem, noise);
  return error_of(fitted, evaluate(fitted, x, false, false, keep_going), Part::kFit);
}

FittedModel fit_model(std::shared_ptr<const Problem> problem, const VectorXd& start,
                      const std::vector<NoiseModel>& noise, const LeastSquares& least_squares,
                      const std::atomic<bool>* stop) {
  FitOptions options;
  options.start = start;
  options.stall = kThresholds.stall;
  options.stop = stop;
  const FitResult result = least_squares(to_fit(*problem, noise), options);
  if (result.status == FitStatus::kFailed || result.x.size() == 0) {
    FittedModel failed;
    failed.problem = std::move(problem);
    failed.x = start;
    failed.status = result.status;
    failed.message = result.message;
    return failed;
  }
  FittedModel model = assess(std::move(problem), result.x, least_squares, stop);
  model.status = result.status;
  if (model.message.empty()) model.message = result.message;
  return model;
}

std::vector<NoiseModel> noise_of(const FittedModel& model) {
  return estimated_noise(*model.problem, model.predicted);
}

namespace {

GapTest gap_of(const FittedModel& model, const std::vector<MatrixXd>& residuals,
               const std::vector<NoiseModel>& noise, bool held_out) {
  std::vector<MatrixXd> present;
  std::vector<NoiseModel> present_noise;
  std::vector<Index> first;
  for (std::size_t e = 0; e < residuals.size(); ++e) {
    if (residuals[e].cols() == 0) continue;
    present.push_back(residuals[e]);
    present_noise.push_back(noise[e]);
    first.push_back(held_out ? model.fit_residual[e].cols() : 0);
  }
  GapTest test = test_gap(present, present_noise, first);
  test.good_enough = test.rms <= model.problem->the_case().diagnosis.good_enough;
  test.present = test.present && !test.good_enough;
  return test;
}

}  // namespace

GapTest fit_gap(const FittedModel& model, const std::vector<NoiseModel>& noise) {
  return gap_of(model, model.fit_residual, noise, false);
}

GapTest held_out_gap(const FittedModel& model, const std::vector<NoiseModel>& noise) {
  return gap_of(model, model.held_out_residual, noise, true);
}

std::vector<MatrixXd> white_residuals(const FittedModel& model,
                                      const std::vector<NoiseModel>& noise) {
  std::vector<MatrixXd> white;
  for (std::size_t e = 0; e < model.fit_residual.size(); ++e)
    if (model.fit_residual[e].cols() > 0) white.push_back(noise[e].whitened(model.fit_residual[e]));
  return white;
}

VectorXd stacked(const std::vector<MatrixXd>& matrices, const std::vector<MatrixXd>& measured_where,
                 const std::vector<NoiseModel>& noise) {
  std::vector<MatrixXd> white;
  for (std::size_t e = 0; e < measured_where.size(); ++e) {
    const MatrixXd& where = measured_where[e];
    MatrixXd measured =
        matrices[e].size() ? matrices[e] : MatrixXd::Zero(where.rows(), where.cols());
    measured = where.array().isNaN().select(std::numeric_limits<double>::quiet_NaN(), measured);
    white.push_back(noise[e].whitened(measured));
  }
  return stacked_where_seen(white, white);
}

MatrixXd fitted_jacobian(const FittedModel& model, const std::vector<NoiseModel>& noise) {
  const Evaluation evaluation = evaluate(*model.problem, model.x, false, true);
  const std::size_t unknowns = model.problem->unknowns().size();
  MatrixXd jacobian;
  for (std::size_t j = 0; j < unknowns; ++j) {
    std::vector<MatrixXd> derivative(model.fit_residual.size());
    for (std::size_t e = 0; e < derivative.size(); ++e)
      if (model.fit_residual[e].cols() > 0 && evaluation.predictions[e].ok())
        derivative[e] = evaluation.predictions[e].sensitivity[j];
    const VectorXd column = stacked(derivative, model.fit_residual, noise);
    if (jacobian.size() == 0) jacobian.resize(column.size(), static_cast<Index>(unknowns));
    jacobian.col(static_cast<Index>(j)) = column;
  }
  return jacobian;
}

double prediction_distance(const FittedModel& a, const FittedModel& b,
                           const std::vector<NoiseModel>& noise) {
  double sum = 0, count = 0;
  for (std::size_t e = 0; e < a.predicted.size(); ++e) {
    const MatrixXd& measured = a.problem->experiments()[e].recording.measured;
    const MatrixXd difference = noise[e].whitened(a.predicted[e] - b.predicted[e]);
    for (Index k = 0; k < measured.cols(); ++k)
      for (Index c = 0; c < measured.rows(); ++c) {
        if (std::isnan(measured(c, k)) || std::isnan(difference(c, k))) continue;
        sum += difference(c, k) * difference(c, k);
        count += 1;
      }
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace catena
