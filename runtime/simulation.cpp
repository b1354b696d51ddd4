// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/simulation.hpp"

#include <cmath>
#include <stdexcept>

#include "common/in_quotes.hpp"
#include "common/number_text.hpp"
#include "common/parallel.hpp"
#include "runtime/adjoint_solver.hpp"
#include "runtime/integrator.hpp"
#include "runtime/sensitivity.hpp"

namespace catena {
namespace {

[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

void check_vector(const std::string& name, const Eigen::VectorXd& values, int size) {
  if (values.size() != size)
    refuse(name + ": " + std::to_string(values.size()) + " values given, the model has " +
           std::to_string(size));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      refuse(name + ", entry " + std::to_string(i + 1) + " = " + number_text(values[i]) +
             " must be finite");
}

void check_times(const std::vector<double>& times) {
  if (times.empty()) refuse("times: none given; the first is the start");
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::string entry =
        "times, entry " + std::to_string(i + 1) + " = " + number_text(times[i]) + " s";
    if (!std::isfinite(times[i])) refuse(entry + " must be finite");
    if (i > 0 && !(times[i] > times[i - 1]))
      refuse(entry + " does not come after " + number_text(times[i - 1]) + " s");
  }
}

void check_positive(const char* name, double value) {
  if (!(value > 0.0) || !std::isfinite(value))
    refuse(std::string(name) + " = " + number_text(value) + " must be positive");
}

void check_options(const SimulationOptions& options) {
  check_positive("relative_tolerance", options.relative_tolerance);
  check_positive("absolute_tolerance_position", options.absolute_tolerance_position);
  check_positive("absolute_tolerance_velocity", options.absolute_tolerance_velocity);
  if (options.max_steps < 1)
    refuse("max_steps = " + std::to_string(options.max_steps) + " must be at least 1");
}

void check_signals(const Model& model, const Signals& signals, const std::vector<double>& times) {
  if (signals.count() != model.signals())
    refuse("signals: " + std::to_string(signals.count()) + " given, the model has " +
           std::to_string(model.signals()));
  for (int i = 0; i < model.signals(); ++i)
    if (signals.name(i) != model.table().signal[i].name)
      refuse("signal " + std::to_string(i + 1) + " is " + in_quotes(signals.name(i)) +
             ", the model asks for " + in_quotes(model.table().signal[i].name));
  if (signals.count() > 0 &&
      (times.front() < signals.first_time() || times.back() > signals.last_time()))
    refuse("signals are given from " + number_text(signals.first_time()) + " to " +
           number_text(signals.last_time()) + " s, the simulation needs them from " +
           number_text(times.front()) + " to " + number_text(times.back()) + " s");
}

template <class Values>
void check_state(const std::string& name, const Values& state, const Model& model) {
  check_vector(name + " q", state.q, model.coordinates());
  check_vector(name + " v", state.v, model.coordinates());
  check_vector(name + " z", state.z, model.states());
}

void check_run(const Model& model, const Eigen::VectorXd& parameters, const State& initial,
               const std::vector<double>& times, const SimulationOptions& options,
               const Signals& signals) {
  model.check_parameters(parameters);
  check_state("initial", initial, model);
  check_times(times);
  check_options(options);
  check_signals(model, signals, times);
}

}  // namespace

SensitivityDirection SensitivityDirection::zero(const Model& model) {
  const auto zero = [](int size) -> Eigen::VectorXd { return Eigen::VectorXd::Zero(size); };
  return {zero(model.parameters()), zero(model.coordinates()), zero(model.coordinates()),
          zero(model.states())};
}

SensitivityDirection SensitivityDirection::parameter(const Model& model, int index) {
  if (index < 0 || index >= model.parameters())
    refuse("parameter " + std::to_string(index) + ": the model has " +
           std::to_string(model.parameters()) + ", counted from 0");
  SensitivityDirection direction = zero(model);
  direction.parameters[index] = 1.0;
  return direction;
}

Simulation simulate(const Model& model, const Eigen::VectorXd& parameters, const State& initial,
                    const std::vector<double>& times, const SimulationOptions& options,
                    const Signals& signals) {
  return simulate_with_sensitivities(model, parameters, initial, {}, times, options, signals);
}

std::vector<Simulation> simulate_batch(const Model& model,
                                       const std::vector<Eigen::VectorXd>& parameters,
                                       const std::vector<State>& initial,
                                       const std::vector<double>& times, int threads,
                                       const SimulationOptions& options, const Signals& signals) {
  if (parameters.size() != initial.size())
    refuse(std::to_string(parameters.size()) + " parameter sets, but " +
           std::to_string(initial.size()) + " initial states; give as many of both");
  for (std::size_t i = 0; i < parameters.size(); ++i) try {
      check_run(model, parameters[i], initial[i], times, options, signals);
    } catch (const std::invalid_argument& error) {
      refuse("set " + std::to_string(i + 1) + ": " + error.what());
    }
  std::vector<Simulation> results(parameters.size());
  in_parallel(results.size(), threads, [&](std::size_t i) {
    results[i] = simulate(model, parameters[i], initial[i], times, options, signals);
  });
  return results;
}

SensitiveSimulation simulate_with_sensitivities(
    const Model& model, const Eigen::VectorXd& parameters, const State& initial,
    const std::vector<SensitivityDirection>& directions, const std::vector<double>& times,
    const SimulationOptions& options, const Signals& signals) {
  check_run(model, parameters, initial, times, options, signals);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const std::string name = "direction " + std::to_string(i + 1);
    check_vector(name + " parameters", directions[i].parameters, model.parameters());
    check_state(name, directions[i], model);
  }
  SensitiveSimulation result;
  Integrator(model, parameters, initial, times.front(), options, signals, directions)
      .run(times, result);
  return result;
}

AdjointSimulation simulate_with_gradient(const Model& model, const Eigen::VectorXd& parameters,
                                         const State& initial, const std::vector<double>& times,
                                         const MotionObjective& objective,
                                         const SimulationOptions& options, const Signals& signals) {
  check_run(model, parameters, initial, times, options, signals);
  Integrator forward(model, parameters, initial, times.front(), options, signals, {});
  forward.keep_check_points();
  SensitiveSimulation motion;
  forward.run(times, motion);
  AdjointSimulation result;
  static_cast<Simulation&>(result) = std::move(motion);
  result.gradient = SensitivityDirection::zero(model);
  if (result.status != Status::kSuccess) return result;
  const Trajectory& reached = result.trajectory;
  Trajectory slope;
  slope.time = reached.time;
  slope.q.setZero(reached.q.rows(), reached.q.cols());
  slope.v.setZero(reached.v.rows(), reached.v.cols());
  slope.z.setZero(reached.z.rows(), reached.z.cols());
  objective(reached, slope);
  check_vector("the objective's slope q", slope.q.reshaped(), static_cast<int>(reached.q.size()));
  check_vector("the objective's slope v", slope.v.reshaped(), static_cast<int>(reached.v.size()));
  check_vector("the objective's slope z", slope.z.reshaped(), static_cast<int>(reached.z.size()));
  AdjointSolver(forward, model, parameters, options, signals).run(times, slope, result);
  return result;
}

}  // namespace catena
