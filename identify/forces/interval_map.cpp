// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/interval_map.hpp"

#include <algorithm>
#include <cmath>

#include "identify/problem/parameter_map.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kMostNewtonSteps = 12;
/// Times the steps of an interval where Newton's iteration fails: a cable that snaps has accelerations that long steps do
/// not follow.
constexpr int kMostFiner = 8;
/// Change of the middle rates, relative to 1 rad/s, at which Newton's iteration has converged.
constexpr double kConverged = 1e-9;

constexpr std::size_t kWidth = CATENA_DIRECTIONS;

std::vector<std::vector<DirectionBatch>> zeros(std::size_t batches, std::size_t entries) {
  return std::vector(batches, std::vector<DirectionBatch>(entries, DirectionBatch{}));
}

}  // namespace

IntervalIntegrator::IntervalIntegrator(const Model& model, const VectorXd& parameters,
                                       const Signals& signals,
                                       const std::vector<ForcePattern>& patterns,
                                       const std::vector<SensitivityDirection>& directions,
                                       double step)
    : model_(model),
      dynamics_(model, parameters, signals),
      patterns_(patterns),
      step_(step),
      n_(model.coordinates()),
      states_(model.states()),
      forces_(static_cast<Index>(2 * patterns.size())),
      parameters_(static_cast<Index>(directions.size())),
      lengths_(link_lengths(model, parameters)),
      per_link_(model.in_space() ? 3 : 1),
      tangents_(model),
      batches_((static_cast<std::size_t>(2 * n_ + states_ + forces_ + parameters_) + kWidth - 1) /
               kWidth) {
  LinearSolver used;
  matrix_ = make_newton_matrix(model, LinearSolver::kAutomatic, used);
  const auto n = static_cast<std::size_t>(n_), states = static_cast<std::size_t>(states_);
  dp_ = zeros(batches_, static_cast<std::size_t>(model.parameters()));
  q_of_ = zeros(batches_, n);
  v_of_ = zeros(batches_, n);
  z_of_ = zeros(batches_, states);
  const auto first = static_cast<std::size_t>(2 * n_ + states_ + forces_);
  for (std::size_t j = 0; j < directions.size(); ++j) {
    const VectorXd& along = directions[j].parameters;
    for (Index i = 0; i < along.size(); ++i)
      dp_[(first + j) / kWidth][static_cast<std::size_t>(i)].of[(first + j) % kWidth] = along[i];
  }
  predicted_.assign(n, {});
  zero_.assign(std::max({n, states, static_cast<std::size_t>(3 * model.signals())}), {});
  change_.assign(n + states, {});
  rate_.assign(states, {});
  for (auto* values : {&q_, &v_, &a_, &middle_q_, &middle_v_, &force_, &predicted_q_})
    values->assign(n, 0.0);
  turning_.assign(static_cast<std::size_t>(per_link_ * per_link_ * lengths_.size()), 0.0);
  for (auto* values : {&z_, &middle_z_, &zdot_}) values->assign(states, 0.0);
  residual_.assign(n + states, 0.0);
  unit_force_.assign(patterns.size(), std::vector<double>(n, 0.0));
}

std::optional<IntervalMap> IntervalIntegrator::operator()(double begin, double end,
                                                          const VectorXd& state,
                                                          const VectorXd& force) {
  const int least = std::max(1, static_cast<int>(std::ceil((end - begin) / step_ - 1e-6)));
  for (int finer = 1; finer <= kMostFiner; finer *= 2) {
    begin_at(state);
    if (step_through(begin, end, force, least * finer)) return map_of_steps();
  }
  return std::nullopt;
}

void IntervalIntegrator::begin_at(const VectorXd& state) {
  std::copy_n(state.data(), n_, q_.begin());
  std::copy_n(state.data() + n_, n_, v_.begin());
  std::copy_n(state.data() + 2 * n_, states_, z_.begin());
  std::fill(a_.begin(), a_.end(), 0.0);
  for (auto* columns : {&q_of_, &v_of_, &z_of_})
    for (auto& batch : *columns) std::fill(batch.begin(), batch.end(), DirectionBatch{});
  for (Index j = 0; j < 2 * n_ + states_; ++j) {
    const auto b = static_cast<std::size_t>(j) / kWidth, k = static_cast<std::size_t>(j) % kWidth;
    if (j < n_)
      q_of_[b][static_cast<std::size_t>(j)].of[k] = 1;
    else if (j < 2 * n_)
      v_of_[b][static_cast<std::size_t>(j - n_)].of[k] = 1;
    else
      z_of_[b][static_cast<std::size_t>(j - 2 * n_)].of[k] = 1;
  }
}

