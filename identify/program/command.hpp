// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <atomic>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "identify/models/model_provider.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

/// Exit statuses of the programs.
enum : int { kExitSuccess = 0, kExitFailed = 1, kExitUsage = 2, kExitInterrupted = 130 };

/// Each command adds itself to the program and stores its exit status there when it has run. What
/// it throws is printed by main: InputError and std::invalid_argument end with 2, others with 1.
void add_simulate_command(CLI::App& program, int& exit_status);
void add_identify_command(CLI::App& program, int& exit_status);
void add_report_command(CLI::App& program, int& exit_status);
void add_diagnose_command(CLI::App& program, int& exit_status);

/// What every command that works on a case takes.
struct CommonOptions {
  std::filesystem::path case_file;
  std::filesystem::path output;  ///< empty: the case's name and "_result", in the working directory
  bool quiet = false;
  bool json = false;  ///< print the result file instead of tables
};
void add_common_options(CLI::App& command, CommonOptions& options);

/// True once the user pressed Ctrl-C. The second Ctrl-C ends the program at once.
const std::atomic<bool>& interrupted();
void watch_for_interruption();

/// The model of a case, with a line on standard error where it has to be made first.
Model model_of(const Case& study, const CommonOptions& options);

/// Files under their names, written into a folder one by one, each whole; the folder is made.
using OutputFiles = std::vector<std::pair<std::string, std::string>>;
void write_output(const std::filesystem::path& folder, const OutputFiles& files);
std::filesystem::path output_folder(const CommonOptions& options);

/// "positions.csv", or "positions_run_1.csv" where there are several experiments.
std::string file_name(const Problem& problem, int experiment, const std::string& stem);

}  // namespace catena
