// SPDX-License-Identifier: BSD-3-Clause
//
// catena._core: models and simulation for Python. Arrays that come out are views of the C++ memory,
// one row per time; the interpreter's lock is released while something is computed, and Ctrl-C is
// looked at a few times a second.
#include "python/core.hpp"

#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <thread>
#include <tuple>

#include "common/input_error.hpp"
#include "identify/fit/estimates.hpp"
#include "identify/models/model_provider.hpp"
#include "runtime/adjoint.hpp"
#include "runtime/any_links.hpp"
#include "runtime/batch_dynamics.hpp"
#include "runtime/internal_forces.hpp"
#include "runtime/model.hpp"
#include "runtime/positions.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/simulation.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace catena::python {

bool SignalCheck::operator()() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_) return !raised_;
  next_ = now + std::chrono::milliseconds(100);
  py::gil_scoped_acquire lock;
  raised_ = raised_ || PyErr_CheckSignals() != 0;
  return !raised_;
}

void SignalCheck::rethrow() const {
  if (raised_) throw py::error_already_set();
}

py::array read_only(py::array array) {
  array.attr("setflags")("write"_a = false);
  return array;
}

py::array rows_per_time(const Eigen::MatrixXd& matrix, py::handle owner) {
  return read_only(py::array_t<double>({matrix.cols(), matrix.rows()}, matrix.data(), owner));
}

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

template <class Member>
auto view_of(Member member) {
  return [member](py::object self) {
    return rows_per_time(self.cast<const Trajectory&>().*member, self);
  };
}

/// Bytes of a motion.
double memory_of(const Model& model, std::size_t times) {
  return 8.0 * static_cast<double>(times) *
         (2 * model.coordinates() + model.states() + model.energies());
}

SimulationOptions options_of(double relative_tolerance, double absolute_tolerance_position,
                             double absolute_tolerance_velocity, long max_steps,
                             SignalCheck& check) {
  SimulationOptions options;
  options.relative_tolerance = relative_tolerance;
  options.absolute_tolerance_position = absolute_tolerance_position;
  options.absolute_tolerance_velocity = absolute_tolerance_velocity;
  options.max_steps = max_steps;
  options.keep_going = [&check](double) { return check(); };
  return options;
}

void require_success(const Simulation& simulation, const SignalCheck& check) {
  check.rethrow();
  if (simulation.status != Status::kSuccess)
    throw ComputationError(std::string(status_name(simulation.status)) + ": " + simulation.message);
}

Simulation run(const Model& model, const Eigen::VectorXd& parameters, const State& initial,
               const std::vector<double>& times, double relative_tolerance,
               double absolute_tolerance_position, double absolute_tolerance_velocity,
               long max_steps, bool large_work) {
  SignalCheck check;
  SimulationOptions options = options_of(relative_tolerance, absolute_tolerance_position,
                                         absolute_tolerance_velocity, max_steps, check);
  require_yes(large_work, "keeping the motion", {.bytes = memory_of(model, times.size())});
  const double begin = times.empty() ? 0 : times.front(), end = times.empty() ? 0 : times.back();
  Forecast forecast(large_work, end - begin, 1);
  options.keep_going = [&](double time) { return check() && forecast.goes_on(time - begin); };
  options.events = true;
  Simulation simulation;
  {
    py::gil_scoped_release unlock;
    simulation = simulate(model, parameters, initial, times, options);
  }
  check.rethrow();
  forecast.require_yes("the simulation");
  require_success(simulation, check);
  return simulation;
}

SensitiveSimulation run_with_sensitivities(const Model& model, const Eigen::VectorXd& parameters,
                                           const State& initial,
                                           const std::vector<SensitivityDirection>& directions,
                                           const std::vector<double>& times,
                                           double relative_tolerance,
                                           double absolute_tolerance_position,
                                           double absolute_tolerance_velocity, long max_steps) {
  SignalCheck check;
  SensitiveSimulation simulation;
  {
    py::gil_scoped_release unlock;
    simulation =
        simulate_with_sensitivities(model, parameters, initial, directions, times,
                                    options_of(relative_tolerance, absolute_tolerance_position,
                                               absolute_tolerance_velocity, max_steps, check));
  }
  require_success(simulation, check);
  return simulation;
}