bool IntervalIntegrator::step_through(double begin, double end, const VectorXd& force, int steps) {
  const double step = (end - begin) / steps;
  for (int k = 0; k < steps; ++k) {
    const double since = (k + 0.5) * step;
    if (!step_on(begin + since, step, force, since)) return false;
  }
  const auto finite = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  };
  return finite(q_) && finite(v_) && finite(z_);
}

IntervalMap IntervalIntegrator::map_of_steps() const {
  const Index ny = 2 * n_ + states_;
  IntervalMap map;
  map.end.resize(ny);
  std::copy_n(q_.begin(), n_, map.end.data());
  std::copy_n(v_.begin(), n_, map.end.data() + n_);
  std::copy_n(z_.begin(), states_, map.end.data() + 2 * n_);
  MatrixXd all(ny, static_cast<Index>(batches_ * kWidth));
  for (std::size_t b = 0; b < batches_; ++b)
    for (std::size_t k = 0; k < kWidth; ++k) {
      const auto column = static_cast<Index>(b * kWidth + k);
      for (Index i = 0; i < n_; ++i) {
        all(i, column) = q_of_[b][static_cast<std::size_t>(i)].of[k];
        all(n_ + i, column) = v_of_[b][static_cast<std::size_t>(i)].of[k];
      }
      for (Index i = 0; i < states_; ++i)
        all(2 * n_ + i, column) = z_of_[b][static_cast<std::size_t>(i)].of[k];
    }
  map.by_state = all.leftCols(ny);
  map.by_force = all.middleCols(ny, forces_);
  map.by_parameter = all.middleCols(ny + forces_, parameters_);
  return map;
}

/// One step around the time t, `since` s after the beginning of the interval: the middle rates are
/// v + gamma a, gamma half the step, and everything is taken at the middle.
bool IntervalIntegrator::step_on(double t, double step, const VectorXd& force, double since) {
  const auto n = static_cast<std::size_t>(n_), states = static_cast<std::size_t>(states_);
  const double gamma = 0.5 * step;
  for (std::size_t i = 0; i < n; ++i) predicted_q_[i] = q_[i] + gamma * v_[i];
  std::fill(force_.begin(), force_.end(), 0.0);
  std::fill(turning_.begin(), turning_.end(), 0.0);
  for (std::size_t m = 0; m < patterns_.size(); ++m) {
    const auto row = static_cast<Index>(2 * m);
    const double size = force[row] + since * force[row + 1];
    std::fill(unit_force_[m].begin(), unit_force_[m].end(), 0.0);
    add_generalised_force(patterns_[m], lengths_, predicted_q_.data(), 1.0, unit_force_[m].data());
    for (std::size_t i = 0; i < n; ++i) force_[i] += size * unit_force_[m][i];
    add_turning(patterns_[m], lengths_, predicted_q_.data(), size, turning_.data());
  }

  const auto to_middle = [&] {
    for (std::size_t i = 0; i < n; ++i) {
      middle_v_[i] = v_[i] + gamma * a_[i];
      middle_q_[i] = q_[i] + gamma * middle_v_[i];
    }
  };
  middle_z_ = z_;
  bool converged = false;
  for (int iteration = 0; iteration < kMostNewtonSteps && !converged; ++iteration) {
    to_middle();
    const catena_point at =
        dynamics_.at(t, middle_q_.data(), middle_v_.data(), a_.data(), middle_z_.data());
    if (iteration % 4 == 0 && matrix_->factor(dynamics_, at, gamma)) return false;
    model_.residual(at, residual_.data());
    if (states > 0) model_.state_rate(at, zdot_.data());
    for (std::size_t i = 0; i < n; ++i) residual_[i] = -gamma * (residual_[i] - force_[i]);
    for (std::size_t i = 0; i < states; ++i)
      residual_[n + i] = gamma * zdot_[i] - (middle_z_[i] - z_[i]);
    matrix_->solve(residual_.data());
    double largest = 0;
    for (std::size_t i = 0; i < n; ++i) {
      a_[i] += residual_[i] / gamma;
      largest = std::max(largest, std::abs(residual_[i]) / (1 + std::abs(middle_v_[i])));
    }
    for (std::size_t i = 0; i < states; ++i) middle_z_[i] += residual_[n + i];
    if (!std::isfinite(largest)) return false;
    converged = largest < kConverged;
  }
  if (!converged) return false;
  to_middle();
  const catena_point at =
      dynamics_.at(t, middle_q_.data(), middle_v_.data(), a_.data(), middle_z_.data());
  if (matrix_->factor(dynamics_, at, gamma)) return false;
  differentiate(t, gamma, since);
  for (std::size_t i = 0; i < n; ++i) {
    q_[i] = 2 * middle_q_[i] - q_[i];
    v_[i] = 2 * middle_v_[i] - v_[i];
  }
  for (std::size_t i = 0; i < states; ++i) z_[i] = 2 * middle_z_[i] - z_[i];
  return true;
}

