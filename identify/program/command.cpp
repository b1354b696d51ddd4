// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/command.hpp"

#include <array>
#include <cctype>
#include <csignal>
#include <iostream>
#include <map>

#include "common/command_line.hpp"
#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/whole_file.hpp"
#include "identify/program/progress.hpp"
#include "identify/results/csv_tables.hpp"
#include "identify/results/energy_remark.hpp"

namespace catena {
namespace {

std::atomic<bool> g_interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void on_interruption(int) { g_interrupted = true; }

constexpr std::array<const char*, 5> kMotionFiles = {"positions", "angles", "forces", "energy",
                                                     "events"};

/// Of these, how many a model has: the last is that of its events.
std::size_t motion_files(const Model& model) {
  return kMotionFiles.size() - (model.events() == 0 ? 1 : 0);
}
/// More than any machine has, and a thread costs memory.
constexpr int kMostThreads = 1024;
/// The name of a file has at most 255 bytes, of which write_whole_file needs some for a time.
constexpr std::size_t kLongestSuffix = 220;

/// ".csv" or, where there are several experiments, "_NAME.csv" with a name fit for files.
std::string suffix_of(const Problem& problem, int experiment) {
  if (problem.experiments().size() <= 1) return ".csv";
  std::string name = problem.experiments()[static_cast<std::size_t>(experiment)].spec.name;
  for (char& c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && !std::isalnum(byte) && c != '.' && c != '-') c = '_';
  }
  return "_" + name + ".csv";
}

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& options,
                        const std::string& default_ending) {
  options.default_ending = default_ending;
  command.add_option("CASE", options.case_file, "case file (TOML, kind = \"case\")")->required();
  command.add_option("-o,--output", options.output,
                     "folder for the results; default: CASE" + default_ending + ", here");
  command.add_flag("-q,--quiet", options.quiet, "print nothing but errors");
  command.add_flag("--json", options.json, "print the result as JSON instead of tables");
  add_yes_option(command, options.yes);
}

void add_threads_option(CLI::App& command, int& threads, const std::string& unless_given) {
  command
      .add_option("--threads", threads,
                  "threads; " + unless_given + ". Results do not depend on it")
      ->check(CLI::Range(1, kMostThreads));
}

const std::atomic<bool>& interrupted() { return g_interrupted; }

void watch_for_interruption() {
  struct sigaction action = {};
  action.sa_handler = on_interruption;
  action.sa_flags = static_cast<int>(SA_RESETHAND);  // the second one ends the program
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // A terminal that closes; nohup has it ignored, and it stays so.
  struct sigaction before = {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
}

int report_interruption(const std::string& outcome) {
  std::cerr << "catena: interrupted; " << outcome << "\n";
  return kExitInterrupted;
}

ProviderOptions provider_options(const CommonOptions& options, const std::function<void()>& clear) {
  ProviderOptions provider;
  provider.stop = &interrupted();
  provider.large_work = options.yes;
  if (!options.quiet)
    provider.notice = [clear](const std::string& line) {
      clear();
      std::cerr << "catena: " + line + "\n";
    };
  return provider;
}

Model model_of(const Case& the_case, const CommonOptions& options) {
  const Waiting waiting(!options.quiet, [] { return std::string("preparing the model"); });
  return provide_model(the_case.description, the_case.links, provider_options(options));
}

void show_warnings(const Problem& problem, const CommonOptions& options) {
  if (options.quiet) return;
  for (const std::string& warning : problem.warnings())
    std::cerr << "catena: warning: " << warning << "\n";
}

void warn_of_energy(const Simulation& simulation) {
  if (const std::string words = energy_remark(simulation); !words.empty())
    std::cerr << "warning: " << words << "\n";
}

std::filesystem::path output_folder(const CommonOptions& options) {
  if (!options.output.empty()) return options.output;
  return options.case_file.stem().string() + options.default_ending;
}

void write_output(OutputFolder& output, const OutputFiles& files) {
  output.publish([&](const std::filesystem::path& folder) {
    for (const auto& [name, text] : files) write_whole_file(folder / name, text);
  });
}

std::vector<std::string> motion_file_names(const Problem& problem) {
  std::map<std::string, const ExperimentSpec*> of_suffix;
  if (problem.experiments().empty()) of_suffix[".csv"] = nullptr;
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const ExperimentSpec& spec = problem.experiments()[e].spec;
    const auto [other, is_new] =
        of_suffix.try_emplace(suffix_of(problem, static_cast<int>(e)), &spec);
    const std::string rule = spec.where + ": name: " + in_quotes(spec.name) + ": ";
    if (!is_new)
      throw InputError(rule + "its files would have the names of those of " +
                       in_quotes(other->second->name) + "; rename one");
    if (other->first.size() > kLongestSuffix)
      throw InputError(rule + "too long for the name of a file; at most " +
                       std::to_string(kLongestSuffix - 5) + " bytes are possible");
  }
  std::vector<std::string> names;
  for (const auto& [suffix, spec] : of_suffix)
    for (std::size_t i = 0; i < motion_files(problem.model()); ++i)
      names.push_back(kMotionFiles[i] + suffix);
  return names;
}

void add_motion_files(const Problem& problem, int experiment, const Motion& motion,
                      OutputFiles& files) {
  const std::string suffix = suffix_of(problem, experiment);
  const std::string texts[] = {positions_csv(motion), angles_csv(problem.model(), motion),
                               forces_csv(motion), energy_csv(problem.model(), motion),
                               events_csv(motion)};
  for (std::size_t i = 0; i < motion_files(problem.model()); ++i)
    files.emplace_back(kMotionFiles[i] + suffix, texts[i]);
}

}  // namespace catena
