// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/work_folder.hpp"
#include "identify/diagnosis/diagnosis_text.hpp"

namespace catena {

/// What write_diagnosis writes, as OutputFolder takes it.
inline const std::vector<std::string> kDiagnosisNames = {"diagnosis.json", "diagnosed.toml",
                                                         "model.toml", "model/", "round_*/"};

/// A temporary folder for a diagnosis to work in.
WorkFolder scratch_folder();

/// Writes a diagnosis into `folder`, from where it is moved to `place`: diagnosis.json, the results
/// of the rounds, diagnosed.toml and, where an effect was found, model.toml and the emitted code in
/// model/. Paths in the files are relative to `place`. Returns the text of diagnosis.json. Throws
/// InputError where a file cannot be written, ModelError where the model cannot be derived.
std::string write_diagnosis(const Diagnosis& found, const DiagnosisFindings& findings,
                            const DiagnosisContext& context, const std::filesystem::path& folder,
                            const std::filesystem::path& place);

}  // namespace catena
