// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/least_squares.hpp"

#include <ceres/ceres.h>

#include <Eigen/QR>
#include <cmath>
#include <limits>
#include <optional>

#include "identify/fit/easier_problems.hpp"
#include "identify/fit/error.hpp"
#include "identify/fit/fit_journal.hpp"
#include "identify/fit/loss.hpp"
#include "identify/least_squares/condensed_rows.hpp"
#include "identify/least_squares/distance_cost.hpp"
#include "identify/least_squares/relative_steps.hpp"
#include "identify/least_squares/simulated_residuals.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A constant added to every distance, in units of the error at the start (see DistanceCost).
constexpr double kOffset = 20;

/// All squares of a problem as one block: the cost by the case's loss, and one row more than unknowns,
/// with which every step has the cost that the residuals and constraints have, linearised and each
/// with the weight that its loss gives it here. Of Triggs' correction, losses that flatten need no
/// more than this weight. Where the best step goes beyond bounds, the rows are those of a model whose minimum is the best
/// step within them (QuadraticModel): Ceres would take the step beyond and move what is beyond back to its bound, with all
/// other unknowns where they are right for a value that it cannot have.
class SquaresCost : public ceres::CostFunction, public ceres::LossFunction {
 public:
  /// `noise`: of each residual. `simulated` must be ok.
  SquaresCost(const SimulatedResiduals& simulated, VectorXd noise, const ErrorSpec& error)
      : simulated_(simulated), noise_(std::move(noise)), error_(error) {
    const auto unknowns = static_cast<int>(simulated_.residuals().jacobian.cols());
    set_num_residuals(unknowns + 1);
    mutable_parameter_block_sizes()->push_back(unknowns);
  }

  /// To be called where Ceres is about to ask for derivatives. `within`: the steps it may take. Returns the share of the
  /// cost that the best step of Gauss and Newton promises.
  double linearise(const RelativeSteps::Box& within) {
    const Residuals& residuals = simulated_.residuals();
    const SoftConstraints& constraints = simulated_.constraints();
    VectorXd weights = noise_.cwiseInverse();
    if (error_.loss != Loss::kNone)
      for (Index i = 0; i < noise_.size(); ++i)
        weights[i] *= std::sqrt(loss_of(error_, std::pow(residuals.value[i] / noise_[i], 2)).slope);
    rows_ = condensed(residuals, weights, constraints);
    QuadraticModel model{rows_.jacobian.transpose() * rows_.value,
                         rows_.jacobian.transpose() * rows_.jacobian};
    VectorXd step = best_step(model);
    const bool beyond =
        (step.array() < within.lower.array()).any() || (step.array() > within.upper.array()).any();
    if (beyond) step = bounded_step(model.gradient, model.curvature, within.lower, within.upper);
    const double gain = model.gain(step);
    if (beyond && gain > 0) {
      model.put_minimum(step, gain);
      const LinearRows bounded = model.rows();
      rows_.value << bounded.value, 0;
      rows_.jacobian << bounded.jacobian, Eigen::RowVectorXd::Zero(step.size());
    }
    return 2 * gain / cost();
  }

  /// Rows only; the cost is the loss's.
  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (!simulated_.ok()) return false;
    Eigen::Map<VectorXd>(residuals, num_residuals()) = rows_.value;
    if (jacobians && jacobians[0])
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          jacobians[0], num_residuals(), rows_.jacobian.cols()) = rows_.jacobian;
    return true;
  }

  /// As the loss of the block: its rows stay as they are.
  void Evaluate(double, double out[3]) const override {
    out[0] = cost();
    out[1] = 1;
    out[2] = 0;
  }

 private:
  /// Twice what Ceres calls so, here.
  double cost() const {
    const SoftConstraints& constraints = simulated_.constraints();
    double sum = constraints.value.cwiseProduct(constraints.weight).squaredNorm();
    for (Index i = 0; i < noise_.size(); ++i)
      sum += loss_of(error_, std::pow(simulated_.residuals().value[i] / noise_[i], 2)).value;
    return sum;
  }

  /// Without bounds.
  static VectorXd best_step(const QuadraticModel& model) {
    const VectorXd scale = model.curvature.diagonal().unaryExpr(
        [](double size) { return size > 0 ? 1 / std::sqrt(size) : 0.0; });
    const MatrixXd alike = scale.asDiagonal() * model.curvature * scale.asDiagonal();
    return -scale.cwiseProduct(
        alike.completeOrthogonalDecomposition().solve(scale.cwiseProduct(model.gradient)));
  }

  const SimulatedResiduals& simulated_;
  VectorXd noise_;
  const ErrorSpec& error_;
  LinearRows rows_;
};

