// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/force_path.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "runtime/status.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// s. The rule's error must be far below the noise over the root of the number of frames: 1/480 s
/// left 0.034 mm in a cable of 24 links.
constexpr double kStep = 1.0 / 960;

/// Deviation of the logarithm of a parameter, where the case gives no prior: half as much again. A
/// fit without the force is wrong by about as much as the force can imitate.
constexpr double kRelativeDeviation = 0.4;
/// The same where that fit ended at a bound: it does not tell the size, perhaps not to a factor of ten.
constexpr double kBoundDeviation = 2.3;
/// A value so near to a bound, over the bound, is at it.
constexpr double kAtBound = 0.01;
/// Of a logarithm: the most that one linearisation may change it.
constexpr double kLargestChange = 1;
/// rad, rad/s: of coefficients of the start.
constexpr double kStartDeviation = 0.2;
/// Of the admissible range of any other.
constexpr double kRangeDeviation = 0.25;

constexpr int kMostLinearisations = 12;
/// Root mean square change of what the sensors would see, in standard deviations, and gain of log
/// evidence, from which on nothing is iterated.
constexpr double kSettled = 0.02;
constexpr double kSettledEvidence = 1;
/// Bounds of one change of a variance.
constexpr double kLeastGrowth = 0.02, kMostGrowth = 100;
/// The evidence is compared at the prior's time scale and at it times and over this; one change is
/// at most so many of these steps.
constexpr double kScaleStep = 1.5, kMostScaleSteps = 2;
/// s: some frames; longer than the pendulum swings of any recording that was tried.
constexpr double kShortestScale = 0.02, kLongestScale = 5;

}  // namespace

LatentUnknowns::LatentUnknowns(const Problem& problem, const VectorXd& x)
    : problem_(problem), centre_(x), deviation_(x.size()) {
  const auto& list = problem.unknowns();
  for (std::size_t j = 0; j < list.size(); ++j) {
    const Unknown& unknown = list[j];
    const auto i = static_cast<Index>(j);
    logarithmic_.push_back(unknown.parameter >= 0 && unknown.lower >= 0 && x[i] > 0);
    if (unknown.experiment < 0) shared_.push_back(i);
    if (unknown.parameter < 0)
      deviation_[i] = kStartDeviation;
    else if (logarithmic_.back())
      deviation_[i] = std::abs(x[i] - unknown.lower) <= kAtBound * unknown.lower ||
                              std::abs(x[i] - unknown.upper) <= kAtBound * unknown.upper
                          ? kBoundDeviation
                          : kRelativeDeviation;
    else if (std::isfinite(unknown.upper - unknown.lower))
      deviation_[i] = kRangeDeviation * (unknown.upper - unknown.lower);
    else
      deviation_[i] = std::max(1.0, std::abs(x[i]));
    if (unknown.parameter < 0) continue;
    const ParameterSpec& spec =
        problem.the_case().parameters[static_cast<std::size_t>(unknown.parameter)];
    if (!std::isfinite(spec.standard_deviation) || !std::isfinite(spec.measured)) continue;
    if (logarithmic_.back() && spec.measured <= 0) continue;
    centre_[i] = spec.measured;
    deviation_[i] = spec.standard_deviation / (logarithmic_.back() ? spec.measured : 1.0);
  }
}

std::vector<Index> LatentUnknowns::own(int experiment) const {
  std::vector<Index> list;
  for (std::size_t j = 0; j < problem_.unknowns().size(); ++j)
    if (problem_.unknowns()[j].experiment == experiment) list.push_back(static_cast<Index>(j));
  return list;
}

VectorXd LatentUnknowns::mean(const std::vector<Index>& which, const VectorXd& x) const {
  VectorXd mean(static_cast<Index>(which.size()));
  for (std::size_t j = 0; j < which.size(); ++j) {
    const Index i = which[j];
    mean[static_cast<Index>(j)] =
        logarithmic_[static_cast<std::size_t>(i)] ? std::log(centre_[i] / x[i]) : centre_[i] - x[i];
  }
  return mean;
}

VectorXd LatentUnknowns::deviation(const std::vector<Index>& which) const {
  VectorXd deviation(static_cast<Index>(which.size()));
  for (std::size_t j = 0; j < which.size(); ++j)
    deviation[static_cast<Index>(j)] = deviation_[which[j]];
  return deviation;
}

double LatentUnknowns::moved(Index unknown, double value, double by) const {
  const auto j = static_cast<std::size_t>(unknown);
  const Unknown& limits = problem_.unknowns()[j];
  return std::clamp(logarithmic_[j]
                        ? value * std::exp(std::clamp(by, -kLargestChange, kLargestChange))
                        : value + by,
                    limits.lower, limits.upper);
}

