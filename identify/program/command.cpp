// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/command.hpp"

#include <cctype>
#include <csignal>
#include <iostream>

#include "common/input_error.hpp"
#include "common/whole_file.hpp"
#include "identify/results/csv_tables.hpp"

namespace catena {
namespace {

std::atomic<bool> g_interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void on_interruption(int) { g_interrupted = true; }

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& options) {
  command.add_option("CASE", options.case_file, "case file (TOML, kind = \"case\")")->required();
  command.add_option("-o,--output", options.output,
                     "folder for the results; default: CASE_result, here");
  command.add_flag("-q,--quiet", options.quiet, "print nothing but errors");
  command.add_flag("--json", options.json, "print the result as JSON instead of tables");
}

const std::atomic<bool>& interrupted() { return g_interrupted; }

void watch_for_interruption() {
  struct sigaction action = {};
  action.sa_handler = on_interruption;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second one ends the program
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

int report_interruption(const std::string& outcome) {
  std::cerr << "catena: interrupted; " << outcome << "\n";
  return kExitInterrupted;
}

Model model_of(const Case& the_case, const CommonOptions& options) {
  ProviderOptions provider;
  if (!options.quiet)
    provider.notice = [](const std::string& line) { std::cerr << "catena: " << line << "\n"; };
  return provide_model(the_case.description, the_case.links, provider);
}

void show_warnings(const Problem& problem, const CommonOptions& options) {
  if (options.quiet) return;
  for (const Experiment& experiment : problem.experiments())
    for (const std::string& warning : experiment.recording.warnings)
      std::cerr << "catena: warning: " << experiment.spec.name << ": " << warning << "\n";
}

void write_output(const std::filesystem::path& folder, const OutputFiles& files) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw InputError("--output " + folder.string() + ": cannot be made: " + error.message());
  for (const auto& [name, text] : files) write_whole_file(folder / name, text);
}

std::filesystem::path output_folder(const CommonOptions& options) {
  if (!options.output.empty()) return options.output;
  return options.case_file.stem().string() + "_result";
}

void add_motion_files(const Problem& problem, int experiment, const Motion& motion,
                      OutputFiles& files) {
  std::string suffix = ".csv";
  if (problem.experiments().size() > 1) {
    std::string name = problem.experiments()[static_cast<std::size_t>(experiment)].spec.name;
    for (char& c : name)
      if (!std::isalnum(static_cast<unsigned char>(c)) && c != '.' && c != '-') c = '_';
    suffix = "_" + name + ".csv";
  }
  files.emplace_back("positions" + suffix, positions_csv(motion));
  files.emplace_back("angles" + suffix, angles_csv(problem.model(), motion));
  files.emplace_back("forces" + suffix, forces_csv(motion));
  files.emplace_back("energy" + suffix, energy_csv(problem.model(), motion));
}

}  // namespace catena
