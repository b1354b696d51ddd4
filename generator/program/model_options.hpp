// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "description/description.hpp"
#include "generator/emission/statement_text.hpp"

namespace catena {

/// The options that say which models a command is about.
struct ModelOptions {
  bool yes = false;  ///< begin work above kMostUnasked (common/large_work.hpp), too
  std::string description;
  std::vector<int> links;
  std::vector<std::string> effects;
};

/// Adds --description, --links, --effect and --yes to a command.
void add_model_options(CLI::App& command, ModelOptions& options);

/// --effect, and the effects it names. Throws InputError also for effects that exclude one another.
void add_effect_option(CLI::App& command, std::vector<std::string>& effects);
std::vector<Effect> effects_of(const std::vector<std::string>& names);

/// --format, and the language it stands for.
CLI::Option* add_format_option(CLI::App& command, std::string& format);
Language language_of(const std::string& format);

/// The description they give. Throws InputError, also where no link count is given and one is needed.
Description description_of(const ModelOptions& options, bool needs_links = true);

}  // namespace catena
