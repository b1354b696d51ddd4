// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/diagnose_command.hpp"

#include <iostream>
#include <mutex>

#include "identify/cases/case_reader.hpp"
#include "identify/diagnosis/baseline.hpp"
#include "identify/diagnosis/diagnosis_folder.hpp"
#include "identify/diagnosis/diagnosis_text.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/program/command.hpp"
#include "identify/program/progress.hpp"
#include "identify/results/output_folder.hpp"

namespace catena {
namespace {

namespace fs = std::filesystem;

struct DiagnoseOptions : CommonOptions {
  std::vector<fs::path> effects;
  DiagnosisOptions diagnosis;
  int threads = 2;
};

int diagnose_case(const DiagnoseOptions& options) {
  watch_for_interruption();
  const Case the_case = read_case(options.case_file);
  const WorkFolder scratch = scratch_folder();
  std::mutex mutex;
  std::string now = "preparing the model";
  Waiting progress(!options.quiet, [&] {
    const std::scoped_lock lock(mutex);
    return now;
  });
  DiagnosisContext context(the_case, options.effects, scratch.path(), fit_least_squares,
                           provider_options(options, [&progress] { progress.clear(); }));
  context.stop = &interrupted();
  context.threads = options.threads;
  context.notice = [&](const DiagnosisProgress& news) {
    const std::scoped_lock lock(mutex);
    now = progress_line(news);
  };
  OutputFolder output(output_folder(options), kDiagnosisNames);
  const Problem problem(for_the_search(the_case), context.model_with({}, the_case.links));
  show_warnings(problem, options);
  require_yes_for_diagnosis(problem, context);
  DiagnosisRecord record;
  try {
    const Diagnosis found = diagnose(the_case, context, options.diagnosis);
    record = record_of(found, find_out(found), context);
    context.stop_if_asked();
  } catch (const std::exception&) {
    progress.clear();
    // The interruption is the cause: it ends a program that is deriving a model, too.
    if (!context.stopped()) throw;
    const std::string best = context.best();
    return report_interruption(best.empty() ? "no model was fitted yet"
                                            : "nothing was written; best so far: " + best);
  }
  progress.clear();
  output.publish([&](const fs::path& folder) { write_diagnosis(record, folder, output.path()); });
  if (options.json)
    std::cout << record.files.back().second;
  else if (!options.quiet)
    std::cout << record.table << "written to " << output.path().string() << "\n";
  return context.stopped() ? report_interruption("the best so far was written") : kExitSuccess;
}

}  // namespace

void add_diagnose_command(CLI::App& program, int& exit_status) {
  static DiagnoseOptions options;
  CLI::App* command =
      program.add_subcommand("diagnose", "find what a model lacks, add it, show the gap shrink");
  command->footer(
      "Example:\n  catena diagnose cable.toml --output found\n"
      "prints the verdict first: none, named, ambiguous, partly, discovered or\n"
      "unexplained (exit status 0 for all six), and writes found/diagnosis.json,\n"
      "diagnosed.toml (the case with the effect), model.toml, the emitted code in\n"
      "found/model, and the effect file of a law that no library has.");
  add_common_options(*command, options, "_diagnosis");
  command
      ->add_option("--effect", options.effects,
                   "an effect file of your own to look for; repeatable")
      ->check(CLI::ExistingFile);
  command->add_option("--max-effects", options.diagnosis.max_effects, "most effects to add")
      ->check(CLI::Range(0, 6));
  command->add_option("--max-links", options.diagnosis.max_links, "most links to try")
      ->check(CLI::Range(1, 500));
  command->add_option("--refits", options.diagnosis.refits, "candidates to refit in every look")
      ->check(CLI::Range(1, 30));
  command->add_flag("--discover", options.diagnosis.discover,
                    "seek a law of no library even where the gap closes");
  add_threads_option(*command, options.threads, "2");
  command->callback([&exit_status] { exit_status = diagnose_case(options); });
}

}  // namespace catena