// A first step that promises this share of the cost, of which less than the second share is ever
// kept: the sensitivities describe a slope too short to walk on.
constexpr double kGreatPromise = 1e-2, kKept = 1e-3;

// At a minimum on kinks, as sums of distances have, so many steps in a row fail, or gain less than
// so many tolerances of the cost.
constexpr int kFailedSteps = 3;
constexpr double kTooLittle = 10;

// Where a step promises no more than this share of the cost, the noise of the error is measured.
constexpr double kNear = 1e-3;

/// Stops where the caller wants it, and where a step changed the cost, or could have lowered it, by
/// no more than `tolerance` of it; `offset` is no cost. Also where the best step promises no more
/// than `enough` of the cost, and with `kinks` where steps keep failing.
class Watch : public ceres::IterationCallback {
 public:
  /// `reserved`: evaluations to be left. `promised`: by a first step that is too short, of which
  /// Ceres does not tell. `promise` and `enough` change with each point whose derivatives Ceres has.
  Watch(FitJournal& journal, int reserved, double tolerance, double offset, bool kinks,
        double promised, const double& promise, const double& enough)
      : journal_(journal),
        reserved_(reserved),
        tolerance_(tolerance),
        offset_(offset),
        kinks_(kinks),
        promised_(promised),
        promise_(promise),
        enough_(enough) {}

  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    journal_.count_iteration();
    if (journal_.must_stop(reserved_)) return ceres::SOLVER_ABORT;
    const double cost = step.cost - offset_;
    if (step.iteration > 0 && step.step_is_successful) gained_ += step.cost_change / cost;
    if (promise_ <= enough_) {
      if (step.iteration == 0) promised_ = promise_;
      return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    }
    if (step.iteration == 0 || !step.step_is_valid) return ceres::SOLVER_CONTINUE;
    const double expected = step.cost_change / step.relative_decrease;  // by the linearised model
    if (step.iteration == 1) promised_ = expected / cost;
    const bool good = step.step_is_successful && step.cost_change > kTooLittle * tolerance_ * cost;
    failed_steps_ = good ? 0 : failed_steps_ + 1;
    if (kinks_ && failed_steps_ == kFailedSteps) return ceres::SOLVER_TERMINATE_SUCCESSFULLY;
    const double least = tolerance_ * cost;
    const bool enough = expected <= least || std::abs(step.cost_change) <= least;
    return enough ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }

  /// Hardly anything was gained, although much was to be.
  bool stuck() const { return promised_ > kGreatPromise && gained_ < kKept * promised_; }

 private:
  FitJournal& journal_;
  int reserved_;
  double tolerance_, offset_;
  bool kinks_;
  int failed_steps_ = 0;          // in a row
  double promised_, gained_ = 0;  // shares of the cost
  const double &promise_, &enough_;
};

// A step that promises no more than this share of the cost is likely to be the last.
constexpr double kLastStep = 1e-4;

// How far one step may take a logarithm.
constexpr double kReach = 2;

/// Of the scaled unknowns.
DistanceCost::Box box_of(const Problem& problem) {
  const auto unknowns = static_cast<Index>(problem.unknowns().size());
  UnknownBounds bounds = scaled_bounds(problem);
  DistanceCost::Box box{std::move(bounds.lower), std::move(bounds.upper), VectorXd(unknowns)};
  for (Index j = 0; j < unknowns; ++j) {
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    box.reach[j] =
        unknown.scale == Scale::kLogarithmic ? kReach : std::numeric_limits<double>::infinity();
  }
  return box;
}

