// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "identify/results/result.hpp"

namespace catena::results {

/// result.json or diagnosis.json, as JSON with a line for each value; NaN and infinity are null.
std::string text_of(const Result& result);
std::string text_of(const Diagnosis& diagnosis);

/// Formulas of a model as the generator writes them: {"links": 3, "equations": [...]}.
Derived read_derived(const std::string& json);

/// One report's subject: a result, and with a diagnosis the last of its rounds' results.
struct Document {
  Result result;
  std::optional<Diagnosis> diagnosis;
};

/// Reads a file, or links_study.json, result.json or diagnosis.json of a folder (the last of these
/// that there is). Throws InputError that names the file, the key, the value and the rule it broke.
Document read_document(const std::filesystem::path& path);

}  // namespace catena::results
