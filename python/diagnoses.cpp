// SPDX-License-Identifier: BSD-3-Clause
//
// catena._core: diagnosis of a case.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <future>
#include <memory>

#include "common/input_error.hpp"
#include "common/whole_file.hpp"
#include "identify/cases/case_reader.hpp"
#include "identify/diagnosis/diagnosis_folder.hpp"
#include "identify/diagnosis/diagnosis_text.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/problem/problem.hpp"
#include "identify/report/report.hpp"
#include "identify/results/output_folder.hpp"
#include "python/core.hpp"
#include "python/tables.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace catena::python {
namespace {

/// A diagnosis with what it was made with: writing it derives the new model.
struct FinishedDiagnosis {
  WorkFolder scratch = scratch_folder();
  std::unique_ptr<DiagnosisContext> context;
  Diagnosis found;
  DiagnosisFindings findings;
};

using Shared = std::shared_ptr<FinishedDiagnosis>;

/// Runs f in a thread of its own, while this one looks for Ctrl-C and then sets `stop`: signals
/// reach Python in the main thread only. What f throws is thrown here; a failed computation as
/// ComputationError.
template <class F>
void run_interruptibly(F f, std::atomic<bool>& stop) {
  SignalCheck check;
  {
    py::gil_scoped_release unlock;
    std::future<void> work = std::async(std::launch::async, std::move(f));
    while (work.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready)
      if (!check()) stop = true;
    try {
      work.get();
    } catch (...) {
      if (check()) throw;
    }
  }
  check.rethrow();
}

Shared diagnose_case(const std::filesystem::path& case_file,
                     const std::optional<py::dict>& handed_in,
                     const std::vector<std::filesystem::path>& effects, int max_effects,
                     int max_links, int refits, int threads,
                     const std::optional<py::function>& progress) {
  if (max_effects < 0 || max_links < 1 || refits < 1 || threads < 1)
    throw std::invalid_argument(
        "max_effects is 0 or more; max_links, refits and threads are 1 or more");
  std::atomic<bool> stop{false};
  std::exception_ptr raised;
  const auto finished = std::make_shared<FinishedDiagnosis>();
  const HandedIn recordings = handed_in ? tables_of(*handed_in) : HandedIn();
  std::vector<std::string> warnings;
  const auto work = [&] {
    const ReadOnce inputs;
    const Case the_case = read_case(case_file, recordings);
    finished->context = std::make_unique<DiagnosisContext>(
        the_case, effects, finished->scratch.path(), fit_least_squares, ProviderOptions{});
    DiagnosisContext& context = *finished->context;
    context.stop = &stop;
    context.threads = threads;
    if (progress)
      context.notice = [&](const DiagnosisProgress& now) {
        py::gil_scoped_acquire lock;
        if (raised) return;
        try {
          (*progress)(progress_line(now));
        } catch (...) {
          raised = std::current_exception();
          stop = true;
        }
      };
    try {
      warnings = Problem(the_case, context.model_with({}, the_case.links)).warnings();
      finished->found = diagnose(the_case, context, {max_effects, max_links, refits});
      finished->findings = find_out(finished->found);
    } catch (const InputError&) {
      throw;
    } catch (const std::runtime_error& error) {
      throw ComputationError(error.what());
    }
    context.stop = nullptr;
    context.notice = nullptr;
  };
  try {
    run_interruptibly(work, stop);
  } catch (const ComputationError&) {
    if (!raised) throw;
  }
  if (raised) std::rethrow_exception(raised);
  for (const std::string& warning : warnings)
    if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
  return finished;
}

struct Gaps {
  double fit, held_out, noise_level;
};

Gaps gaps_of(const GapTest& fit, const GapTest& held_out) {
  return {fit.rms, held_out.count > 0 ? held_out.rms : std::nan(""), fit.noise};
}

struct Alternatives {
  std::string id, instead_of, experiment_that_tells;
  double fit, difference;
};

std::vector<Alternatives> others(const std::vector<Alternative>& list,
                                 const std::vector<TellingExperiment>& telling = {}) {
  std::vector<Alternatives> out;
  for (std::size_t i = 0; i < list.size(); ++i)
    out.push_back({list[i].explanation.id, list[i].instead_of,
                   i < telling.size() ? telling[i].words : "", list[i].explanation.fit.rms,
                   list[i].decision.difference});
  return out;
}

/// diagnosis.json as Python's own lists and dictionaries.
py::object document(const FinishedDiagnosis& d) {
  const auto files = diagnosis_files(d.found, d.findings, *d.context);
  return py::module_::import("json").attr("loads")(files.back().second);
}

}  // namespace