/// Throws std::invalid_argument unless parameters and motion are of this model.
void check_motion(const Model& model, const Eigen::VectorXd& parameters, const Trajectory& motion) {
  model.check_parameters(parameters);
  const auto times = static_cast<Eigen::Index>(motion.time.size());
  const auto fits = [&](const Eigen::MatrixXd& of, int rows) {
    return of.rows() == rows && (of.cols() == times || rows == 0);
  };
  if (!fits(motion.q, model.coordinates()) || !fits(motion.v, model.coordinates()) ||
      !fits(motion.z, model.states()))
    throw std::invalid_argument("trajectory: " + std::to_string(motion.q.rows()) +
                                " coordinates and " + std::to_string(motion.z.rows()) +
                                " states; the model has " + std::to_string(model.coordinates()) +
                                " and " + std::to_string(model.states()));
}

/// (times x points) side, down and, in space, across of the support, the far end of each link, and the
/// load.
py::tuple positions_over_time(const Model& model, const Eigen::VectorXd& parameters,
                              const Trajectory& trajectory) {
  check_motion(model, parameters, trajectory);
  const auto points = static_cast<Eigen::Index>(model.links() + 2);
  const auto times = static_cast<Eigen::Index>(trajectory.time.size());
  std::vector<Eigen::VectorXd Positions::*> components = {&Positions::side, &Positions::down};
  if (model.in_space()) components.push_back(&Positions::across);
  py::tuple arrays(components.size());
  std::vector<double*> data;
  for (std::size_t c = 0; c < components.size(); ++c) {
    py::array_t<double> array({times, points});
    data.push_back(array.mutable_data());
    arrays[c] = std::move(array);
  }
  for (Eigen::Index k = 0; k < times; ++k) {
    const Positions at = positions(model, parameters, trajectory.time[static_cast<std::size_t>(k)],
                                   trajectory.q.col(k));
    for (std::size_t c = 0; c < components.size(); ++c)
      Eigen::Map<Eigen::VectorXd>(data[c] + k * points, points) = at.*components[c];
  }
  return arrays;
}

void check_rows(const char* name, const Rows& rows, Eigen::Index count, int columns) {
  if (rows.rows() != count || rows.cols() != columns)
    throw std::invalid_argument(std::string(name) + ": " + std::to_string(rows.rows()) + " x " +
                                std::to_string(rows.cols()) + " entries; " + std::to_string(count) +
                                " x " + std::to_string(columns) + " are expected");
}

/// Row by row, eight rows at once.
Rows accelerations(const Model& model, const Rows& parameters, const Rows& q, const Rows& v,
                   const std::optional<Rows>& z, double t) {
  constexpr int kBatch = BatchDynamics::kBatch;
  if (model.signals() > 0)
    throw std::invalid_argument(
        "accelerations: the model asks for signals; which catena.Case reads");
  check_rows("parameters", parameters, q.rows(), model.parameters());
  check_rows("q", q, q.rows(), model.coordinates());
  check_rows("v", v, q.rows(), model.coordinates());
  if (z || model.states() > 0) check_rows("z", z.value_or(Rows()), q.rows(), model.states());
  const auto count = static_cast<int>(q.rows());
  Rows a(count, model.coordinates());
  BatchDynamics batch(model);
  for (int first = 0; first < count; first += kBatch) {
    const auto row_of = [&](int k) { return std::min(first + k, count - 1); };  // the last repeats
    for (int k = 0; k < kBatch; ++k) {
      batch.set_parameters(k, parameters.row(row_of(k)));
      for (int i = 0; i < model.coordinates(); ++i) {
        batch.q(k, i) = q(row_of(k), i);
        batch.v(k, i) = v(row_of(k), i);
      }
      for (int i = 0; i < model.states(); ++i) batch.z(k, i) = (*z)(row_of(k), i);
    }
    if (const int pivot = batch.evaluate(t))
      throw ComputationError("accelerations: the mass matrix is not positive definite at " +
                             std::string(model.table().coordinate[pivot - 1].name) +
                             " in one of the rows " + std::to_string(first) + " to " +
                             std::to_string(row_of(kBatch - 1)));
    for (int k = 0; k < kBatch && first + k < count; ++k)
      for (int i = 0; i < model.coordinates(); ++i) a(first + k, i) = batch.acceleration(k, i);
  }
  return a;
}

