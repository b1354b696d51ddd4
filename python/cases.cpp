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
#include <optional>

#include "common/whole_file.hpp"
#include "common/work_folder.hpp"
#include "identify/cases/case_reader.hpp"
#include "identify/cases/case_writer.hpp"
#include "identify/diagnosis/diagnosis_folder.hpp"
#include "identify/fit/error.hpp"
#include "identify/fit/estimated_noise.hpp"
#include "identify/fit/estimates.hpp"
#include "identify/fit/fit.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/models/model_provider.hpp"
#include "identify/problem/motion.hpp"
#include "identify/problem/problem.hpp"
#include "identify/recordings/table.hpp"
#include "identify/report/report.hpp"
#include "identify/results/result_writer.hpp"
#include "identify/uncertainty/uncertainty.hpp"
#include "python/core.hpp"
#include "python/data_frames.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace catena::python {
namespace {

/// A case with its model and data. Shared, because experiments and fits refer to it.
struct LoadedCase {
  HandedIn recordings;
  std::shared_ptr<const Problem> problem;

  /// `text`: of the case, where it need not be read from the file. Warns of what is odd about the
  /// case and its recordings.
  LoadedCase(const std::filesystem::path& file, HandedIn handed_in, bool large_work,
             const std::optional<std::string>& text = {})
      : recordings(std::move(handed_in)) {
    {
      py::gil_scoped_release unlock;
      const Case loaded = text ? parse_case(*text, file.string(), file.parent_path(), recordings)
                               : read_case(file, recordings);
      ProviderOptions provider;
      provider.large_work = large_work;
      problem = std::make_shared<Problem>(
          loaded, provide_model(loaded.description, loaded.links, provider));
    }
    for (const std::string& warning : problem->warnings())
      if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
  }

  /// -1, the case itself, where it has no experiment.
  int experiment(int index) const {
    const auto count = static_cast<int>(problem->experiments().size());
    if (count == 0 && index == 0) return -1;
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
    const int of = experiment(index);
    if (of < 0)
      throw std::invalid_argument(
          "predict: the case has no [[experiment]]; simulate gives its motion");
    Prediction prediction;
    {
      py::gil_scoped_release unlock;
      prediction = problem->predict(at, of, true, {}, [&check](double) { return check(); });
    }
    check.rethrow();
    if (!prediction.ok()) throw ComputationError(prediction.message);
    return prediction.simulated.transpose();
  }

  /// Of the fitted frames.
  Evaluation evaluated(const std::optional<Eigen::VectorXd>& x, bool jacobian) const {
    SignalCheck check;
    const Eigen::VectorXd at = unknowns(x);
    Evaluation evaluation;
    {
      py::gil_scoped_release unlock;
      evaluation = evaluate(*problem, at, false, jacobian, [&check](double) { return check(); });
    }
    check.rethrow();
    if (!evaluation.ok) throw ComputationError(evaluation.message);
    return evaluation;
  }

  double error(const std::optional<Eigen::VectorXd>& x) const {
    return error_of(*problem, evaluated(x, false), Part::kFit);
  }

  /// What least squares makes small: residuals over their noise, then constraints with their weights.
  Eigen::VectorXd residuals(const std::optional<Eigen::VectorXd>& x) const {
    const Misfit misfit = misfit_of(*problem, evaluated(x, false));
    Eigen::VectorXd all(misfit.residuals.value.size() + misfit.constraints.value.size());
    all << misfit.residuals.value.cwiseQuotient(noise_of(*problem, misfit.residuals)),
        misfit.constraints.value.cwiseProduct(misfit.constraints.weight);
    return all;
  }

  /// Its derivatives, one row per residual.
  Eigen::MatrixXd jacobian(const std::optional<Eigen::VectorXd>& x) const {
    const Misfit misfit = misfit_of(*problem, evaluated(x, true));
    const Eigen::Index count = misfit.residuals.value.size();
    Eigen::MatrixXd all(count + misfit.constraints.value.size(), problem->start().size());
    all.topRows(count) = noise_of(*problem, misfit.residuals).cwiseInverse().asDiagonal() *
                         misfit.residuals.jacobian;
    if (misfit.constraints.value.size() > 0)
      all.bottomRows(misfit.constraints.value.size()) =
          misfit.constraints.weight.asDiagonal() * misfit.constraints.jacobian;
    return all;
  }

