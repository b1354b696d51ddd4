// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/sensitivity_solver.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "runtime/state_vector.hpp"

namespace catena {
namespace {

constexpr int kWidth = CATENA_DIRECTIONS;

/// The largest share by which a parameter changes along a direction, or the largest change of a
/// state.
double largest_change(const SensitivityDirection& direction, const double* parameters) {
  double largest = 0;
  for (Eigen::Index i = 0; i < direction.parameters.size(); ++i)
    if (parameters[i] != 0)
      largest = std::max(largest, std::abs(direction.parameters[i] / parameters[i]));
  for (const Eigen::VectorXd* part : {&direction.q, &direction.v, &direction.z})
    if (part->size() > 0) largest = std::max(largest, part->cwiseAbs().maxCoeff());
  return largest > 0 ? largest : 1;
}

}  // namespace

SensitivitySolver::SensitivitySolver(Dynamics& dynamics, NewtonMatrix& matrix,
                                     StepSolver& step_solver,
                                     const std::vector<SensitivityDirection>& directions,
                                     SUNContext context)
    : dynamics_(dynamics),
      matrix_(matrix),
      step_solver_(step_solver),
      directions_(directions),
      tangents_(dynamics.model()),
      batches_((static_cast<int>(directions.size()) + kWidth - 1) / kWidth),
      n_(kWidth * dynamics.coordinates()),
      states_(kWidth * dynamics.states()) {
  const auto n = static_cast<std::size_t>(dynamics.coordinates());
  const auto states = static_cast<std::size_t>(dynamics.states());
  const auto parameters = static_cast<std::size_t>(dynamics.table().parameters);
  for (std::vector<DirectionBatch>* values : {&dq_, &da_}) values->resize(n);
  zero_.resize(std::max(n, 3 * static_cast<std::size_t>(dynamics.table().signals)));
  change_.resize(n + states);
  parameters_.resize(static_cast<std::size_t>(batches_) * parameters);
  for (const SensitivityDirection& direction : directions)
    changes_.push_back(largest_change(direction, dynamics.parameters()));
  for (std::size_t k = 0; k < directions.size(); ++k)
    for (std::size_t i = 0; i < parameters; ++i)
      parameters_[k / kWidth * parameters + i].of[k % kWidth] =
          directions[k].parameters[static_cast<Eigen::Index>(i)];

  handle_ = own_nonlinear_solver(context, this, &SensitivitySolver::solve);
}

const double* SensitivitySolver::parameters(int batch) const {
  return numbers(parameters_) + kWidth * dynamics_.table().parameters * batch;
}

double SensitivitySolver::element(const double* s, std::size_t direction, int element) const {
  return s[batch_size() * static_cast<int>(direction / kWidth) + kWidth * element +
           static_cast<int>(direction % kWidth)];
}

void SensitivitySolver::start(double* s) const {
  std::fill_n(s, size(), 0.0);
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    double* out = s + batch_size() * static_cast<int>(k / kWidth) + k % kWidth;
    for (const Eigen::VectorXd* part : {&directions_[k].q, &directions_[k].v, &directions_[k].z})
      for (Eigen::Index i = 0; i < part->size(); ++i, out += kWidth) *out = (*part)[i];
  }
}

void SensitivitySolver::error_weights(const double* s, const SimulationOptions& options,
                                      double* weight) const {
  std::fill_n(weight, size(), 0.0);
  // CVODES's norm divides by the whole length, filled up with zeros.
  const double fill =
      std::sqrt(static_cast<double>(batches_ * kWidth) / static_cast<double>(directions_.size()));
  const int elements = dynamics_.size(), coordinates = dynamics_.coordinates();
  // Integrals of the forces that hold a place enter no equation.
  const int constraints = dynamics_.model().constraints();
  for (std::size_t k = 0; k < directions_.size(); ++k) {
    const auto first = batch_size() * static_cast<int>(k / kWidth) + static_cast<int>(k % kWidth);
    for (int element = 0; element < elements; ++element) {
      if (element < 2 * coordinates && element % coordinates >= coordinates - constraints) continue;
      const double absolute = element < coordinates ? options.absolute_tolerance_position
                                                    : options.absolute_tolerance_velocity;
      const int i = first + kWidth * element;
      weight[i] = fill / (options.relative_tolerance * std::abs(s[i]) + absolute * changes_[k]);
    }
  }
}