/// Takes from the changes of the residual what the forces change as the links turn.
void IntervalIntegrator::turn_force() {
  const auto links = static_cast<std::size_t>(lengths_.size());
  const double* by = turning_.data();
  for (std::size_t link = 0; link < links; ++link)
    for (std::size_t i = 0; i < per_link_; ++i)
      for (std::size_t j = 0; j < per_link_; ++j, ++by)
        for (std::size_t k = 0; k < kWidth; ++k)
          change_[i * links + link].of[k] -= *by * predicted_[j * links + link].of[k];
}

/// Takes the derivatives over the same step: the linearised equations, solved with the matrix at
/// its solution.
void IntervalIntegrator::differentiate(double t, double gamma, double since) {
  const auto n = static_cast<std::size_t>(n_), states = static_cast<std::size_t>(states_);
  const auto first = static_cast<std::size_t>(2 * n_ + states_);
  const catena_point at =
      dynamics_.at(t, middle_q_.data(), middle_v_.data(), a_.data(), middle_z_.data());
  for (std::size_t b = 0; b < batches_; ++b) {
    std::vector<DirectionBatch>&dq = q_of_[b], &dv = v_of_[b], &dz = z_of_[b];
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < kWidth; ++k)
        predicted_[i].of[k] = dq[i].of[k] + gamma * dv[i].of[k];
    const catena_point along{0,           numbers(predicted_), numbers(dv),    numbers(zero_),
                             numbers(dz), numbers(zero_),      numbers(dp_[b])};
    tangents_.residual(at, along, numbers(change_));
    if (states > 0) tangents_.state_rate(at, along, numbers(rate_));
    turn_force();
    for (std::size_t k = 0; k < kWidth; ++k) {
      const std::size_t column = b * kWidth + k;
      if (column < first || column >= first + static_cast<std::size_t>(forces_)) continue;
      const std::size_t m = (column - first) / 2;
      const double size = (column - first) % 2 == 0 ? 1.0 : since;
      for (std::size_t i = 0; i < n; ++i) change_[i].of[k] -= size * unit_force_[m][i];
    }
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < kWidth; ++k) change_[i].of[k] *= -gamma;
    for (std::size_t i = 0; i < states; ++i)
      for (std::size_t k = 0; k < kWidth; ++k) change_[n + i].of[k] = gamma * rate_[i].of[k];
    matrix_->solve_batch(numbers(change_));
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < kWidth; ++k) {
        const double middle = dv[i].of[k] + change_[i].of[k];
        dq[i].of[k] += 2 * gamma * middle;
        dv[i].of[k] = 2 * middle - dv[i].of[k];
      }
    for (std::size_t i = 0; i < states; ++i)
      for (std::size_t k = 0; k < kWidth; ++k) dz[i].of[k] += 2 * change_[n + i].of[k];
  }
}

}  // namespace catena
