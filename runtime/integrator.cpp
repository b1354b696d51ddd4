// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>
#include <string_view>

#include "common/cpu_seconds.hpp"
#include "common/number_text.hpp"

namespace catena {
namespace {

constexpr long kStepsPerCheckPoint = 500;

// A run is given up early if, after so many steps, the latter half of them tells that it needs this
// many times max_steps. What is that stiff swings without damping, as damped motion lets steps grow.
constexpr long kStepsToTell = 100'000;
constexpr double kHopeless = 100;

// From 2^31 on, the models' sines are not numbers (sine_cosine.hpp).
constexpr double kGreatestAngle = 0x1p30;

// s. At rest CVODES chooses its first step from the distance to the last time. The distance is
// limited so that the first step does not skip changes of the signals.
constexpr double kFirstSight = 100.0;

// Of failures of the step, which sizes that differ too much have in common.
constexpr const char* kRemedy =
    ". Something is too stiff, too strongly damped or too light beside the rest: make the joints "
    "less stiff, look at "
    "masses, damping and units, or add damping";

SUNContext new_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw std::bad_alloc();
  return context;
}

void copy_state(const State& state, N_Vector y) {
  double* out = elements(y);
  for (const Eigen::VectorXd* part : {&state.q, &state.v, &state.z})
    out = std::copy(part->data(), part->data() + part->size(), out);
}

void copy_column(const double* y, int n, int states, std::size_t column, Trajectory& trajectory) {
  const auto k = static_cast<Eigen::Index>(column);
  trajectory.q.col(k) = Eigen::Map<const Eigen::VectorXd>(y, n);
  trajectory.v.col(k) = Eigen::Map<const Eigen::VectorXd>(y + n, n);
  trajectory.z.col(k) = Eigen::Map<const Eigen::VectorXd>(y + 2 * n, states);
}

void resize(const Model& model, std::size_t count, Trajectory& trajectory) {
  const auto columns = static_cast<Eigen::Index>(count);
  trajectory.q.conservativeResize(model.coordinates(), columns);
  trajectory.v.conservativeResize(model.coordinates(), columns);
  trajectory.z.conservativeResize(model.states(), columns);
  if (trajectory.energy.rows() > 0) trajectory.energy.conservativeResize(model.energies(), columns);
}

}  // namespace

void require(int flag, const char* call) {
  if (flag == CV_MEM_FAIL) throw std::bad_alloc();
  // Its name is not asked for: where memory is short, CVODES writes names to a null pointer.
  if (flag < 0) throw std::logic_error(std::string(call) + ": status " + std::to_string(flag));
}

Integrator::Integrator(const Model& model, const Eigen::VectorXd& parameters, const State& initial,
                       double start, const SimulationOptions& options, const Signals& signals,
                       const std::vector<SensitivityDirection>& directions)
    : options_(options),
      dynamics_(model, parameters, signals),
      n_(model.coordinates()),
      context_(new_context()),
      matrix_(make_newton_matrix(model, options.linear_solver, used_)),
      step_solver_(std::make_unique<StepSolver>(dynamics_, *matrix_, context_.get())),
      directions_(directions),
      y_(new_state_vector(dynamics_.size(), context_.get())),
      output_(new_state_vector(dynamics_.size(), context_.get())),
      energies_(static_cast<std::size_t>(model.energies())),
      cvodes_(CVodeCreate(CV_BDF, context_.get())) {
  if (!cvodes_) throw std::bad_alloc();
  copy_state(initial, y_.get());
  const auto silent = [](int, const char*, const char*, char*, void*) {};
  require(CVodeSetErrHandlerFn(cvodes_.get(), silent, nullptr), "CVodeSetErrHandlerFn");
  require_made(CVodeInit(cvodes_.get(), &Integrator::rates, start, y_.get()), "CVodeInit");
  require(CVodeSetUserData(cvodes_.get(), this), "CVodeSetUserData");
  require(CVodeWFtolerances(cvodes_.get(), &Integrator::error_weights), "CVodeWFtolerances");
  require(CVodeSetNonlinearSolver(cvodes_.get(), step_solver_->handle()),
          "CVodeSetNonlinearSolver");
  if (options_.energy) start_quadratures();
  if (!directions_.empty()) start_sensitivities();
}

