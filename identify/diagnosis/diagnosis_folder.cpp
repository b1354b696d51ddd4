// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/diagnosis_folder.hpp"

#include "common/whole_file.hpp"
#include "identify/cases/case_writer.hpp"
#include "identify/diagnosis/sealed_part.hpp"
#include "identify/models/model_provider.hpp"

namespace catena {

namespace fs = std::filesystem;

WorkFolder scratch_folder() { return WorkFolder(fs::temp_directory_path(), "catena-diagnose-"); }

DiagnosisRecord record_of(const Diagnosis& found, const DiagnosisFindings& findings,
                          const DiagnosisContext& context) {
  DiagnosisRecord record{diagnosis_table(found, findings),
                         diagnosis_files(found, findings, context),
                         with_opened_seals(*found.final.problem).with(found.final.x),
                         {},
                         found.law};
  if (!found.effects.empty())
    record.model = context.description_with(found.effects, record.the_case.links, "diagnosed");
  return record;
}

void write_diagnosis(const DiagnosisRecord& record, const fs::path& folder, const fs::path& place) {
  for (const auto& [name, text] : record.files) {
    fs::create_directories((folder / name).parent_path());
    write_whole_file(folder / name, text);
  }
  Case the_case = record.the_case;
  if (record.model) the_case.description = place / "model.toml";
  write_whole_file(folder / "diagnosed.toml", case_text(the_case, place));
  if (!record.model) return;
  const auto model_with_law_in = [&](const fs::path& where) {
    Description model = *record.model;
    for (Effect& effect : model.effects)
      if (effect.id == record.law) effect.source_file = where / (record.law + ".toml");
    return model;
  };
  write_whole_file(folder / "model.toml", description_text(model_with_law_in(place), place));
  derive_model(model_with_law_in(folder), the_case.links, folder / "model");
}

}  // namespace catena