ForcePaths::ForcePaths(const Problem& problem, const LatentUnknowns& unknowns,
                       const std::vector<double>& sigmas, const VectorXd& x,
                       const std::function<bool()>& keep_going)
    : problem_(problem), unknowns_(unknowns), sigmas_(sigmas), keep_going_(keep_going), x_(x) {
  const auto& experiments = problem.experiments();
  const auto goes_on = [&](double) { return !keep_going || keep_going(); };
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    if (!experiments[e].fitted()) continue;
    const auto number = static_cast<int>(e);
    const Prediction prediction = problem.predict(x, number, false, {}, goes_on);
    if (!prediction.ok()) {
      paths_.clear();
      return;
    }
    const Trajectory& trajectory = prediction.trajectory;
    ForcePath& path = paths_.emplace_back();
    path.experiment = number;
    path.state.resize(2 * trajectory.q.rows() + trajectory.z.rows(), trajectory.q.cols());
    path.state << trajectory.q, trajectory.v, trajectory.z;
    clocks_.push_back(frame_clock(problem.model(), experiments[e],
                                  problem.model_parameters(x, number),
                                  experiments[e].recording.fit_frames));
  }
}

const Recording& ForcePaths::recording(std::size_t path) const {
  return problem_.experiments()[static_cast<std::size_t>(paths_[path].experiment)].recording;
}

double ForcePaths::sigma(std::size_t path) const {
  return sigmas_[static_cast<std::size_t>(paths_[path].experiment)];
}

std::vector<std::vector<ForcePaths::SeenValue>> ForcePaths::seen_values(std::size_t path) const {
  const FrameClock& clock = clocks_[path];
  const Eigen::MatrixXd& measured = recording(path).measured;
  std::vector<std::vector<SeenValue>> values(clock.times.size());
  for (Index k = 0; k < recording(path).fit_frames; ++k)
    for (Index c = 0; c < measured.rows(); ++c)
      if (!std::isnan(measured(c, k)))
        values[static_cast<std::size_t>(clock.column[static_cast<std::size_t>(k)])].push_back(
            {k, static_cast<std::size_t>(c)});
  return values;
}

void ForcePaths::act(std::vector<ForcePattern> patterns) {
  patterns_ = std::move(patterns);
  for (ForcePath& path : paths_)
    path.force.setZero(static_cast<Index>(2 * patterns_.size()), path.state.cols());
}

std::vector<LinearRecording::Seen> ForcePaths::observe(std::size_t number,
                                                       const std::vector<Index>& unknowns) const {
  const ForcePath& path = paths_[number];
  const Model& model = problem_.model();
  const Experiment& experiment = problem_.experiments()[static_cast<std::size_t>(path.experiment)];
  const Recording& recording = experiment.recording;
  const VectorXd parameters = problem_.model_parameters(x_, path.experiment);
  const auto by_unknown = problem_.directions(x_, path.experiment);
  const Index n = model.coordinates(), ny = path.state.rows();
  const double sigma = sigmas_[static_cast<std::size_t>(path.experiment)];

  std::vector<SensitivityDirection> along(static_cast<std::size_t>(n),
                                          SensitivityDirection::zero(model));
  for (const Index j : unknowns) {
    along.push_back(SensitivityDirection::zero(model));
    const VectorXd& change = by_unknown[static_cast<std::size_t>(j)].parameters;
    if (change.size() > 0) along.back().parameters = unknowns_.slope(j, x_) * change;
  }
  Observer observer(model, experiment, parameters, along);
  Trajectory here;
  here.time.resize(1);
  Trajectory change = here;
  change.q.setZero(n, 1);
  change.v.setZero(n, 1);
  change.z.setZero(model.states(), 1);

  const FrameClock& clock = clocks_[number];
  const std::vector<std::vector<SeenValue>> values = seen_values(number);
  std::vector<LinearRecording::Seen> seen(values.size());
  for (std::size_t node = 0; node < values.size(); ++node) {
    const auto count = static_cast<Index>(values[node].size());
    LinearRecording::Seen& out = seen[node];
    out.value.resize(count);
    out.by_state.setZero(count, ny);
    out.by_parameter.setZero(count, static_cast<Index>(unknowns.size()));
    here.time[0] = clock.times[node];
    here.q = path.state.col(static_cast<Index>(node)).head(n);
    here.v = path.state.col(static_cast<Index>(node)).segment(n, n);
    here.z = path.state.col(static_cast<Index>(node)).tail(model.states());
    for (Index first = 0, next = 0; first < count; first = next) {
      const Index k = values[node][static_cast<std::size_t>(first)].frame;
      while (next < count && values[node][static_cast<std::size_t>(next)].frame == k) ++next;
      const auto frame = static_cast<std::size_t>(k);
      observer.move_to(here, 0, recording.time[frame]);
      const auto each = [&](const auto& act) {
        for (Index row = first; row < next; ++row) {
          const std::size_t c = values[node][static_cast<std::size_t>(row)].channel;
          act(row, observer(recording.channels[c]), recording.measured(static_cast<Index>(c), k));
        }
      };
      each([&](Index row, double simulated, double measured) {
        out.value[row] = (measured - simulated) / sigma;
      });
      for (std::size_t j = 0; j < along.size(); ++j) {
        const auto column = static_cast<Index>(j);
        if (column < n) change.q(column, 0) = 1;
        observer.look_along(change, j, clock.held[frame]);
        if (column < n) change.q(column, 0) = 0;
        each([&](Index row, double by, double) {
          (column < n ? out.by_state(row, column) : out.by_parameter(row, column - n)) = by / sigma;
        });
      }
    }
  }
  return seen;
}

