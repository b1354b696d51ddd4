// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "identify/models/model_provider.hpp"
#include "identify/problem/motion.hpp"
#include "identify/problem/problem.hpp"
#include "identify/results/output_folder.hpp"

namespace catena {

/// Exit statuses of the programs.
enum : int { kExitSuccess = 0, kExitFailed = 1, kExitUsage = 2, kExitInterrupted = 130 };

/// What every command that works on a case takes.
struct CommonOptions {
  std::filesystem::path case_file;
  std::filesystem::path output;  ///< empty: the case's name and `default_ending`, here
  std::string default_ending;    ///< "_result": no command replaces what another one wrote
  bool quiet = false;
  bool json = false;  ///< print the result file instead of tables
  bool yes = false;   ///< begin work above kMostUnasked (common/large_work.hpp), too
};
/// Adds CASE, --output, --quiet, --json and --yes to a command.
void add_common_options(CLI::App& command, CommonOptions& options,
                        const std::string& default_ending);
/// `unless_given` says in words what `threads` is now.
void add_threads_option(CLI::App& command, int& threads, const std::string& unless_given);

/// True once the user pressed Ctrl-C. The second Ctrl-C ends the program at once.
const std::atomic<bool>& interrupted();
/// From now on Ctrl-C sets interrupted().
void watch_for_interruption();
/// Says on standard error that the user pressed Ctrl-C and what became of the work. Returns the exit
/// status.
int report_interruption(const std::string& outcome);

/// How the models of a command are made. What is said of it goes to standard error, after `clear`.
ProviderOptions provider_options(
    const CommonOptions& options, const std::function<void()>& clear = [] {});

/// The model of a case, with a line on standard error where it has to be made first.
Model model_of(const Case& the_case, const CommonOptions& options);

/// What is odd about the recordings of a problem, or without any about its case, on standard error;
/// nothing if quiet.
void show_warnings(const Problem& problem, const CommonOptions& options);

/// Says on standard error where the energy balance of a simulation is off.
void warn_of_energy(const Simulation& simulation);

/// --output, or the name that stands for it.
std::filesystem::path output_folder(const CommonOptions& options);

/// Files of a result under their names.
using OutputFiles = std::vector<std::pair<std::string, std::string>>;
/// Puts them there, whole or not at all. Throws InputError where it cannot be written.
void write_output(OutputFolder& output, const OutputFiles& files);

/// positions.csv, angles.csv, forces.csv and energy.csv of the motions, and events.csv where the model has some; where there are several
/// experiments, positions_run_1.csv and so on, by the name of the experiment.
std::vector<std::string> motion_file_names(const Problem& problem);
/// The texts of these files for one experiment.
void add_motion_files(const Problem& problem, int experiment, const Motion& motion,
                      OutputFiles& files);

}  // namespace catena