void Integrator::require_made(int flag, const char* call) {
  if (flag == CV_MEM_FAIL) static_cast<void>(cvodes_.release());
  require(flag, call);
}

void Integrator::start_quadratures() {
  const catena_model& table = dynamics_.table();
  for (int i = 0; i < table.energies; ++i)
    if (table.energy_item[i].kind != CATENA_STORED) integrated_.push_back(i);
  // The forces that move the support, and what is held, depend on accelerations.
  for (const int i : integrated_)
    if (dynamics_.model().held() || std::string_view(table.energy_item[i].name) == "support")
      acceleration_.resize(static_cast<std::size_t>(n_));
  if (integrated_.empty()) return;
  quadrature_.reset(
      new_state_vector(static_cast<sunindextype>(integrated_.size()), context_.get()));
  std::fill_n(elements(quadrature_.get()), integrated_.size(), 0.0);
  require_made(CVodeQuadInit(cvodes_.get(), &Integrator::powers, quadrature_.get()),
               "CVodeQuadInit");
}

void Integrator::start_sensitivities() {
  sensitivity_solver_ = std::make_unique<SensitivitySolver>(dynamics_, *matrix_, *step_solver_,
                                                            directions_, context_.get());
  sensitivities_.reset(new_state_vector(sensitivity_solver_->size(), context_.get()));
  sensitivities_output_.reset(new_state_vector(sensitivity_solver_->size(), context_.get()));
  sensitivity_solver_->start(elements(sensitivities_.get()));
  N_Vector initial[] = {sensitivities_.get()};
  require_made(
      CVodeSensInit1(cvodes_.get(), 1, CV_STAGGERED1, &Integrator::sensitivity_rates, initial),
      "CVodeSensInit1");
  // Weights by the function given for y: those of CVODES are computed in vectors of the length of y.
  require(CVodeSensEEtolerances(cvodes_.get()), "CVodeSensEEtolerances");
  require(CVodeSetSensErrCon(cvodes_.get(), SUNFALSE), "CVodeSetSensErrCon");
  require(CVodeSetNonlinearSolverSensStg1(cvodes_.get(), sensitivity_solver_->handle()),
          "CVodeSetNonlinearSolverSensStg1");
}

int Integrator::rates(double t, N_Vector y, N_Vector ydot, void* user) {
  auto& self = *static_cast<Integrator*>(user);
  const int n = self.n_, states = self.dynamics_.states();
  const double *q = elements(y), *v = q + n, *z = v + n;
  double* out = elements(ydot);
  std::copy_n(v, n, out);
  double* a = out + n;
  double* zdot = a + n;

  // After each step CVODES asks for the rates at the solution. The step has just computed them.
  N_Vector prediction, state, rate, history;
  double now, gamma, rl1;
  void* same_user;
  CVodeGetNonlinearSystemData(self.cvodes_.get(), &now, &prediction, &state, &rate, &gamma, &rl1,
                              &history, &same_user);
  if (y == state && t == self.step_solver_->time()) {
    std::copy_n(self.step_solver_->acceleration(), n, a);
    std::copy_n(self.step_solver_->state_rate(), states, zdot);
    return 0;
  }

  const Model& model = self.dynamics_.model();
  const catena_point at = self.dynamics_.at(t, q, v, self.dynamics_.zero(), z);
  if (const int pivot = model.acceleration(at, a)) {
    self.rates_failure_ = {Status::kSingular, pivot - 1, t};
    return 1;
  }
  if (states > 0) model.state_rate(at, zdot);
  for (int i = 0; i < n + states; ++i)
    if (!std::isfinite(a[i])) {
      self.rates_failure_ = {Status::kNotFinite, i < n ? i : n + i, t};
      return 1;
    }
  return 0;
}

