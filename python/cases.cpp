// SPDX-License-Identifier: BSD-3-Clause
//
// catena._core: cases with their data, and their identification.
#include <pybind11/eigen.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <memory>

#include "identify/cases/case_reader.hpp"
#include "identify/cases/case_writer.hpp"
#include "identify/fit/error.hpp"
#include "identify/fit/fit.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/models/model_provider.hpp"
#include "identify/problem/problem.hpp"
#include "python/core.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace catena::python {
namespace {

/// A case with its model and data. Shared, because experiments and fits refer to it.
struct LoadedCase {
  std::shared_ptr<const Problem> problem;

  explicit LoadedCase(const std::filesystem::path& path) {
    py::gil_scoped_release unlock;
    const Case loaded = read_case(path);
    problem = std::make_shared<Problem>(loaded, provide_model(loaded.description, loaded.links));
  }

  int experiment(int index) const {
    const auto count = static_cast<int>(problem->experiments().size());
    if (index < 0 || index >= count)
      throw std::invalid_argument("experiment: " + std::to_string(index) + "; there are " +
                                  std::to_string(count) + ", counted from 0");
    return index;
  }

  Eigen::VectorXd unknowns(const std::optional<Eigen::VectorXd>& x) const {
    if (!x) return problem->start();
    if (x->size() != problem->start().size())
      throw std::invalid_argument("x: " + std::to_string(x->size()) + " values; there are " +
                                  std::to_string(problem->start().size()) + " unknowns");
    return *x;
  }

  /// frames x channels
  Eigen::MatrixXd predict(const std::optional<Eigen::VectorXd>& x, int index) const {
    SignalCheck check;
    const Eigen::VectorXd at = unknowns(x);
    Prediction prediction;
    {
      py::gil_scoped_release unlock;
      prediction = problem->predict(at, experiment(index), true, {}, [&check] { return check(); });
    }
    check.rethrow();
    if (!prediction.ok()) throw ComputationError(prediction.message);
    return prediction.simulated.transpose();
  }

  double error(const std::optional<Eigen::VectorXd>& x) const {
    SignalCheck check;
    const Eigen::VectorXd at = unknowns(x);
    Evaluation evaluation;
    {
      py::gil_scoped_release unlock;
      evaluation = evaluate(*problem, at, false, false, [&check] { return check(); });
    }
    check.rethrow();
    if (!evaluation.ok) throw ComputationError(evaluation.message);
    return error_of(*problem, evaluation, Part::kFit);
  }
};

struct Identification {
  std::shared_ptr<const Problem> problem;
  FitResult fit;
  std::vector<Gap> before, after;

  py::dict unknowns() const {
    py::dict values;
    for (std::size_t i = 0; i < problem->unknowns().size(); ++i)
      values[py::str(problem->unknowns()[i].name)] = fit.x[static_cast<Eigen::Index>(i)];
    return values;
  }
  std::string case_text_of(const std::filesystem::path& directory) const {
    return case_text(problem->with(fit.x), directory);
  }
};

Identification identify(const LoadedCase& loaded, const std::optional<py::function>& progress) {
  SignalCheck check;
  std::atomic<bool> stop{false};
  std::exception_ptr raised;
  FitOptions options;
  options.stop = &stop;
  options.progress = [&](const Progress& made) {
    if (!check()) stop = true;
    if (!progress || raised) return;
    py::gil_scoped_acquire lock;
    try {
      (*progress)(made.evaluations, made.limit, made.error);
    } catch (...) {
      raised = std::current_exception();
      stop = true;
    }
  };
  Identification found{loaded.problem, {}, {}, {}};
  const Problem& problem = *loaded.problem;
  {
    py::gil_scoped_release unlock;
    found.fit = fit(problem, options, fit_least_squares);
    const auto gaps = [&](const Eigen::VectorXd& x) {
      return gaps_of(problem, evaluate(problem, x, true, false, [&] { return check(); }));
    };
    if (!stop && found.fit.status != FitStatus::kFailed) {
      found.before = gaps(problem.start());
      found.after = gaps(found.fit.x);
    }
  }
  check.rethrow();
  if (raised) std::rethrow_exception(raised);
  if (found.fit.status == FitStatus::kFailed) throw ComputationError(found.fit.message);
  return found;
}

std::vector<std::string> unknown_names(const LoadedCase& loaded) {
  std::vector<std::string> names;
  for (const Unknown& unknown : loaded.problem->unknowns()) names.push_back(unknown.name);
  return names;
}

std::vector<std::string> channel_names(const Recording& recording) {
  std::vector<std::string> names;
  for (const Channel& channel : recording.channels) names.push_back(channel.name);
  return names;
}

}  // namespace

