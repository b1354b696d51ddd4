// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/diagnosis_folder.hpp"

#include "common/whole_file.hpp"
#include "identify/cases/case_writer.hpp"
#include "identify/models/model_provider.hpp"

namespace catena {
namespace {

namespace fs = std::filesystem;

/// The case with the final model, its description and the emitted code.
void write_model(const Diagnosis& found, const DiagnosisContext& context, const fs::path& folder,
                 const fs::path& place) {
  Case the_case = found.final.problem->with(found.final.x);
  const bool named = !found.effects.empty();
  if (named) the_case.description = place / "model.toml";
  write_whole_file(folder / "diagnosed.toml", case_text(the_case, place));
  if (!named) return;
  const Description description =
      context.description_with(found.effects, the_case.links, "diagnosed");
  write_whole_file(folder / "model.toml", description_text(description, place));
  derive_model(description, the_case.links, folder / "model");
}

}  // namespace

WorkFolder scratch_folder() { return WorkFolder(fs::temp_directory_path(), "catena-diagnose-"); }

std::string write_diagnosis(const Diagnosis& found, const DiagnosisFindings& findings,
                            const DiagnosisContext& context, const fs::path& folder,
                            const fs::path& place) {
  const auto files = diagnosis_files(found, findings, context);
  for (const auto& [name, text] : files) {
    fs::create_directories((folder / name).parent_path());
    write_whole_file(folder / name, text);
  }
  write_model(found, context, folder, place);
  return files.back().second;
}

}  // namespace catena