int Integrator::powers(double t, N_Vector y, N_Vector power, void* user) {
  auto& self = *static_cast<Integrator*>(user);
  const double *q = elements(y), *v = q + self.n_, *z = v + self.n_;
  catena_point at = self.dynamics_.at(t, q, v, self.dynamics_.zero(), z);
  if (!self.acceleration_.empty()) {
    if (const int pivot = self.dynamics_.model().acceleration(at, self.acceleration_.data())) {
      self.rates_failure_ = {Status::kSingular, pivot - 1, t};
      return 1;
    }
    at.a = self.acceleration_.data();
  }
  self.dynamics_.model().energy(at, self.energies_.data());
  for (std::size_t i = 0; i < self.integrated_.size(); ++i)
    elements(power)[i] = self.energies_[static_cast<std::size_t>(self.integrated_[i])];
  return 0;
}

int Integrator::sensitivity_rates(int, double t, N_Vector y, N_Vector ydot, int, N_Vector s,
                                  N_Vector sdot, void* user, N_Vector, N_Vector) {
  auto& self = *static_cast<Integrator*>(user);
  const int pivot = self.sensitivity_solver_->rates(t, elements(y), elements(ydot) + self.n_,
                                                    elements(s), elements(sdot));
  if (pivot != 0) self.rates_failure_ = {Status::kSingular, pivot - 1, t};
  return pivot != 0;
}

int Integrator::event_values(double t, N_Vector y, double* value, void* user) {
  auto& self = *static_cast<Integrator*>(user);
  const double *q = elements(y), *v = q + self.n_, *z = v + self.n_;
  self.dynamics_.model().event_values(self.dynamics_.at(t, q, v, self.dynamics_.zero(), z), value);
  return 0;
}

int Integrator::error_weights(N_Vector y, N_Vector weight, void* user) {
  const auto& self = *static_cast<Integrator*>(user);
  const SimulationOptions& options = self.options_;
  const double* value = elements(y);
  double* out = elements(weight);
  const int n = self.n_, size = self.dynamics_.size();
  if (N_VGetLength(y) != size) {  // sensitivities; CVODES wants weights for them in any case
    if (options.sensitivities_in_error_test)
      self.sensitivity_solver_->error_weights(value, options, out);
    else
      N_VConst(1.0, weight);
    return 0;
  }
  for (int i = 0; i < n; ++i)
    out[i] = 1.0 / (options.relative_tolerance * std::abs(value[i]) +
                    options.absolute_tolerance_position);
  for (int i = n; i < size; ++i)
    out[i] = 1.0 / (options.relative_tolerance * std::abs(value[i]) +
                    options.absolute_tolerance_velocity);
  // Integrals of the forces that hold a place enter no equation.
  const int constraints = self.dynamics_.model().constraints();
  std::fill_n(out + n - constraints, constraints, 0.0);
  std::fill_n(out + 2 * n - constraints, constraints, 0.0);
  return 0;
}

void Integrator::keep_check_points() {
  require(CVodeAdjInit(cvodes_.get(), kStepsPerCheckPoint, CV_POLYNOMIAL), "CVodeAdjInit");
  keeps_check_points_ = true;
}

int Integrator::step(long number, double last, double& t) {
  if (!keeps_check_points_) return CVode(cvodes_.get(), last, y_.get(), &t, CV_ONE_STEP);
  // A run that is repeated from a check point has no factors from before it. The first run forgets
  // its factors there, so that both take the same steps.
  if (number % kStepsPerCheckPoint == 0) step_solver_->forget_factors();
  int check_points = 0;
  return CVodeF(cvodes_.get(), last, y_.get(), &t, CV_ONE_STEP, &check_points);
}