/// Failures are statuses of the results: one of a thousand simulations does not cost the others.
std::vector<Simulation> run_batch(const Model& model,
                                  const std::vector<Eigen::VectorXd>& parameters,
                                  const std::vector<State>& initial,
                                  const std::vector<double>& times, int threads,
                                  double relative_tolerance, double absolute_tolerance_position,
                                  double absolute_tolerance_velocity, long max_steps) {
  SignalCheck check;
  std::mutex one_at_a_time;  // threads ask whether to go on
  SimulationOptions options = options_of(relative_tolerance, absolute_tolerance_position,
                                         absolute_tolerance_velocity, max_steps, check);
  options.keep_going = [&](double) {
    const std::lock_guard lock(one_at_a_time);
    return check();
  };
  std::vector<Simulation> simulations;
  {
    py::gil_scoped_release unlock;
    simulations = simulate_batch(model, parameters, initial, times, threads, options);
  }
  check.rethrow();
  return simulations;
}

/// A new array of times x columns from a matrix of columns x times.
py::array_t<double> rows_of(const Eigen::MatrixXd& matrix) {
  return py::array_t<double>({matrix.cols(), matrix.rows()}, matrix.data());
}

/// (times x links) moments, tensions, curvatures.
py::tuple internal_forces_over_time(const Model& model, const Eigen::VectorXd& parameters,
                                    const Trajectory& trajectory) {
  check_motion(model, parameters, trajectory);
  const InternalForces forces = internal_forces(model, parameters, trajectory);
  return py::make_tuple(rows_of(forces.moment), rows_of(forces.tension), rows_of(forces.curvature));
}

/// What `slope` returns of a motion: dJ/dq, or a tuple that begins with it and goes on with dJ/dv
/// and dJ/dz, each times x entries.
void read_slope(const py::object& given, Trajectory& slope) {
  const py::tuple parts =
      py::isinstance<py::tuple>(given) ? py::tuple(given) : py::make_tuple(given);
  Eigen::MatrixXd* const into[] = {&slope.q, &slope.v, &slope.z};
  if (parts.size() < 1 || parts.size() > 3)
    throw std::invalid_argument(
        "slope: " + std::to_string(parts.size()) +
        " arrays; dJ/dq, or a tuple with dJ/dv and dJ/dz after it, is expected");
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const auto rows = parts[k].cast<Eigen::MatrixXd>();
    if (rows.rows() != into[k]->cols() || rows.cols() != into[k]->rows())
      throw std::invalid_argument(
          "slope: array " + std::to_string(k + 1) + " has " + std::to_string(rows.rows()) + " x " +
          std::to_string(rows.cols()) + " entries; " + std::to_string(into[k]->cols()) +
          " times x " + std::to_string(into[k]->rows()) + " are expected");
    *into[k] = rows.transpose();
  }
}

