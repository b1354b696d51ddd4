// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <iostream>

#include "generator/description/input_error.hpp"
#include "identify/ceres/least_squares.hpp"
#include "identify/diagnosis/diagnosis_text.hpp"
#include "identify/process.hpp"
#include "identify/program/command.hpp"

namespace catena {
namespace {

namespace fs = std::filesystem;

struct DiagnoseOptions : CommonOptions {
  std::vector<fs::path> effects;
  DiagnosisOptions diagnosis;
  int threads = 2;
};

/// A folder that is gone when the diagnosis is over.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "catena-diagnose-XXXXXX").string();
    if (!mkdtemp(pattern.data()))
      throw std::runtime_error("no folder could be made in " + fs::temp_directory_path().string());
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// A folder beside `folder` in which a result is put together: what stands in `folder` is replaced at
/// once when all of it is there, and an interrupted run leaves nothing.
class UnfinishedFolder {
 public:
  explicit UnfinishedFolder(fs::path folder) : folder_(std::move(folder)), path_(folder_) {
    path_ += ".unfinished";
    std::error_code error;
    fs::remove_all(path_, error);
    fs::create_directories(path_, error);
    if (error)
      throw InputError("--output " + folder_.string() + ": cannot be made: " + error.message());
  }
  ~UnfinishedFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;
  const fs::path& path() const { return path_; }

  void publish() {
    fs::create_directories(folder_);
    for (const auto& entry : fs::directory_iterator(path_)) {
      const fs::path target = folder_ / entry.path().filename();
      fs::remove_all(target);
      fs::rename(entry.path(), target);
    }
  }

 private:
  fs::path folder_, path_;
};

/// The case with the final model, its description and the emitted code.
void keep_model(const Diagnosis& found, const Workshop& workshop, const fs::path& folder) {
  Case study = found.final.problem->with(found.final.x);
  if (!found.effects.empty()) {
    study.description = folder / "model.toml";
    workshop.write_description_with(found.effects, study.links, "diagnosed", study.description);
    const ProcessResult derived = run_process(
        {find_derive_program().string(), "derive", "--description", study.description.string(),
         "--links", std::to_string(study.links), "--output", (folder / "model").string()},
        true);
    if (derived.exit_status != 0)
      throw ModelError("deriving the model again failed: " + derived.output);
  }
  write_case(study, folder / "diagnosed.toml");
}

int diagnose_case(const DiagnoseOptions& options) {
  watch_for_interruption();
  const Case study = read_case(options.case_file);
  const ScratchFolder scratch;
  ProviderOptions provider;
  if (!options.quiet)
    provider.notice = [](const std::string& line) { std::cerr << "catena: " << line << "\n"; };
  Workshop workshop(study.description, options.effects, scratch.path(), fit_least_squares,
                    provider);
  workshop.stop = &interrupted();
  workshop.threads = options.threads;
  if (isatty(STDERR_FILENO)) workshop.notice = provider.notice;
  fs::path folder = fs::absolute(output_folder(options)).lexically_normal();
  if (!folder.has_filename()) folder = folder.parent_path();  // "found/"
  UnfinishedFolder output(folder);
  try {
    const Diagnosis found = diagnose(study, workshop, options.diagnosis);
    const DiagnosisFindings findings = find_out(found);
    const OutputFiles files = diagnosis_files(found, findings, workshop);
    for (const auto& [name, text] : files)
      write_output((output.path() / name).parent_path(), {{fs::path(name).filename().string(), text}});
    keep_model(found, workshop, output.path());
    output.publish();
    if (options.json)
      std::cout << files.back().second;
    else if (!options.quiet)
      std::cout << diagnosis_table(found, findings) << "written to " << folder.string() << "\n";
  } catch (const Interrupted&) {
    std::cerr << "catena: interrupted, nothing was written\n";
    return kExitInterrupted;
  }
  return kExitSuccess;
}

}  // namespace

void add_diagnose_command(CLI::App& program, int& exit_status) {
  static DiagnoseOptions options;
  CLI::App* command = program.add_subcommand(
      "diagnose", "find the effect that a model lacks, add it, show the gap shrink");
  command->footer(
      "Example:\n  catena diagnose cable.toml --output found\n"
      "prints the verdict first: none, named, ambiguous or unexplained (exit status 0 for all "
      "four), and\n"
      "writes found/diagnosis.json, diagnosed.toml (the case with the effect), model.toml and the "
      "emitted\n"
      "code in found/model.");
  add_common_options(*command, options);
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
  command->add_option("--threads", options.threads, "threads")->check(CLI::Range(1, 64));
  command->callback([&exit_status] { exit_status = diagnose_case(options); });
}

}  // namespace catena