void Integrator::run(const std::vector<double>& times, SensitiveSimulation& result) {
  const double begin = cpu_seconds();
  const Model& model = dynamics_.model();
  result.trajectory.time = times;
  if (options_.energy) result.trajectory.energy.resize(model.energies(), 0);
  resize(model, times.size(), result.trajectory);
  result.sensitivity.resize(directions_.size());
  for (Trajectory& sensitivity : result.sensitivity) {
    sensitivity.time = times;
    resize(model, times.size(), sensitivity);
  }
  result.energy_imbalance = options_.energy ? 0.0 : std::nan("");

  copy_column(elements(y_.get()), n_, dynamics_.states(), 0, result.trajectory);
  if (!directions_.empty()) record_sensitivities(0, elements(sensitivities_.get()), result);
  if (options_.energy) record_energy(times[0], 0, result);

  result.status = Status::kSuccess;
  std::size_t next = 1;
  if (next < times.size()) {
    CVodeSetStopTime(cvodes_.get(), times.back());
    // A smaller step is lost in the rounding of t. If the error test asks for one, the run fails.
    const double longest = std::max(std::abs(times.front()), std::abs(times.back()));
    CVodeSetMinStep(cvodes_.get(), 64.0 * std::numeric_limits<double>::epsilon() * longest);
  }
  if (options_.events && model.events() > 0 && !keeps_check_points_)
    require(CVodeRootInit(cvodes_.get(), model.events(), &Integrator::event_values),
            "CVodeRootInit");
  double reached = times[0], half_way = reached;
  long since_beginning = 0;  // steps, from the last event on
  for (long step = 0; next < times.size(); ++step) {
    double t = reached;
    if (step == kStepsToTell / 2) half_way = reached;
    const bool hopeless = step == kStepsToTell && (reached - half_way) * 2 / kStepsToTell *
                                                          kHopeless *
                                                          static_cast<double>(options_.max_steps) <
                                                      times.back() - reached;
    if (step >= options_.max_steps || hopeless) {
      double length = 0;
      CVodeGetLastStep(cvodes_.get(), &length);
      result.status = Status::kTooManySteps;
      result.message =
          std::to_string(step) + " steps were taken and t = " + number_text(reached) +
          " s is reached, of " + number_text(times.back()) + " s; the last step is " +
          number_text(length) +
          " s long: something stiff or light swings fast. Simulate a shorter time, add "
          "damping, make the joints less stiff, or raise max_steps";
      break;
    }
    const double sight =
        since_beginning == 0 ? std::min(times.back(), t + kFirstSight) : times.back();
    // The length of the first step is computed in vectors of the length of y.
    if (since_beginning < 2 && !directions_.empty() && options_.sensitivities_in_error_test)
      require(CVodeSetSensErrCon(cvodes_.get(), since_beginning == 1), "CVodeSetSensErrCon");
    ++since_beginning;
    const int flag = this->step(step, sight, t);
    if (flag == CV_MEM_FAIL) throw std::bad_alloc();
    if (flag < 0) {
      explain(flag, reached, result);
      break;
    }
    reached = t;
    for (; next < times.size() && times[next] <= t; ++next) record(times[next], next, result);
    if (flag == CV_ROOT_RETURN) {
      begin_anew(t, result);
      since_beginning = 0;
    }
    if (options_.keep_going && next < times.size() && !options_.keep_going(t)) {
      result.status = Status::kInterrupted;
      result.message = "interrupted at t = " + number_text(t) + " s";
      break;
    }
  }
  if (next < times.size()) {
    result.trajectory.time.resize(next);
    resize(model, next, result.trajectory);
    for (Trajectory& sensitivity : result.sensitivity) {
      sensitivity.time.resize(next);
      resize(model, next, sensitivity);
    }
  }
  count_steps(result);
  count(result);
  result.statistics.cpu_seconds = cpu_seconds() - begin;
}