  Simulation simulate(const std::optional<Eigen::VectorXd>& x, int index, bool large_work) const {
    SignalCheck check;
    const Eigen::VectorXd at = unknowns(x);
    const int of = experiment(index);
    require_yes(large_work, "keeping the motion", {.bytes = memory_of_motion(*problem, of)});
    double begin = 0, end = problem->the_case().simulation.duration;
    if (of >= 0) {
      const Experiment& measured = problem->experiments()[static_cast<std::size_t>(of)];
      begin = measured.spec.start;
      end = measured.recording.time.back();
    }
    Forecast forecast(large_work, end - begin, 1);
    Motion motion;
    {
      py::gil_scoped_release unlock;
      const auto keep_going = [&](double time) {
        return check() && forecast.goes_on(time - begin);
      };
      motion =
          of < 0 ? motion_alone(*problem, at, keep_going) : motion_of(*problem, at, of, keep_going);
    }
    check.rethrow();
    forecast.require_yes("the simulation");
    if (motion.simulation.status != Status::kSuccess)
      throw ComputationError(motion.simulation.message);
    return std::move(motion.simulation);
  }

  py::tuple bounds() const {
    const auto& unknowns = problem->unknowns();
    Eigen::VectorXd lower(unknowns.size()), upper(unknowns.size());
    for (std::size_t i = 0; i < unknowns.size(); ++i) {
      lower[static_cast<Eigen::Index>(i)] = unknowns[i].lower;
      upper[static_cast<Eigen::Index>(i)] = unknowns[i].upper;
    }
    return py::make_tuple(lower, upper);
  }

  py::tuple state() const {
    const Case& the_case = problem->the_case();
    return py::make_tuple(std::filesystem::absolute(the_case.file), the_case.text,
                          tables_state(recordings));
  }
};

LoadedCase case_from(const py::tuple& state) {
  return {state[0].cast<std::filesystem::path>(), tables_from(state[2].cast<py::dict>()), true,
          state[1].cast<std::string>()};
}

struct Identification {
  LoadedCase loaded;
  FitResult fit;

  explicit Identification(LoadedCase of) : loaded(std::move(of)) {}

  const Problem& problem() const { return *loaded.problem; }

  std::vector<Gap> gaps(const Eigen::VectorXd& x) const {
    SignalCheck check;
    std::vector<Gap> found;
    {
      py::gil_scoped_release unlock;
      found =
          gaps_of(problem(), evaluate(problem(), x, true, false, [&](double) { return check(); }));
    }
    check.rethrow();
    return found;
  }

  const Uncertainty& uncertainty() const {
    if (!uncertainty_) {
      std::optional<Uncertainty> found;
      try {
        py::gil_scoped_release unlock;
        found = uncertainty_of(problem(), fit.x);
      } catch (const std::runtime_error& error) {
        throw ComputationError(error.what());
      }
      uncertainty_ = std::move(found);
    }
    return *uncertainty_;
  }

  Eigen::VectorXd standard_errors() const {
    Eigen::VectorXd errors(fit.x.size());
    for (Eigen::Index i = 0; i < errors.size(); ++i)
      errors[i] = uncertainty().estimates[static_cast<std::size_t>(i)].standard_error;
    return errors;
  }

  Eigen::MatrixXd covariance() const {
    const Eigen::VectorXd errors = standard_errors();
    return errors.asDiagonal() * uncertainty().correlation * errors.asDiagonal();
  }

  Eigen::MatrixXd intervals() const {
    Eigen::MatrixXd ends(fit.x.size(), 2);
    for (Eigen::Index i = 0; i < ends.rows(); ++i) {
      const Estimate& estimate = uncertainty().estimates[static_cast<std::size_t>(i)];
      ends.row(i) << estimate.lower, estimate.upper;
    }
    return ends;
  }

