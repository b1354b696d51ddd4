// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/work_folder.hpp"
#include "description/description.hpp"
#include "identify/cases/case.hpp"
#include "identify/diagnosis/diagnosis_text.hpp"

namespace catena {

/// What write_diagnosis writes, as OutputFolder takes it.
inline const std::vector<std::string> kDiagnosisNames = {
    "diagnosis.json", "diagnosed.toml", "model.toml", "model/", "round_*/", "discovered_law*.toml"};

/// A temporary folder for a diagnosis to work in.
WorkFolder scratch_folder();

/// A finished diagnosis as it is printed and written. It needs nothing of what it was made with.
struct DiagnosisRecord {
  std::string table;                                       ///< diagnosis_table
  std::vector<std::pair<std::string, std::string>> files;  ///< diagnosis_files
  Case the_case;                     ///< with the parameters of the final model
  std::optional<Description> model;  ///< with the effects found; the case's own stays without any
  std::string law;  ///< the effect of `model` whose file is among `files`, or empty
};
/// Of a diagnosis that has ended; sealed parts are open in it.
DiagnosisRecord record_of(const Diagnosis& found, const DiagnosisFindings& findings,
                          const DiagnosisContext& context);

/// Writes a diagnosis into `folder`, from where it is moved to `place`: diagnosis.json, the results of the
/// rounds, diagnosed.toml and, where an effect was found, model.toml and the emitted code in model/, with the
/// file of a law that was discovered. Paths in the files are relative to `place`. Throws InputError where a
/// file cannot be written, ModelError where the model cannot be derived.
void write_diagnosis(const DiagnosisRecord& record, const std::filesystem::path& folder,
                     const std::filesystem::path& place);

}  // namespace catena
