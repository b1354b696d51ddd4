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

/// Everything needed to compile the models of a description at the given link counts, and per model a summary
/// of what was found (summary_name). `library`: also the look-up of all of them (models.hpp, models.cpp) and
/// the list for CMake; in C++, for a description without effects, with the model for any number of links.
/// `progress` is told of each model. `layout`: for all of them; else straight lines for short chains and
/// loops for long ones. `set`: in C++. Throws InputError for an effect that the chain cannot have.
EmittedFiles emit_files(const Description& description, const std::vector<int>& links, bool library,
                        const std::function<void(const ModelSummary&, double seconds)>& progress,
                        std::optional<Layout> layout = std::nullopt,
                        Language language = Language::kCpp, FunctionSet set = FunctionSet::kAll);

/// The model for any number of links (any_links_writer.hpp) and what is needed to compile it, in C++.
/// Throws InputError where the equations change with the number in more than bounds of loops.
EmittedFiles emit_any_links_files(const Description& description);

/// "chain_12.json", of C99 "chain_12.c99.json": both forms may lie in one folder.
std::string summary_name(const std::string& model, Language language);

}  // namespace catena