void add_cases(py::module_& module) {
  py::class_<Experiment>(module, "Experiment", "One recording of a case.")
      .def_property_readonly("name", [](const Experiment& e) { return e.spec.name; })
      .def_property_readonly("fitted", &Experiment::fitted)
      .def_property_readonly(
          "fit_frames", [](const Experiment& e) { return e.recording.fit_frames; },
          "Number of fitted frames; the later ones validate.")
      .def_property_readonly("channels",
                             [](const Experiment& e) { return channel_names(e.recording); })
      .def_property_readonly("time",
                             [](py::object self) {
                               const auto& time = self.cast<const Experiment&>().recording.time;
                               return read_only(py::array_t<double>(
                                   static_cast<py::ssize_t>(time.size()), time.data(), self));
                             })
      .def_property_readonly(
          "measured",
          [](py::object self) {
            return rows_per_time(self.cast<const Experiment&>().recording.measured, self);
          },
          "Frames x channels, m or rad; NaN where a point was not seen.");

  py::class_<LoadedCase>(module, "Case", "A case file with its model and its data.")
      .def(py::init<const std::filesystem::path&>(), "case"_a)
      .def_property_readonly("title",
                             [](const LoadedCase& s) { return s.problem->the_case().title; })
      .def_property_readonly("model", [](const LoadedCase& s) { return s.problem->model(); })
      .def_property_readonly("unknowns", &unknown_names, "Names of the unknowns.")
      .def_property_readonly(
          "start", [](const LoadedCase& s) { return s.problem->start(); },
          "Starting values of the unknowns.")
      .def_property_readonly(
          "experiments",
          [](const LoadedCase& s) -> const auto& { return s.problem->experiments(); },
          py::return_value_policy::reference_internal)
      .def(
          "model_parameters",
          [](const LoadedCase& s, const std::optional<Eigen::VectorXd>& x, int experiment) {
            return s.problem->model_parameters(s.unknowns(x), s.experiment(experiment));
          },
          "x"_a = py::none(), "experiment"_a = 0, "The model's parameter array.")
      .def(
          "initial_state",
          [](const LoadedCase& s, const std::optional<Eigen::VectorXd>& x, int experiment) {
            return s.problem->initial_state(s.unknowns(x), s.experiment(experiment));
          },
          "x"_a = py::none(), "experiment"_a = 0, "The state at the first frame.")
      .def("predict", &LoadedCase::predict, "x"_a = py::none(), "experiment"_a = 0,
           "Prediction at every frame, frames x channels as Experiment.measured.")
      .def("error", &LoadedCase::error, "x"_a = py::none(),
           "Error measure of the case over the fitted frames.")
      .def("identify", &identify, "progress"_a = py::none(),
           "Finds the unknowns by the method of the case. progress(evaluations, limit, error) is "
           "called "
           "during the search; an exception in it ends the search and is raised again.");

  py::class_<Gap>(module, "Gap", "Differences between model and measurement, m or rad.")
      .def_readonly("experiment", &Gap::experiment)
      .def_property_readonly(
          "part", [](const Gap& gap) { return gap.part == Part::kFit ? "fit" : "validate"; })
      .def_readonly("rms", &Gap::rms)
      .def_readonly("mean_absolute", &Gap::mean_absolute)
      .def_readonly("mean_distance", &Gap::mean_distance)
      .def_readonly("largest", &Gap::largest);
  py::class_<Identification>(module, "Identification", "Result of identify.")
      .def_property_readonly("status",
                             [](const Identification& i) { return name_of(i.fit.status); })
      .def_property_readonly("x", [](const Identification& i) { return i.fit.x; })
      .def_property_readonly("unknowns", &Identification::unknowns, "Value of each, by name.")
      .def_property_readonly("error", [](const Identification& i) { return i.fit.error; })
      .def_property_readonly("start_error",
                             [](const Identification& i) { return i.fit.start_error; })
      .def_property_readonly("evaluations",
                             [](const Identification& i) { return i.fit.evaluations; })
      .def_property_readonly("seconds", [](const Identification& i) { return i.fit.seconds; })
      .def_readonly("gaps_before", &Identification::before)
      .def_readonly("gaps", &Identification::after)
      .def("case_text", &Identification::case_text_of, "directory"_a = ".",
           "The case with what was found as its starting values; paths in it are relative to "
           "directory.");
}

}  // namespace catena::python