void Integrator::record(double t, std::size_t column, SensitiveSimulation& result) {
  require(CVodeGetDky(cvodes_.get(), t, 0, output_.get()), "CVodeGetDky");
  copy_column(elements(output_.get()), n_, dynamics_.states(), column, result.trajectory);
  if (options_.energy) record_energy(t, column, result);
  if (directions_.empty()) return;
  require(CVodeGetSensDky1(cvodes_.get(), t, 0, 0, sensitivities_output_.get()),
          "CVodeGetSensDky1");
  record_sensitivities(column, elements(sensitivities_output_.get()), result);
}

void Integrator::record_sensitivities(std::size_t column, const double* values,
                                      SensitiveSimulation& result) const {
  const auto k = static_cast<Eigen::Index>(column);
  for (std::size_t direction = 0; direction < directions_.size(); ++direction) {
    int element = 0;
    Trajectory& sensitivity = result.sensitivity[direction];
    for (Eigen::MatrixXd* part : {&sensitivity.q, &sensitivity.v, &sensitivity.z})
      for (double& value : part->col(k))
        value = sensitivity_solver_->element(values, direction, element++);
  }
}

void Integrator::record_energy(double t, std::size_t column, SensitiveSimulation& result) {
  const auto k = static_cast<Eigen::Index>(column);
  const catena_model& table = dynamics_.table();
  const Trajectory& motion = result.trajectory;
  auto energy = result.trajectory.energy.col(k);
  const catena_point at = dynamics_.at(t, motion.q.col(k).data(), motion.v.col(k).data(),
                                       dynamics_.zero(), motion.z.col(k).data());
  dynamics_.model().energy(at, energies_.data());
  energy = Eigen::Map<const Eigen::VectorXd>(energies_.data(), energy.size());
  if (!integrated_.empty() && column > 0)
    require(CVodeGetQuadDky(cvodes_.get(), t, 0, quadrature_.get()), "CVodeGetQuadDky");
  for (std::size_t i = 0; i < integrated_.size(); ++i)
    energy[integrated_[i]] = elements(quadrature_.get())[i];
  double balance = 0.0;  // stored + dissipated - supplied, now less at first
  for (int i = 0; i < table.energies; ++i) {
    const double change = energy[i] - result.trajectory.energy(i, 0);
    balance += table.energy_item[i].kind == CATENA_SUPPLIED ? -change : change;
  }
  result.energy_imbalance = std::max(result.energy_imbalance, std::abs(balance));
}

void Integrator::explain(int flag, double reached, SensitiveSimulation& result) {
  StepSolver::Failure failure;
  const char* what = "";
  switch (flag) {
    case CV_CONV_FAILURE:
      failure = step_solver_->failure();
      break;
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
    case CV_RHSFUNC_FAIL:
    case CV_FIRST_SRHSFUNC_ERR:
    case CV_REPTD_SRHSFUNC_ERR:
    case CV_UNREC_SRHSFUNC_ERR:
    case CV_SRHSFUNC_FAIL:
      failure = rates_failure_;
      break;
    default: {
      failure.status = Status::kStepFailure;
      CVodeGetCurrentTime(cvodes_.get(), &failure.t);
      CVodeGetEstLocalErrors(cvodes_.get(), output_.get());
      const double* error = elements(output_.get());
      CVodeGetErrWeights(cvodes_.get(), y_.get());
      const double* weight = elements(y_.get());
      for (int i = 1; i < dynamics_.size(); ++i)
        if (std::abs(error[i] * weight[i]) >
            std::abs(error[failure.element] * weight[failure.element]))
          failure.element = i;
    }
  }
  if (!std::isfinite(failure.t)) failure.t = reached;  // CVODES chose no finite step
  const bool in_plane = dynamics_.table().positions_across == nullptr;
  const double* angle = elements(y_.get());
  const auto great = std::find_if(angle, angle + n_, [](double value) {
    return std::isfinite(value) && std::abs(value) > kGreatestAngle;
  });
  switch (great != angle + n_ ? Status::kNotRun : failure.status) {
    case Status::kNotRun:
      failure = {Status::kNotFinite, static_cast<int>(great - angle), failure.t};
      what = in_plane ? "an angle is beyond 2^30 rad"
                      : "a link moves without bound (is a held cable pulled farther than it is "
                        "long, or something too stiff, heavy or strongly damped beside the rest?)";
      break;
    case Status::kNotFinite:
      what =
          in_plane
              ? "the equations give no finite number"
              : "the equations give no finite number (a joint folded by half a turn, straight up "
                "at the support, bends in no direction of space; start beside that; a clamp whose "
                "direction is zero has none; beside what is far too stiff, heavy or strongly "
                "damped the rest is lost)";
      break;
    case Status::kSingular:
      what = "the mass or Newton matrix loses its pivot";
      break;
    case Status::kNoConvergence:
      what = "the equations of a step cannot be solved";
      break;
    default:
      what = "the error test fails however small the step";
  }
  result.status = failure.status;
  result.message = std::string(what) + ": " + name_of(failure.element) +
                   " at t = " + number_text(failure.t) + " s" +
                   (failure.status == Status::kNotFinite ? "" : kRemedy);
}