  /// The result file, as the program writes it.
  std::string result_text() const {
    catena::Identification all;
    all.fit = fit;
    all.starts = {fit};
    all.before = evaluate(problem(), problem().start(), true, false);
    all.after = evaluate(problem(), fit.x, true, false);
    for (int e = 0; e < static_cast<int>(problem().experiments().size()); ++e)
      all.motions.push_back(motion_of(problem(), fit.x, e));
    try {
      all.uncertainty = uncertainty_of(problem(), fit.x);
    } catch (const std::runtime_error&) {  // sensitivities that fail leave no errors
    }
    return identification_result_text(problem(), all);
  }

  void report(const std::filesystem::path& file) const {
    py::gil_scoped_release unlock;
    const WorkFolder scratch = scratch_folder();
    write_whole_file(scratch.path() / "result.json", result_text());
    report::write_report(results::read_document(scratch.path()), {file, {}});
  }

  py::tuple state() const {
    py::list history;
    for (const HistoryEntry& entry : fit.history)
      history.append(py::make_tuple(entry.error, entry.x, entry.message));
    return py::make_tuple(loaded.state(), static_cast<int>(fit.status), fit.message, fit.x,
                          fit.error, fit.start_error, fit.error_noise, fit.evaluations,
                          fit.iterations, fit.failures, fit.seconds, fit.cpu_seconds, history,
                          fit.noise_seen_at);
  }

  py::dict unknowns() const {
    py::dict values;
    for (std::size_t i = 0; i < problem().unknowns().size(); ++i)
      values[py::str(problem().unknowns()[i].name)] = fit.x[static_cast<Eigen::Index>(i)];
    return values;
  }
  std::string case_text_of(const std::filesystem::path& directory) const {
    return case_text(problem().with(fit.x), directory);
  }