/// Of every unknown, whether it is fitted by its logarithm.
std::vector<bool> logarithms(const Problem& problem) {
  std::vector<bool> logarithms;
  for (const Unknown& unknown : problem.unknowns())
    logarithms.push_back(unknown.scale == Scale::kLogarithmic);
  return logarithms;
}

bool of_squares(const Problem& problem) {
  const Measure measure = problem.the_case().error.measure;
  return measure == Measure::kLeastSquares || measure == Measure::kLikelihood;
}

/// From y on, where `simulated` is, to the best y; the weights are those of the start. `reserved`:
/// evaluations to be left.
FitStatus solve(const Problem& problem, FitJournal& journal, int reserved,
                SimulatedResiduals& simulated, VectorXd& y, std::string& message) {
  const OptimiserSpec& spec = problem.the_case().optimiser;
  const ErrorSpec& error = problem.the_case().error;
  const int unknowns = static_cast<int>(y.size());
  // All that Ceres is given stays ours: it would not give back what it could not take.
  std::optional<SquaresCost> sum;
  std::optional<DistanceCost> distances;
  RelativeSteps steps(logarithms(problem));
  ceres::Problem::Options problem_options;
  problem_options.evaluation_callback = &simulated;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem solver(problem_options);
  solver.AddParameterBlock(y.data(), unknowns);
  const Residuals& first = simulated.residuals();
  const bool squares = of_squares(problem);
  const double tolerance = (squares ? 1e-2 : 0.1) * spec.tolerance;  // of the cost
  const double asked = std::max(tolerance, journal.options().enough);
  const DistanceCost::Box box = box_of(problem);
  double all_offsets = 0;
  double promise = 0, enough = asked;  // shares of the cost, here
  const auto arrive = [&](double promised) {
    promise = promised;
    const bool near = promise > asked && promise <= kNear && enough == asked;
    if (!near || journal.must_stop(reserved + 1)) return;
    const double noise =
        journal.measure_noise(finer(problem), from_scaled(problem, y), simulated.error());
    enough = std::max(enough, (squares ? 2 : 1) * noise / simulated.error());
  };
  if (squares) {
    sum.emplace(simulated, noise_of(problem, first), error);
    solver.AddResidualBlock(&*sum, &*sum, y.data());
    solver.SetManifold(y.data(), &steps);
    simulated.tell([&] {
      arrive(sum->linearise(steps.box(y, box.lower, box.upper)));
      return true;
    });
  } else {
    // In units of the start's error, as if each were over its noise.
    const double scale = static_cast<double>(first.value.size()) / simulated.error();
    std::vector<WeightedDistance> terms;
    if (error.measure == Measure::kMeanDistance) {
      const std::vector<Distance> points = distances_of(problem, first);
      for (const Distance& point : points)
        terms.push_back({point.first, point.count, scale / static_cast<double>(points.size())});
    } else {
      const VectorXd weights = scale * channel_weights(problem, first);
      for (Index i = 0; i < weights.size(); ++i) terms.push_back({i, 1, weights[i]});
    }
    distances.emplace(simulated, std::move(terms), kOffset * simulated.error(), tolerance, box);
    solver.AddResidualBlock(&*distances, nullptr, y.data());
    all_offsets = distances->all_offsets();
    simulated.tell([&] {
      distances->step_to(y);
      arrive(distances->gain());
      return distances->gain() > kLastStep;
    });
  }
  for (int j = 0; j < unknowns; ++j) {
    if (std::isfinite(box.lower[j])) solver.SetParameterLowerBound(y.data(), j, box.lower[j]);
    if (std::isfinite(box.upper[j])) solver.SetParameterUpperBound(y.data(), j, box.upper[j]);
  }

  const double least_step = 1e-2 * spec.tolerance;  // of |y|
  const double lost = least_step * y.norm() * simulated.steepness();
  Watch watch(journal, reserved, tolerance, all_offsets, !squares, lost, promise, enough);
  ceres::Solver::Options settings;
  settings.linear_solver_type = ceres::DENSE_QR;
  settings.max_num_iterations = spec.max_evaluations;
  settings.function_tolerance = 0;  // Watch knows better
  settings.parameter_tolerance = least_step;
  settings.gradient_tolerance = 0;
  // Bounds make Ceres search along steps: cubic interpolation would ask for derivatives there.
  if (!squares) settings.line_search_interpolation_type = ceres::QUADRATIC;
  settings.logging_type = ceres::SILENT;
  settings.callbacks.push_back(&watch);
  ceres::Solver::Summary summary;
  ceres::Solve(settings, &solver, &summary);
  simulated.tell(nullptr);
  if (summary.termination_type == ceres::USER_FAILURE) return journal.why_stopped();
  if (summary.termination_type == ceres::NO_CONVERGENCE) return FitStatus::kEvaluationLimit;
  if (summary.termination_type == ceres::FAILURE) {
    if (journal.must_stop(reserved)) return journal.why_stopped();
    message = summary.message;
    return FitStatus::kFailed;
  }
  if (watch.stuck()) {
    message =
        "least squares cannot leave its start: the simulation is so sensitive there that its "
        "derivatives hold for no step; fit a beginning first (optimiser.growing_windows) or "
        "windows, "
        "or use nelder_mead";
    return FitStatus::kFailed;
  }
  return FitStatus::kConverged;
}