std::optional<LinearProblem> ForcePaths::linearise(int finer) const {
  const Model& model = problem_.model();
  const Index n = model.coordinates();
  LinearProblem linear;
  linear.shared_mean = unknowns_.mean(unknowns_.shared(), x_);
  linear.shared_deviation = unknowns_.deviation(unknowns_.shared());
  for (std::size_t number = 0; number < paths_.size(); ++number) {
    const ForcePath& path = paths_[number];
    const Experiment& experiment =
        problem_.experiments()[static_cast<std::size_t>(path.experiment)];
    std::vector<Index> unknowns = unknowns_.own(path.experiment);
    LinearRecording& recording = linear.recordings.emplace_back();
    recording.own_mean = unknowns_.mean(unknowns, x_);
    recording.own_deviation = unknowns_.deviation(unknowns);
    unknowns.insert(unknowns.begin(), unknowns_.shared().begin(), unknowns_.shared().end());

    const VectorXd parameters = problem_.model_parameters(x_, path.experiment);
    const State start = problem_.initial_state(x_, path.experiment);
    VectorXd begin(path.state.rows());
    begin << start.q, start.v, start.z;
    recording.start_offset = begin - path.state.col(0);
    recording.start_by_parameter.setZero(begin.size(), static_cast<Index>(unknowns.size()));
    const auto by_unknown = problem_.directions(x_, path.experiment);
    std::vector<SensitivityDirection> along;
    for (std::size_t j = 0; j < unknowns.size(); ++j) {
      const SensitivityDirection& direction = by_unknown[static_cast<std::size_t>(unknowns[j])];
      const double slope = unknowns_.slope(unknowns[j], x_);
      const auto column = static_cast<Index>(j);
      if (direction.q.size() > 0)
        recording.start_by_parameter.col(column).head(n) = slope * direction.q;
      if (direction.v.size() > 0)
        recording.start_by_parameter.col(column).segment(n, n) = slope * direction.v;
      along.push_back(SensitivityDirection::zero(model));
      if (direction.parameters.size() > 0) along.back().parameters = slope * direction.parameters;
    }

    IntervalIntegrator integrate(model, parameters, experiment.signals, patterns_, along,
                                 kStep / finer);
    const std::vector<double>& times = clocks_[number].times;
    for (std::size_t k = 0; k + 1 < times.size(); ++k) {
      if (keep_going_ && !keep_going_()) return std::nullopt;
      const auto node = static_cast<Index>(k);
      std::optional<IntervalMap> map =
          integrate(times[k], times[k + 1], path.state.col(node), path.force.col(node));
      if (!map) return std::nullopt;
      LinearRecording::Step& step = recording.steps.emplace_back();
      step.offset = map->end - path.state.col(node + 1) - map->by_force * path.force.col(node);
      step.by_state = std::move(map->by_state);
      step.by_force = std::move(map->by_force);
      step.by_parameter = std::move(map->by_parameter);
      step.duration = times[k + 1] - times[k];
    }
    recording.seen = observe(number, unknowns);
  }
  return linear;
}

