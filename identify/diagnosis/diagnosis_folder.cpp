// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/diagnosis_folder.hpp"

#include <algorithm>

#include "common/whole_file.hpp"
#include "identify/cases/case_writer.hpp"
#include "identify/diagnosis/sealed_part.hpp"
#include "identify/models/model_provider.hpp"

namespace catena {

namespace fs = std::filesystem;

WorkFolder scratch_folder() { return WorkFolder(temporary_folder(), "catena-diagnose-"); }

namespace {

/// The case as it is written. Priors of what the diagnosis freed are weighed against a noise that it found; the
/// case need not state one.
Case written(Case the_case, const Case& asked) {
  for (ParameterSpec& spec : the_case.parameters) {
    const bool own = std::any_of(asked.parameters.begin(), asked.parameters.end(),
                                 [&](const ParameterSpec& each) { return each.name == spec.name; });
    if (!own) spec.measured = spec.standard_deviation = kNotGiven;
  }
  return the_case;
}

}  // namespace

DiagnosisRecord record_of(const Diagnosis& found, const DiagnosisFindings& findings,
                          const DiagnosisContext& context) {
  DiagnosisRecord record{diagnosis_table(found, findings),
                         diagnosis_files(found, findings, context),
                         written(with_opened_seals(*found.final.problem).with(found.final.x),
                                 found.stages.front().model.problem->the_case()),
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