/// The same, first roughly simulated: most of the way there is no need for more.
FitStatus solve_roughly(const Problem& rough, FitJournal& journal, SimulatedResiduals& simulated,
                        VectorXd& y) {
  const VectorXd start = y;
  simulated.PrepareForEvaluation(true, true);
  FitStatus status = FitStatus::kFailed;
  std::string message;
  if (simulated.ok()) status = solve(rough, journal, 1, simulated, y, message);
  if (status == FitStatus::kFailed) y = start;
  return status;
}

}  // namespace

FitResult fit_least_squares(const Problem& problem, const FitOptions& options) {
  const OptimiserSpec& spec = problem.the_case().optimiser;
  FitJournal journal(problem, options, spec.max_evaluations);
  VectorXd y = to_scaled(problem, options.start.size() ? options.start : problem.start());
  std::string message;
  if (!of_squares(problem)) {
    const bool roughly = starts_roughly(problem) && spec.max_evaluations > 1;
    const Problem easier = roughly ? rough(problem) : problem;
    SimulatedResiduals simulated(problem, journal, y, roughly ? &easier : nullptr);
    if (roughly) {
      const FitStatus status = solve_roughly(easier, journal, simulated, y);
      if (status == FitStatus::kInterrupted || status == FitStatus::kTimeLimit)
        return journal.result(status, "");
      simulated.refine();
    }
    simulated.PrepareForEvaluation(true, true);
    if (!simulated.ok())
      return journal.result(FitStatus::kFailed, "the simulation at the start failed");
    if (journal.must_stop()) return journal.result(journal.why_stopped(), "");
    const FitStatus status = solve(problem, journal, 0, simulated, y, message);
    return journal.result(status, message);
  }
  SimulatedResiduals simulated(problem, journal, y);
  // Under the likelihood the weights follow from the residuals: solved again until they stay.
  for (double before = std::numeric_limits<double>::infinity();;) {
    simulated.PrepareForEvaluation(true, true);
    if (!simulated.ok())
      return journal.result(FitStatus::kFailed, "the simulation at the start failed");
    const bool settled = simulated.error() > (1 - 1e-2 * spec.tolerance) * before;
    if (settled) return journal.result(FitStatus::kConverged, "");
    before = simulated.error();
    const FitStatus status = solve(problem, journal, 0, simulated, y, message);
    if (status != FitStatus::kConverged || problem.the_case().error.measure != Measure::kLikelihood)
      return journal.result(status, message);
  }
}

}  // namespace catena