AdjointSimulation run_with_gradient(const Model& model, const Eigen::VectorXd& parameters,
                                    const State& initial, const std::vector<double>& times,
                                    const py::function& slope, double relative_tolerance,
                                    double absolute_tolerance_position,
                                    double absolute_tolerance_velocity, long max_steps) {
  SignalCheck check;
  AdjointSimulation simulation;
  {
    py::gil_scoped_release unlock;
    simulation = simulate_with_gradient(
        model, parameters, initial, times,
        [&](const Trajectory& motion, Trajectory& result) {
          py::gil_scoped_acquire lock;
          read_slope(slope(motion), result);
        },
        options_of(relative_tolerance, absolute_tolerance_position, absolute_tolerance_velocity,
                   max_steps, check));
  }
  require_success(simulation, check);
  return simulation;
}

std::vector<std::string> parameter_names(const Model& model) {
  std::vector<std::string> names;
  for (int i = 0; i < model.parameters(); ++i) names.emplace_back(model.table().parameter[i].name);
  return names;
}

std::vector<std::string> energy_names(const Model& model) {
  std::vector<std::string> names;
  for (int i = 0; i < model.energies(); ++i) names.emplace_back(model.table().energy_item[i].name);
  return names;
}

/// The model's parameter array from values by name: a family ("stiffness") sets all of its members.
Eigen::VectorXd parameters_from(const Model& model, const py::kwargs& values) {
  Eigen::VectorXd parameters = model.default_parameters();
  for (const auto& [key, value] : values) {
    const auto name = key.cast<std::string>();
    const auto numbers = py::array_t<double, py::array::forcecast>::ensure(value);
    if (!numbers) throw py::error_already_set();
    std::vector<int> targets;
    for (int i = 0; i < model.parameters(); ++i) {
      const std::string_view parameter = model.table().parameter[i].name;
      const bool member =
          parameter.starts_with(name + "_") &&
          parameter.find_first_not_of("0123456789", name.size() + 1) == std::string_view::npos;
      if (parameter == name || member) targets.push_back(i);
    }
    if (targets.empty()) model.parameter_index(name);  // throws, naming the nearest
    if (numbers.size() != 1 && numbers.size() != static_cast<py::ssize_t>(targets.size()))
      throw std::invalid_argument(name + ": " + std::to_string(numbers.size()) +
                                  " values; one is expected, or one for each of the " +
                                  std::to_string(targets.size()));
    for (std::size_t i = 0; i < targets.size(); ++i)
      parameters[targets[i]] =
          numbers.data()[numbers.size() == 1 ? 0 : static_cast<py::ssize_t>(i)];
  }
  return parameters;
}

Model plain_chain(int links) {
  return Model::has_built_in(links) ? Model::built_in(links) : any_links_model(links);
}

Trajectory trajectory_from(const py::tuple& state) {
  return {state[0].cast<std::vector<double>>(), state[1].cast<Eigen::MatrixXd>(),
          state[2].cast<Eigen::MatrixXd>(), state[3].cast<Eigen::MatrixXd>(),
          state[4].cast<Eigen::MatrixXd>()};
}

py::tuple state_of(const Trajectory& t) { return py::make_tuple(t.time, t.q, t.v, t.z, t.energy); }

using PlainEvents = std::vector<std::tuple<double, std::string, bool>>;

PlainEvents events_of(const Simulation& s) {
  PlainEvents events;
  for (const Event& event : s.events) events.emplace_back(event.time, event.name, event.rising);
  return events;
}

py::tuple state_of(const Simulation& s) {
  const Statistics& n = s.statistics;
  return py::make_tuple(static_cast<int>(s.status), s.message, state_of(s.trajectory),
                        s.energy_imbalance, n.steps, n.residual_evaluations, n.jacobian_evaluations,
                        n.newton_iterations, n.error_test_failures, n.newton_failures,
                        n.cpu_seconds, events_of(s));
}

