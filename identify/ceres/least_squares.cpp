// SPDX-License-Identifier: BSD-3-Clause
//
// All residuals come from one simulation, and Ceres wants them in blocks to which a loss applies. So
// the evaluation callback simulates once for each point Ceres looks at, and the blocks read from it.
#include "identify/ceres/least_squares.hpp"

#include <ceres/ceres.h>

#include <cmath>

#include "generator/description/input_error.hpp"
#include "identify/ceres/bounded_solve.hpp"
#include "identify/error.hpp"
#include "identify/fit_journal.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// sqrt(s + e^2), up to a factor: a distance instead of its square, rounded at zero.
class RoundedDistance : public ceres::LossFunction {
 public:
  explicit RoundedDistance(double rounding) : square_(rounding * rounding) {}
  void Evaluate(double s, double rho[3]) const override {
    const double root = std::sqrt(s + square_);
    rho[0] = 2 * root;
    rho[1] = 1 / root;
    rho[2] = -0.5 / (root * (s + square_));
  }

 private:
  double square_;
};

/// The residuals at the point Ceres looks at, and their derivatives by the scaled unknowns.
class Simulated : public ceres::EvaluationCallback {
 public:
  Simulated(const Problem& problem, FitJournal& journal, const VectorXd& y)
      : problem_(problem), journal_(journal), y_(y) {}

  void PrepareForEvaluation(bool jacobians, bool new_point) override {
    if (!new_point && (!jacobians || with_jacobian_)) return;
    const VectorXd x = from_scaled(problem_, y_);
    const Evaluation evaluation = journal_.evaluate_residuals(x, jacobians);
    ok = evaluation.ok;
    with_jacobian_ = jacobians;
    if (!ok) return;
    residuals = residuals_of(problem_, evaluation, Part::kFit);
    if (!jacobians) return;
    for (Index j = 0; j < x.size(); ++j)
      if (problem_.unknowns()[static_cast<std::size_t>(j)].scale == Scale::kLogarithmic)
        residuals.jacobian.col(j) *= x[j];
  }

  bool ok = false;
  Residuals residuals;

 private:
  const Problem& problem_;
  FitJournal& journal_;
  const VectorXd& y_;  // what Ceres moves
  bool with_jacobian_ = false;
};

/// `count` residuals from `first` on, each divided by `noise`.
class Block : public ceres::CostFunction {
 public:
  Block(const Simulated& simulated, Index first, int count, double noise, int unknowns)
      : simulated_(simulated), first_(first), noise_(noise) {
    set_num_residuals(count);
    mutable_parameter_block_sizes()->push_back(unknowns);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (!simulated_.ok) return false;
    const Residuals& all = simulated_.residuals;
    for (int i = 0; i < num_residuals(); ++i) residuals[i] = all.value[first_ + i] / noise_;
    if (!jacobians || !jacobians[0]) return true;
    const Index unknowns = all.jacobian.cols();
    for (int i = 0; i < num_residuals(); ++i)
      Eigen::Map<Eigen::RowVectorXd>(jacobians[0] + i * unknowns, unknowns) =
          all.jacobian.row(first_ + i) / noise_;
    return true;
  }

 private:
  const Simulated& simulated_;
  Index first_;
  double noise_;
};

/// Stops where the caller wants it.
class Watch : public ceres::IterationCallback {
 public:
  explicit Watch(FitJournal& journal) : journal_(journal) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    journal_.count_iteration();
    return journal_.must_stop() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  FitJournal& journal_;
};

ceres::LossFunction* loss_of(const ErrorSpec& error, double rounding) {
  if (error.measure != Measure::kLeastSquares) return new RoundedDistance(rounding);
  switch (error.loss) {
    case Loss::kHuber:
      return new ceres::HuberLoss(error.loss_scale);
    case Loss::kSoftL1:
      return new ceres::SoftLOneLoss(error.loss_scale);
    case Loss::kCauchy:
      return new ceres::CauchyLoss(error.loss_scale);
    case Loss::kNone:
      break;
  }
  return nullptr;
}