std::string Integrator::name_of(int element) const {
  const catena_model& table = dynamics_.table();
  if (element < n_) return table.coordinate[element].name;
  if (element < 2 * n_) return std::string(table.coordinate[element - n_].name) + "_rate";
  return table.state[element - 2 * n_].name;
}

// From an event on: the steps before it tell nothing of what follows.
void Integrator::begin_anew(double t, SensitiveSimulation& result) {
  std::vector<int> changes(static_cast<std::size_t>(dynamics_.model().events()));
  require(CVodeGetRootInfo(cvodes_.get(), changes.data()), "CVodeGetRootInfo");
  const catena_quantity* event = dynamics_.table().event;
  for (const int change : changes) {
    if (change != 0) result.events.push_back({t, event->name, change > 0});
    ++event;
  }
  count_steps(result);
  if (!integrated_.empty())
    require(CVodeGetQuadDky(cvodes_.get(), t, 0, quadrature_.get()), "CVodeGetQuadDky");
  if (!directions_.empty())
    require(CVodeGetSensDky1(cvodes_.get(), t, 0, 0, sensitivities_.get()), "CVodeGetSensDky1");
  require(CVodeReInit(cvodes_.get(), t, y_.get()), "CVodeReInit");
  if (!integrated_.empty())
    require(CVodeQuadReInit(cvodes_.get(), quadrature_.get()), "CVodeQuadReInit");
  N_Vector sensitivities[] = {sensitivities_.get()};
  if (!directions_.empty())
    require(CVodeSensReInit(cvodes_.get(), CV_STAGGERED1, sensitivities), "CVodeSensReInit");
}

// Adds what CVODES has counted since it began last.
void Integrator::count_steps(SensitiveSimulation& result) const {
  long steps = 0, failures = 0, of_sensitivities = 0;
  CVodeGetNumSteps(cvodes_.get(), &steps);
  CVodeGetNumErrTestFails(cvodes_.get(), &failures);
  if (sensitivity_solver_) CVodeGetSensNumErrTestFails(cvodes_.get(), &of_sensitivities);
  result.statistics.steps += steps;
  result.statistics.error_test_failures += failures + of_sensitivities;
}

void Integrator::count(SensitiveSimulation& result) const {
  Statistics& statistics = result.statistics;
  statistics.residual_evaluations = step_solver_->residual_evaluations();
  statistics.newton_iterations = step_solver_->iterations();
  statistics.newton_failures = step_solver_->failures();
  statistics.jacobian_evaluations = step_solver_->factorisations();
  if (sensitivity_solver_) statistics.jacobian_evaluations += sensitivity_solver_->factorisations();
  statistics.used = used_;
}

}  // namespace catena