Simulation simulation_from(const py::tuple& state) {
  Simulation s;
  s.status = static_cast<Status>(state[0].cast<int>());
  s.message = state[1].cast<std::string>();
  s.trajectory = trajectory_from(state[2]);
  s.energy_imbalance = state[3].cast<double>();
  Statistics& n = s.statistics;
  n.steps = state[4].cast<long>();
  n.residual_evaluations = state[5].cast<long>();
  n.jacobian_evaluations = state[6].cast<long>();
  n.newton_iterations = state[7].cast<long>();
  n.error_test_failures = state[8].cast<long>();
  n.newton_failures = state[9].cast<long>();
  n.cpu_seconds = state[10].cast<double>();
  for (const auto& [time, name, rising] : state[11].cast<PlainEvents>())
    s.events.push_back({time, name, rising});
  return s;
}

void add_model(py::module_& module) {
  py::class_<Model>(
      module, "Model",
      "A model of a chain of links. Model(12) is the plain chain of 12 links; any number of links "
      "works.")
      .def(py::init(&plain_chain), "links"_a)
      .def_static("load", &Model::load, "shared_library"_a, "A model compiled as a shared library.")
      .def_static("built_in_links", &Model::built_in_links,
                  "The link counts whose equations are compiled on their own: a little faster.")
      .def_property_readonly("links", &Model::links)
      .def_property_readonly("coordinates", &Model::coordinates)
      .def_property_readonly("states", &Model::states)
      .def_property_readonly("parameter_names", &parameter_names)
      .def_property_readonly("energy_names", &energy_names)
      .def("parameter_index", &Model::parameter_index, "name"_a,
           "Place of a parameter in the parameter array.")
      .def("default_parameters", &Model::default_parameters,
           "Defaults in the order of parameter_names; NaN where a value must be given.")
      .def("parameters", &parameters_from,
           "The parameter array from values by name. A family such as stiffness sets stiffness_1, "
           "stiffness_2, ... to one value or to one value each; what is not named keeps its "
           "default.")
      .def(py::pickle(
          [](const Model& model) {
            if (plain_chain(model.links()).table().description_hash !=
                std::string(model.table().description_hash))
              throw std::invalid_argument(
                  "only plain chains, Model(n), can be pickled; pickle the catena.Case of this "
                  "one");
            return py::make_tuple(model.links());
          },
          [](const py::tuple& state) { return plain_chain(state[0].cast<int>()); }))
      .def("__repr__", [](const Model& model) {
        return "catena.Model(" + std::to_string(model.links()) + " links, " +
               std::to_string(model.parameters()) + " parameters)";
      });

  py::class_<State>(module, "State", "Coordinates q (rad), their rates v (rad/s), extra states z.")
      .def(py::init(&State::zero), "model"_a)
      .def_readwrite("q", &State::q)
      .def_readwrite("v", &State::v)
      .def_readwrite("z", &State::z)
      .def(py::pickle([](const State& s) { return py::make_tuple(s.q, s.v, s.z); },
                      [](const py::tuple& t) {
                        State s;
                        s.q = t[0].cast<Eigen::VectorXd>();
                        s.v = t[1].cast<Eigen::VectorXd>();
                        s.z = t[2].cast<Eigen::VectorXd>();
                        return s;
                      }));
  module.def("straight", &straight, "model"_a, "angle"_a,
             "At rest, every link at this angle from the downward vertical (rad).");
  module.def("from_angles", &from_angles, "model"_a, "angles"_a,
             "At rest, link i at angles[i] (rad).");
  module.def(
      "catenary",
      [](const Model& model, const Eigen::VectorXd& parameters, double side, double down,
         bool ends_at_held) {
        return catenary(model, parameters, {side, down},
                        ends_at_held ? CatenaryFit::kEndHeld : CatenaryFit::kChords);
      },
      "model"_a, "parameters"_a, "side"_a, "down"_a, "ends_at_held"_a = true,
      "At rest on the catenary (2.53) from the support to where the end is held (m).");
}