 private:
  mutable std::optional<Uncertainty> uncertainty_;  // when it is first asked for
};

Identification identification_from(const py::tuple& state) {
  Identification found(case_from(state[0]));
  FitResult& fit = found.fit;
  fit.status = static_cast<FitStatus>(state[1].cast<int>());
  fit.message = state[2].cast<std::string>();
  fit.x = state[3].cast<Eigen::VectorXd>();
  fit.error = state[4].cast<double>();
  fit.start_error = state[5].cast<double>();
  fit.error_noise = state[6].cast<double>();
  fit.evaluations = state[7].cast<int>();
  fit.iterations = state[8].cast<int>();
  fit.failures = state[9].cast<int>();
  fit.seconds = state[10].cast<double>();
  fit.cpu_seconds = state[11].cast<double>();
  for (const py::handle& entry : state[12]) {
    const auto parts = entry.cast<py::tuple>();
    fit.history.push_back(
        {parts[0].cast<double>(), parts[1].cast<Eigen::VectorXd>(), parts[2].cast<std::string>()});
  }
  fit.noise_seen_at = state[13].cast<Eigen::VectorXd>();
  if (fit.noise_seen_at.size() > 0)
    found.loaded.problem = std::make_shared<const Problem>(
        with_noise_seen_at(*found.loaded.problem, fit.noise_seen_at));
  return found;
}

/// Throws InputError where the fit needs more time or memory than is begun unasked.
void require_short_fit(const Problem& problem) {
  SignalCheck check;
  {
    py::gil_scoped_release unlock;
    Evaluation start;
    const double simulations = simulations_of_a_fit(problem);
    const WorkEstimate estimate = estimate_of(
        problem, [&](double simulation) { return simulation * simulations; }, false,
        [&] { return !check(); }, start);
    require_yes(false, "the identification", estimate);
  }
  check.rethrow();
}

Identification identify(const LoadedCase& loaded, const std::optional<py::function>& progress,
                        bool large_work) {
  if (!large_work) require_short_fit(*loaded.problem);
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
  Identification found(loaded);
  {
    py::gil_scoped_release unlock;
    WeighedFit weighed = fit_with_noise(
        loaded.problem, fit(*before_noise_is_known(loaded.problem), options, fit_least_squares),
        options, fit_least_squares);
    found.loaded.problem = std::move(weighed.problem);
    found.fit = std::move(weighed.fit);
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

void add_experiment(py::module_& module) {
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
}

void add_case(py::module_& module) {
  py::class_<LoadedCase>(module, "Case", "A case file with its model and its data.")
      .def(py::init([](const std::filesystem::path& file, const std::optional<py::dict>& recordings,
                       bool large_work) {
             return LoadedCase(file, recordings ? tables_of(*recordings) : HandedIn(), large_work);
           }),
           "case"_a, "recordings"_a = py::none(), py::kw_only(), "large_work"_a = false,
           "recordings: data that are no files, by the name of their [[experiment]]. Each is a "
           "DataFrame, a dict of columns or a structured array with the columns, units and axes "
           "that the file would have; or an array whose rows are frames: time_s, side_1_m, "
           "down_1_m, "
           "side_2_m, ... What is odd about a case or its recordings is a UserWarning. large_work: "
           "derive a model that takes more than 10 minutes or 4 GB, too; else InputError.")
      .def(py::pickle([](const LoadedCase& s) { return s.state(); }, &case_from))
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
      .def_property_readonly(
          "bounds", &LoadedCase::bounds,
          "Lower and upper bounds of the unknowns, infinite where there are none.")
      .def(
          "residuals", &LoadedCase::residuals, "x"_a = py::none(),
          "What least squares makes small: simulated minus measured of all points that were seen "
          "in fitted frames, m or rad, or over the noise where the case states it; then priors and "
          "gaps between joined windows with their weights. For other optimisers, which have losses "
          "of their own.")
      .def("jacobian", &LoadedCase::jacobian, "x"_a = py::none(),
           "Derivatives of residuals(x), residuals x unknowns, from one simulation with "
           "sensitivities.")
      .def("simulate", &LoadedCase::simulate, "x"_a = py::none(), "experiment"_a = 0, py::kw_only(),
           "large_work"_a = false,
           "The motion from the start of an experiment, at its frames; without any, for as long as "
           "[simulation] says. Raises ComputationError where the integration fails, and unless "
           "large_work InputError where it needs more than 10 minutes or 4 GB.")
      .def("identify", &identify, "progress"_a = py::none(), py::kw_only(), "large_work"_a = false,
           "Finds the unknowns by the method of the case. progress(evaluations, limit, error) is "
           "called during the search; an exception in it ends the search and is raised again. "
           "Raises "
           "InputError, unless large_work, where it needs more than about 10 minutes or 4 GB.");
}

void add_identification(py::module_& module) {
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
      .def_property_readonly(
          "gaps_before", [](const Identification& i) { return i.gaps(i.problem().start()); },
          "Of the start, simulated when asked for.")
      .def_property_readonly(
          "gaps", [](const Identification& i) { return i.gaps(i.fit.x); },
          "Of what was found, simulated when asked for.")
      .def_property_readonly("standard_errors", &Identification::standard_errors,
                             "Of x, in its units; infinite where the data do not tell. They allow "
                             "for residuals that are not white.")
      .def_property_readonly("covariance", &Identification::covariance,
                             "Of x; NaN with an unknown that the data do not determine.")
      .def_property_readonly("intervals", &Identification::intervals,
                             "95 % intervals of x, unknowns x 2.")
      .def("report", &Identification::report, "file"_a,
           "Writes the HTML report, as catena report does.")
      .def(py::pickle([](const Identification& i) { return i.state(); }, &identification_from))
      .def("case_text", &Identification::case_text_of, "directory"_a = ".",
           "The case with what was found as its starting values; paths in it are relative to "
           "directory.");
}

}  // namespace

void add_cases(py::module_& module) {
  add_experiment(module);
  add_case(module);
  add_identification(module);
}

}  // namespace catena::python