bool same_point(const Problem& problem, const ResidualIndex& a, const ResidualIndex& b) {
  if (a.experiment != b.experiment || a.frame != b.frame) return false;
  const auto& channels =
      problem.experiments()[static_cast<std::size_t>(a.experiment)].recording.channels;
  return channels[static_cast<std::size_t>(a.channel)].point ==
         channels[static_cast<std::size_t>(b.channel)].point;
}

}  // namespace

FitResult fit_least_squares(const Problem& problem, const FitOptions& options) {
  const OptimiserSpec& spec = problem.study().optimiser;
  const ErrorSpec& error = problem.study().error;
  FitJournal journal(problem, options, spec.max_evaluations);
  VectorXd y = to_scaled(problem, options.start.size() ? options.start : problem.start());
  const int unknowns = static_cast<int>(y.size());
  Simulated simulated(problem, journal, y);
  simulated.PrepareForEvaluation(true, true);
  if (!simulated.ok) return journal.result(FitStatus::kFailed, "the simulation at the start failed");

  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &simulated;
  ceres::Problem solver(problem_options);
  solver.AddParameterBlock(y.data(), unknowns);
  const Residuals first = simulated.residuals;
  const VectorXd noise = noise_of(problem, first);
  // The rounding of a distance: far below what is there to be minimised.
  const double rounding = 1e-3 * std::sqrt(first.value.squaredNorm() / static_cast<double>(first.value.size()));
  const bool distances = error.measure == Measure::kMeanDistance;
  const VectorXd weights = error.measure == Measure::kMeanAbsolute
                               ? channel_weights(problem, first)
                               : VectorXd::Constant(first.value.size(), 1.0);
  for (Index i = 0; i < first.value.size();) {
    int count = 1;
    while (distances && i + count < first.value.size() &&
           same_point(problem, first.index[static_cast<std::size_t>(i)],
                      first.index[static_cast<std::size_t>(i + count)]))
      ++count;
    const bool squares = error.measure == Measure::kLeastSquares;
    ceres::LossFunction* loss = loss_of(error, rounding);
    if (error.measure == Measure::kMeanAbsolute)
      loss = new ceres::ScaledLoss(loss, weights[i] / weights.maxCoeff(), ceres::TAKE_OWNERSHIP);
    solver.AddResidualBlock(new Block(simulated, i, count, squares ? noise[i] : 1.0, unknowns), loss,
                            y.data());
    i += count;
  }
  VectorXd lower(unknowns), upper(unknowns);
  for (int j = 0; j < unknowns; ++j) {
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    const bool logarithmic = unknown.scale == Scale::kLogarithmic;
    lower[j] = logarithmic ? std::log(unknown.lower) : unknown.lower;
    upper[j] = logarithmic ? std::log(unknown.upper) : unknown.upper;
    if (std::isfinite(lower[j])) solver.SetParameterLowerBound(y.data(), j, lower[j]);
    if (std::isfinite(upper[j])) solver.SetParameterUpperBound(y.data(), j, upper[j]);
  }

  Watch watch(journal);
  ceres::Solver::Options settings;
  settings.linear_solver_type = ceres::DENSE_QR;
  settings.max_num_iterations = spec.max_evaluations;
  settings.function_tolerance = 1e-2 * spec.tolerance;
  settings.parameter_tolerance = 1e-2 * spec.tolerance;
  settings.gradient_tolerance = 0;
  settings.logging_type = ceres::SILENT;
  settings.callbacks.push_back(&watch);
  const ceres::Solver::Summary summary =
      solve_within_bounds(settings, solver, y, lower, upper);
  FitStatus status = FitStatus::kConverged;
  if (summary.termination_type == ceres::USER_FAILURE)
    status = journal.why_stopped();
  else if (summary.termination_type == ceres::NO_CONVERGENCE)
    status = FitStatus::kEvaluationLimit;
  else if (summary.termination_type == ceres::FAILURE)
    status = FitStatus::kFailed;
  return journal.result(status, status == FitStatus::kFailed ? summary.message : "");
}

}  // namespace catena