void add_simulation_classes(py::module_& module) {
  py::class_<Trajectory>(module, "Trajectory", "A motion, one row per time.")
      .def_property_readonly("time",
                             [](py::object self) {
                               const auto& time = self.cast<const Trajectory&>().time;
                               return read_only(py::array_t<double>(
                                   static_cast<py::ssize_t>(time.size()), time.data(), self));
                             })
      .def_property_readonly("q", view_of(&Trajectory::q), "Coordinates, rad.")
      .def_property_readonly("v", view_of(&Trajectory::v), "Rates, rad/s.")
      .def_property_readonly("z", view_of(&Trajectory::z), "Extra states.")
      .def_property_readonly("energy", view_of(&Trajectory::energy),
                             "J, one column per entry of Model.energy_names.")
      .def(py::pickle([](const Trajectory& t) { return state_of(t); }, &trajectory_from));
  py::class_<Statistics>(module, "Statistics", "Statistics of the integration.")
      .def_readonly("steps", &Statistics::steps)
      .def_readonly("residual_evaluations", &Statistics::residual_evaluations)
      .def_readonly("jacobian_evaluations", &Statistics::jacobian_evaluations)
      .def_readonly("newton_iterations", &Statistics::newton_iterations)
      .def_readonly("error_test_failures", &Statistics::error_test_failures)
      .def_readonly("newton_failures", &Statistics::newton_failures)
      .def_readonly("cpu_seconds", &Statistics::cpu_seconds);
  py::class_<Simulation>(module, "Simulation", "A motion and how it was computed.")
      .def_property_readonly(
          "status", [](const Simulation& simulation) { return status_name(simulation.status); },
          "\"success\", or what failed.")
      .def_readonly("message", &Simulation::message,
                    "Empty on success; else what failed, in which state and when.")
      .def_readonly("trajectory", &Simulation::trajectory)
      .def_readonly("statistics", &Simulation::statistics)
      .def_readonly("energy_imbalance", &Simulation::energy_imbalance,
                    "Largest |stored + dissipated - supplied - initial| over the times, J.")
      .def_property_readonly("events", &events_of,
                             "Times (s), names, and whether the value rises through zero or falls.")
      .def(py::pickle([](const Simulation& s) { return state_of(s); }, &simulation_from));
  py::class_<SensitiveSimulation, Simulation>(
      module, "SensitiveSimulation", "A simulation with its derivatives along the directions.")
      .def_readonly("sensitivity", &SensitiveSimulation::sensitivity);
  py::class_<SensitivityDirection>(module, "SensitivityDirection",
                                   "A direction in the space of parameters and initial states.")
      .def(py::init(&SensitivityDirection::zero), "model"_a)
      .def_static("parameter", &SensitivityDirection::parameter, "model"_a, "index"_a,
                  "Only this parameter varies, at rate one.")
      .def_readwrite("parameters", &SensitivityDirection::parameters)
      .def_readwrite("q", &SensitivityDirection::q)
      .def_readwrite("v", &SensitivityDirection::v)
      .def_readwrite("z", &SensitivityDirection::z);

  py::class_<AdjointSimulation, Simulation>(module, "AdjointSimulation",
                                            "A simulation with the gradient of one number.")
      .def_readonly("gradient", &AdjointSimulation::gradient,
                    "dJ with respect to every parameter and to the initial state.");
}

