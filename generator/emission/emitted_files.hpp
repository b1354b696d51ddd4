// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a derivation leaves on disk.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "description/description.hpp"
#include "generator/emission/model_writer.hpp"
#include "generator/emission/statement_text.hpp"

namespace catena {

/// File name -> text.
using EmittedFiles = std::map<std::string, std::string>;

/// Everything needed to compile the models of a description at the given link counts, and per model
/// a summary of what was found (summary_name). `library`: also the look-up of all of them
/// (models.hpp, models.cpp), the list for CMake and, without effects, the model for any number of
/// links, of C++ alone. `progress` is told of each model.
/// `layout`: for all of them; else layout_for each.
EmittedFiles emit_files(const Description& description, const std::vector<int>& links, bool library,
                        const std::function<void(const ModelSummary&, double seconds)>& progress,
                        std::optional<Layout> layout = std::nullopt,
                        Language language = Language::kCpp);

/// "chain_12.json", of C99 "chain_12.c99.json": both forms may lie in one folder.
std::string summary_name(const std::string& model, Language language);

/// Straight lines for short chains, loops for long ones: docs/scale.md has the measurements.
Layout layout_for(int links);

}  // namespace catena