double ForcePaths::move(const LinearProblem& linear, const Smoothed& smoothed) {
  double sum = 0, count = 0;
  for (std::size_t number = 0; number < paths_.size(); ++number) {
    ForcePath& path = paths_[number];
    const Smoothed::Recording& to = smoothed.recordings[number];
    VectorXd p(smoothed.shared.size() + to.own.size());
    p << smoothed.shared, to.own;
    for (std::size_t k = 0; k < linear.recordings[number].seen.size(); ++k) {
      const LinearRecording::Seen& seen = linear.recordings[number].seen[k];
      sum += (seen.by_state * to.state.col(static_cast<Index>(k)) + seen.by_parameter * p)
                 .squaredNorm();
      count += static_cast<double>(seen.value.size());
    }
    path.state += to.state.topRows(path.state.rows());
    path.force = to.force;
    const std::vector<Index> own = unknowns_.own(path.experiment);
    for (std::size_t j = 0; j < own.size(); ++j)
      x_[own[j]] = unknowns_.moved(own[j], x_[own[j]], to.own[static_cast<Index>(j)]);
  }
  for (std::size_t j = 0; j < unknowns_.shared().size(); ++j) {
    const Index i = unknowns_.shared()[j];
    x_[i] = unknowns_.moved(i, x_[i], smoothed.shared[static_cast<Index>(j)]);
  }
  return std::sqrt(sum / std::max(1.0, count));
}

void ForcePaths::take_forces(const std::vector<MatrixXd>& forces) {
  for (std::size_t number = 0; number < paths_.size(); ++number) {
    const MatrixXd& taken = forces[number];
    MatrixXd& force = paths_[number].force;
    force.setZero(2 * taken.rows(), taken.cols());
    for (Index k = 0; k < taken.cols(); ++k) {
      const auto node = static_cast<std::size_t>(k);
      for (Index m = 0; m < taken.rows(); ++m) {
        force(2 * m, k) = taken(m, k);
        if (k + 1 < taken.cols())
          force(2 * m + 1, k) = (taken(m, k + 1) - taken(m, k)) /
                                (clocks_[number].times[node + 1] - clocks_[number].times[node]);
      }
    }
  }
}

/// Moves the prior's time scale towards the largest evidence, and the variances so that the prior
/// of fast forces stays: variance / time scale^3.
void ForcePaths::rescale(const LinearProblem& linear, const std::vector<ActingForce>& acting,
                         const std::vector<double>& largest, std::vector<double>& variance) {
  const auto scaled = [&](double factor) {
    ForcePrior other = prior;
    other.time_scale *= factor;
    std::vector<double> variances = variance;
    for (std::size_t g = 0; g < variances.size(); ++g)
      variances[g] = std::min(variances[g] * (factor * factor * factor), largest[g]);
    return std::pair(other, variances);
  };
  const auto evidence = [&](double factor) {
    const auto [other, variances] = scaled(factor);
    return smooth_forces(linear, acting, variances, other, false).log_evidence;
  };
  const double less = evidence(1 / kScaleStep), here = evidence(1), more = evidence(kScaleStep);
  if (!std::isfinite(less + here + more)) return;
  const double slope = 0.5 * (more - less), bend = more - 2 * here + less;
  double steps = slope > 0 ? 1 : -1;
  if (bend < 0) steps = std::clamp(-slope / bend, -kMostScaleSteps, kMostScaleSteps);
  const double factor =
      std::clamp(prior.time_scale * std::pow(kScaleStep, steps), kShortestScale, kLongestScale) /
      prior.time_scale;
  std::tie(prior, variance) = scaled(factor);
}

std::optional<Smoothed> ForcePaths::settle(std::vector<double>& variance,
                                           const std::vector<double>& largest,
                                           bool with_time_scale) {
  std::vector<ActingForce> acting;
  for (std::size_t m = 0; m < patterns_.size(); ++m)
    acting.push_back({static_cast<Index>(m), patterns_[m].group});
  std::optional<Smoothed> smoothed;
  for (int iteration = 0; iteration < kMostLinearisations; ++iteration) {
    const std::optional<LinearProblem> linear = linearise();
    if (!linear) return std::nullopt;
    const double before = smoothed ? smoothed->log_evidence : -HUGE_VAL;
    smoothed = smooth_forces(*linear, acting, variance, prior, true);
    if (!std::isfinite(smoothed->log_evidence)) return std::nullopt;
    const double moved = move(*linear, *smoothed);
    if (moved < kSettled && smoothed->log_evidence - before < kSettledEvidence) break;
    for (std::size_t g = 0; g < variance.size(); ++g)
      variance[g] =
          std::clamp(variance[g] * std::clamp(smoothed->growth[g], kLeastGrowth, kMostGrowth),
                     std::min(1e-16, largest[g]), largest[g]);
    if (with_time_scale) rescale(*linear, acting, largest, variance);
  }
  return smoothed;
}

double ForcePaths::squares() const {
  double sum = 0;
  for (std::size_t number = 0; number < paths_.size(); ++number)
    for (const LinearRecording::Seen& seen : observe(number, {})) sum += seen.value.squaredNorm();
  return sum;
}

}  // namespace catena