void add_diagnoses(py::module_& module) {
  py::class_<Gaps>(module, "DiagnosisGap", "How far a model is from the data, m or rad.")
      .def_readonly("fit", &Gaps::fit, "Root mean square over what was fitted.")
      .def_readonly("held_out", &Gaps::held_out, "Over what was held out; NaN if nothing was.")
      .def_readonly("noise_level", &Gaps::noise_level, "What noise alone would leave.");
  py::class_<FinalParameter>(module, "FoundParameter", "A parameter of the final model.")
      .def_readonly("name", &FinalParameter::name)
      .def_readonly("unit", &FinalParameter::unit)
      .def_readonly("effect", &FinalParameter::effect, "Empty for the case's own.")
      .def_readonly("value", &FinalParameter::value)
      .def_readonly("standard_error", &FinalParameter::standard_error,
                    "Allows for autocorrelated residuals; infinite where the data do not tell.");
  py::class_<Alternatives>(module, "OtherEffect", "An effect that was refitted and has no name.")
      .def_readonly("id", &Alternatives::id)
      .def_readonly("instead_of", &Alternatives::instead_of, "Empty: as the last one added.")
      .def_readonly("fit", &Alternatives::fit, "Gap it leaves where it was fitted, m or rad.")
      .def_readonly("difference", &Alternatives::difference,
                    "How far its predictions are from those of the final model, in noises.")
      .def_readonly("experiment_that_tells", &Alternatives::experiment_that_tells,
                    "Empty where none was sought.");
  py::class_<FinishedDiagnosis, Shared>(module, "Diagnosis",
                                        "What a model lacks; str() is the table that the program "
                                        "prints.")
      .def_property_readonly(
          "verdict", [](const Shared& d) { return name_of(d->found.verdict); },
          "none, named, ambiguous, partly or unexplained.")
      .def_property_readonly("sentence", [](const Shared& d) { return d->found.sentence; })
      .def_property_readonly("notes", [](const Shared& d) { return d->found.notes; })
      .def_property_readonly(
          "effects", [](const Shared& d) { return d->found.effects; }, "Those of the final model.")
      .def_property_readonly(
          "certain", [](const Shared& d) { return d->found.certain; },
          "Those of them that stand whatever else is missing.")
      .def_property_readonly(
          "links", [](const Shared& d) { return d->found.stages.back().links; },
          "Of the final model.")
      .def_property_readonly("parameters", [](const Shared& d) { return d->found.parameters; })
      .def_property_readonly("gap_before",
                             [](const Shared& d) {
                               const Stage& first = d->found.stages.front();
                               return gaps_of(first.fit, first.held_out);
                             })
      .def_property_readonly(
          "gap",
          [](const Shared& d) { return gaps_of(d->found.final_fit, d->found.final_held_out); })
      .def_property_readonly(
          "undecided",
          [](const Shared& d) { return others(d->found.alternatives, d->findings.telling); },
          "Effects that explain the same data as well.")
      .def_property_readonly(
          "forms", [](const Shared& d) { return others(d->found.forms); },
          "Other laws of the effect that is named, undecided too.")
      .def_property_readonly(
          "runners_up", [](const Shared& d) { return others(d->found.runners_up); },
          "Effects that the data decide against.")
      .def(
          "document", [](const Shared& d) { return document(*d); },
          "Everything, as diagnosis.json has it.")
      .def(
          "write",
          [](const Shared& d, const std::filesystem::path& folder) {
            py::gil_scoped_release unlock;
            OutputFolder output(folder, kDiagnosisNames);
            output.publish([&](const std::filesystem::path& unfinished) {
              write_diagnosis(d->found, d->findings, *d->context, unfinished, output.path());
            });
          },
          "folder"_a,
          "Writes what catena diagnose writes: diagnosis.json, the results of the rounds, the case "
          "with what was found, and the new model.")
      .def(
          "report",
          [](const Shared& d, const std::filesystem::path& file) {
            py::gil_scoped_release unlock;
            const WorkFolder scratch = scratch_folder();
            for (const auto& [name, text] : diagnosis_files(d->found, d->findings, *d->context)) {
              std::filesystem::create_directories((scratch.path() / name).parent_path());
              write_whole_file(scratch.path() / name, text);
            }
            report::write_report(results::read_document(scratch.path()), {file, {}});
          },
          "file"_a, "Writes the HTML report, as catena report does.")
      .def("__str__", [](const Shared& d) { return diagnosis_table(d->found, d->findings); });
  const DiagnosisOptions defaults;
  module.def(
      "diagnose", &diagnose_case, "case"_a, "recordings"_a = py::none(), py::kw_only(),
      "effects"_a = std::vector<std::filesystem::path>{}, "max_effects"_a = defaults.max_effects,
      "max_links"_a = defaults.max_links, "refits"_a = defaults.refits, "threads"_a = 2,
      "progress"_a = py::none(),
      "Finds the effect that the model of a case file lacks, adds it, fits again. recordings: "
      "as Case takes them. effects: "
      "effect files of your own to look for as well. progress(line) is told what is being "
      "done, how much of it is left and the best so far; what it raises ends the diagnosis and is "
      "raised again. Raises InputError for a "
      "bad case, ComputationError where a model cannot be made or fitted.");
}

}  // namespace catena::python