void add_simulation_functions(py::module_& module) {
  const SimulationOptions defaults;
  module.def(
      "simulate", &run, "model"_a, "parameters"_a, "initial"_a, "times"_a, py::kw_only(),
      "relative_tolerance"_a = defaults.relative_tolerance,
      "absolute_tolerance_position"_a = defaults.absolute_tolerance_position,
      "absolute_tolerance_velocity"_a = defaults.absolute_tolerance_velocity,
      "max_steps"_a = defaults.max_steps, "large_work"_a = false,
      "The motion from `initial` at times[0], reported at every time (s, increasing). Raises "
      "ComputationError, naming state and time, where the integration fails, and unless large_work "
      "InputError where it needs more than 10 minutes or 4 GB.");
  module.def("simulate_with_sensitivities", &run_with_sensitivities, "model"_a, "parameters"_a,
             "initial"_a, "directions"_a, "times"_a, py::kw_only(),
             "relative_tolerance"_a = defaults.relative_tolerance,
             "absolute_tolerance_position"_a = defaults.absolute_tolerance_position,
             "absolute_tolerance_velocity"_a = defaults.absolute_tolerance_velocity,
             "max_steps"_a = defaults.max_steps,
             "simulate, with the derivative of the motion along each direction.");
  module.def(
      "simulate_with_gradient", &run_with_gradient, "model"_a, "parameters"_a, "initial"_a,
      "times"_a, "slope"_a, py::kw_only(), "relative_tolerance"_a = defaults.relative_tolerance,
      "absolute_tolerance_position"_a = defaults.absolute_tolerance_position,
      "absolute_tolerance_velocity"_a = defaults.absolute_tolerance_velocity,
      "max_steps"_a = defaults.max_steps,
      "simulate, with the gradient of one number J with respect to every parameter and the initial "
      "state, by the adjoint equations: the price does not depend on their number. "
      "slope(trajectory) returns dJ/dq at the times (times x coordinates), or a tuple of dJ/dq, "
      "dJ/dv and dJ/dz.");
  module.def("simulate_batch", &run_batch, "model"_a, "parameters"_a, "initial"_a, "times"_a,
             "threads"_a = std::max(1u, std::thread::hardware_concurrency()), py::kw_only(),
             "relative_tolerance"_a = defaults.relative_tolerance,
             "absolute_tolerance_position"_a = defaults.absolute_tolerance_position,
             "absolute_tolerance_velocity"_a = defaults.absolute_tolerance_velocity,
             "max_steps"_a = defaults.max_steps,
             "simulate for parameters[i] from initial[i], for every i, on several threads. The "
             "results are those of simulate, bit for bit. A simulation that fails raises nothing: "
             "its status says so.");
  module.def("accelerations", &accelerations, "model"_a, "parameters"_a, "q"_a, "v"_a,
             "z"_a = py::none(), "t"_a = 0.0,
             "The second time derivatives of the coordinates, rad/s^2, for many parameter sets and "
             "states: every argument has one row for each, and so has the result. Eight rows at a "
             "time go through the processor's vector registers; each gets the bits it has alone.");
  module.def("internal_forces", &internal_forces_over_time, "model"_a, "parameters"_a,
             "trajectory"_a,
             "moment at each joint (N m), tension at the upper end of each link (N), curvature at "
             "each joint (rad/m): arrays of times x links.");
  module.def(
      "positions", &positions_over_time, "model"_a, "parameters"_a, "trajectory"_a,
      "side, down and, in space, across (m), times x (links + 2): the support, the far end of each "
      "link, the load.");
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.doc() = "Models, simulation, identification and diagnosis of a hanging cable.";
  const py::exception<InputError> input(module, "InputError", PyExc_ValueError);
  const py::exception<ComputationError> computation(module, "ComputationError", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr raised) {
    // A message may name a file, and names of files need not be UTF-8.
    const auto raise = [](const char* type, const char* what) {
      const auto text = py::reinterpret_steal<py::object>(PyUnicode_DecodeFSDefault(what));
      PyErr_SetObject(py::module_::import("catena._core").attr(type).ptr(), text.ptr());
    };
    try {
      std::rethrow_exception(raised);
    } catch (const InputError& error) {
      raise("InputError", error.what());
    } catch (const ComputationError& error) {
      raise("ComputationError", error.what());
    } catch (const ModelError& error) {
      raise("ComputationError", error.what());
    }
  });
  module.attr("__version__") = CATENA_VERSION;
  add_model(module);
  add_simulation_classes(module);
  add_simulation_functions(module);
  add_cases(module);
  add_diagnoses(module);
}

}  // namespace catena::python