int SensitivitySolver::rates(double t, const double* y, const double* a, const double* s,
                             double* sdot) {
  const int coordinates = dynamics_.coordinates();
  const catena_point at = dynamics_.at(t, y, y + coordinates, a, y + 2 * coordinates);
  const double* zero = numbers(zero_);
  step_solver_.forget_factors();
  // dr along (sq, sv, sa, sz, dp) = 0 for sa; at gamma = 0 the Newton matrix is M
  if (const int pivot = matrix_.factor(dynamics_, at, 0.0)) return pivot;
  for (int batch = 0; batch < batches_; ++batch, s += batch_size(), sdot += batch_size()) {
    const double *sq = s, *sv = sq + n_, *sz = sv + n_;
    const catena_point along{0.0, sq, sv, zero, sz, zero, parameters(batch)};
    std::copy_n(sv, n_, sdot);
    double* const change = numbers(change_);
    tangents_.residual(at, along, change);
    for (int i = 0; i < n_; ++i) change[i] = -change[i];
    if (states_ > 0) tangents_.state_rate(at, along, change + n_);
    matrix_.solve_batch(change);
    std::copy_n(change, n_ + states_, sdot + n_);
  }
  return 0;
}

int SensitivitySolver::solve(SUNNonlinearSolver solver, N_Vector predicted, N_Vector correction,
                             N_Vector, double, booleantype, void* cvode) {
  auto& self = *static_cast<SensitivitySolver*>(solver->content);
  const int n = self.n_, states = self.states_, coordinates = self.dynamics_.coordinates();
  double t, told_gamma, told_rl1;
  N_Vector prediction, state, rate, history;
  N_Vector *predictions, *sensitivities, *histories;
  void* user;
  CVodeGetNonlinearSystemData(cvode, &t, &prediction, &state, &rate, &told_gamma, &told_rl1,
                              &history, &user);
  CVodeGetNonlinearSystemDataSens(cvode, &t, &predictions, &sensitivities, &told_gamma, &told_rl1,
                                  &histories, &user);
  const double gamma = told_gamma, rl1 = told_rl1;

  const double *q = elements(state), *v = q + coordinates, *z = v + coordinates;
  const catena_point at = self.dynamics_.at(t, q, v, self.step_solver_.acceleration(), z);
  ++self.factorisations_;
  if (self.matrix_.factor(self.dynamics_, at, gamma) != 0) {
    self.step_solver_.forget_factors();
    return SUN_NLS_CONV_RECVR;
  }
  self.step_solver_.factors_renewed(gamma);

  const double *s = elements(predicted), *past = elements(histories[0]);
  double* e = elements(correction);
  // Maps: the compiler need not fear that what is written is read again, and takes two numbers at a time.
  using Values = Eigen::Map<Eigen::ArrayXd>;
  using Given = Eigen::Map<const Eigen::ArrayXd>;
  Values dq(numbers(self.dq_), n), da(numbers(self.da_), n);
  Values change(numbers(self.change_), n), of_states(change.data() + n, states);
  const double* zero = numbers(self.zero_);
  for (int batch = 0; batch < self.batches_; ++batch) {
    const Given sq(s, n), sv(s + n, n);
    const Given past_q(past, n), past_v(past + n, n), past_z(past_v.data() + n, states);
    dq = sq + (gamma * sv - rl1 * past_q);
    da = rl1 * past_v / gamma;
    const catena_point along{
        0.0, dq.data(), sv.data(), da.data(), sv.data() + n, zero, self.parameters(batch)};
    self.tangents_.residual(at, along, change.data());
    change *= -gamma;
    if (states > 0) {
      self.tangents_.state_rate(at, along, of_states.data());
      of_states = gamma * of_states - rl1 * past_z;
    }
    self.matrix_.solve_batch(change.data());
    if ((0.0 * change).sum() != 0)
      return SUN_NLS_CONV_RECVR;  // not a number if one of them is not finite
    Values(e, n) = gamma * (sv + change) - rl1 * past_q;
    Values(e + n, n + states) = Given(change.data(), n + states);
    s += self.batch_size();
    past += self.batch_size();
    e += self.batch_size();
  }
  return SUN_NLS_SUCCESS;
}

}  // namespace catena
