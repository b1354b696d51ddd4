// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/diagnosis_folder.hpp"

#include <unistd.h>

#include "common/input_error.hpp"
#include "common/whole_file.hpp"
#include "identify/cases/case_writer.hpp"
#include "identify/models/process.hpp"

namespace catena {
namespace {

namespace fs = std::filesystem;

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string() + ": cannot be made: " + error.message());
}

/// The case with the final model, its description and the emitted code.
void write_model(const Diagnosis& found, const DiagnosisContext& context, const fs::path& folder) {
  Case the_case = found.final.problem->with(found.final.x);
  if (!found.effects.empty()) {
    the_case.description = folder / "model.toml";
    context.write_description_with(found.effects, the_case.links, "diagnosed",
                                   the_case.description);
    const ProcessResult derived = run_process(
        {find_derive_program().string(), "derive", "--description", the_case.description.string(),
         "--links", std::to_string(the_case.links), "--output", (folder / "model").string()});
    if (derived.exit_status != 0)
      throw ModelError("deriving the model again failed: " + derived.errors);
  }
  write_case(the_case, folder / "diagnosed.toml");
}

}  // namespace

ScratchFolder::ScratchFolder() {
  std::string pattern = (fs::temp_directory_path() / "catena-diagnose-XXXXXX").string();
  if (!mkdtemp(pattern.data()))
    throw std::runtime_error("no folder could be made in " + fs::temp_directory_path().string());
  path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

UnfinishedFolder::UnfinishedFolder(const fs::path& folder)
    : folder_(fs::absolute(folder).lexically_normal()) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // "found/"
  path_ = folder_;
  path_ += ".unfinished";
  std::error_code error;
  fs::remove_all(path_, error);
  fs::create_directories(path_, error);
  if (error)
    throw InputError("--output " + folder_.string() + ": cannot be made: " + error.message());
}

UnfinishedFolder::~UnfinishedFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void UnfinishedFolder::publish() {
  fs::create_directories(folder_);
  for (const auto& entry : fs::directory_iterator(path_)) {
    const fs::path target = folder_ / entry.path().filename();
    fs::remove_all(target);
    fs::rename(entry.path(), target);
  }
}

std::string write_diagnosis(const Diagnosis& found, const DiagnosisFindings& findings,
                            const DiagnosisContext& context, const fs::path& folder) {
  const fs::path absolute = fs::absolute(folder);
  make_folder(absolute);
  write_model(found, context, absolute);
  const auto files = diagnosis_files(found, findings, context);
  for (const auto& [name, text] : files) {
    make_folder((absolute / name).parent_path());
    write_whole_file(absolute / name, text);
  }
  return files.back().second;
}

}  // namespace catena
