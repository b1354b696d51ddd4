// SPDX-License-Identifier: BSD-3-Clause
//
// catena._core: diagnosis of a case.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <future>
#include <optional>

#include "common/input_error.hpp"
#include "common/whole_file.hpp"
#include "description/description.hpp"
#include "identify/cases/case_reader.hpp"
#include "identify/cases/case_writer.hpp"
#include "identify/diagnosis/baseline.hpp"
#include "identify/diagnosis/diagnosis_folder.hpp"
#include "identify/diagnosis/diagnosis_text.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/problem/problem.hpp"
#include "identify/report/report.hpp"
#include "identify/results/output_folder.hpp"
#include "python/core.hpp"
#include "python/data_frames.hpp"

namespace py = pybind11;
using namespace py::literals;

namespace catena::python {
namespace {

/// A finished diagnosis with the recordings that were handed in for it.
struct FinishedDiagnosis {
  DiagnosisRecord record;
  HandedIn recordings;

  const std::string& document() const { return record.files.back().second; }

  void write(const std::filesystem::path& folder) const {
    OutputFolder output(folder, kDiagnosisNames);
    output.publish([&](const std::filesystem::path& unfinished) {
      write_diagnosis(record, unfinished, output.path());
    });
  }

  void report(const std::filesystem::path& file) const {
    const WorkFolder scratch = scratch_folder();
    for (const auto& [name, text] : record.files) {
      std::filesystem::create_directories((scratch.path() / name).parent_path());
      write_whole_file(scratch.path() / name, text);
    }
    report::write_report(results::read_document(scratch.path()), {file, {}});
  }

  /// Paths in the case and in the model are relative to the root of the file system, so they hold
  /// in every folder.
  py::tuple state() const {
    std::optional<std::string> model;
    if (record.model) model = description_text(*record.model, kRoot);
    return py::make_tuple(record.table, record.files, case_text(record.the_case, kRoot), model,
                          tables_state(recordings));
  }

  static FinishedDiagnosis from(const py::tuple& state) {
    FinishedDiagnosis finished;
    finished.recordings = tables_from(state[4].cast<py::dict>());
    DiagnosisRecord& record = finished.record;
    record.table = state[0].cast<std::string>();
    record.files = state[1].cast<decltype(record.files)>();
    record.the_case =
        parse_case(state[2].cast<std::string>(), "pickled case", kRoot, finished.recordings);
    if (const auto model = state[3].cast<std::optional<std::string>>())
      record.model = parse_description(*model, kRoot + "pickled model");
    return finished;
  }

 private:
  static inline const std::string kRoot = "/";
};

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

/// Returns the Diagnosis of catena/_diagnosis.py.
py::object diagnose_case(const std::filesystem::path& case_file,
                         const std::optional<py::dict>& handed_in,
                         const std::vector<std::filesystem::path>& effects, int max_effects,
                         int max_links, int refits, bool discover, int threads,
                         const std::optional<py::function>& progress, bool large_work) {
  if (max_effects < 0 || max_links < 1 || refits < 1 || threads < 1)
    throw std::invalid_argument(
        "max_effects is 0 or more; max_links, refits and threads are 1 or more");
  std::atomic<bool> stop{false};
  std::exception_ptr raised;
  FinishedDiagnosis finished;
  if (handed_in) finished.recordings = tables_of(*handed_in);
  std::vector<std::string> warnings;
  const auto work = [&] {
    const ReadOnce inputs;
    const Case the_case = read_case(case_file, finished.recordings);
    const WorkFolder scratch = scratch_folder();
    ProviderOptions provider;
    provider.stop = &stop;
    provider.large_work = large_work;
    DiagnosisContext context(the_case, effects, scratch.path(), fit_least_squares, provider);
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
      const Problem problem(for_the_search(the_case), context.model_with({}, the_case.links));
      warnings = problem.warnings();
      require_yes_for_diagnosis(problem, context);
      const Diagnosis found =
          diagnose(the_case, context, {max_effects, max_links, refits, discover});
      finished.record = record_of(found, find_out(found), context);
    } catch (const InputError&) {
      throw;
    } catch (const std::runtime_error& error) {
      throw ComputationError(error.what());
    }
  };
  try {
    run_interruptibly(work, stop);
  } catch (const ComputationError&) {
    if (!raised) throw;
  }
  if (raised) std::rethrow_exception(raised);
  for (const std::string& warning : warnings)
    if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 1) != 0) throw py::error_already_set();
  return py::module_::import("catena._diagnosis").attr("Diagnosis")(std::move(finished));
}

}  // namespace

void add_diagnoses(py::module_& module) {
  py::class_<FinishedDiagnosis>(module, "DiagnosisRecord",
                                "A finished diagnosis, as it is printed and written.")
      .def_property_readonly("table", [](const FinishedDiagnosis& d) { return d.record.table; })
      .def_property_readonly("document", &FinishedDiagnosis::document)
      .def("write", &FinishedDiagnosis::write, "folder"_a, py::call_guard<py::gil_scoped_release>())
      .def("report", &FinishedDiagnosis::report, "file"_a, py::call_guard<py::gil_scoped_release>())
      .def(py::pickle([](const FinishedDiagnosis& d) { return d.state(); },
                      &FinishedDiagnosis::from));
  const DiagnosisOptions defaults;
  module.def(
      "diagnose", &diagnose_case, "case"_a, "recordings"_a = py::none(), py::kw_only(),
      "effects"_a = std::vector<std::filesystem::path>{}, "max_effects"_a = defaults.max_effects,
      "max_links"_a = defaults.max_links, "refits"_a = defaults.refits,
      "discover"_a = defaults.discover, "threads"_a = 2, "progress"_a = py::none(),
      "large_work"_a = false,
      "Finds the effect that the model of a case file lacks, adds it, fits again. recordings: "
      "as Case takes them. effects: "
      "effect files of your own to look for as well. discover: a law of no library is sought even "
      "where the gap closes. progress(line) is told what is being "
      "done, how much of it is left and the best so far; what it raises ends the diagnosis and is "
      "raised again. Raises InputError for a "
      "bad case and, unless large_work, where it needs more than 10 minutes or 4 GB before the "
      "first "
      "look at candidates; ComputationError where a model cannot be made or fitted.");
}

}  // namespace catena::python
