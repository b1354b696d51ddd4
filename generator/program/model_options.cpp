// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/program/model_options.hpp"

#include "common/command_line.hpp"
#include "common/input_error.hpp"
#include "common/most_links.hpp"
#include "common/sha256.hpp"

namespace catena {

namespace {

constexpr std::size_t kLongestId = 100;  // characters; file names have 255 at most

}  // namespace

void add_model_options(CLI::App& command, ModelOptions& options) {
  command.add_option("--description", options.description,
                     "description (TOML); without it the plain chain");
  command.add_option("--links", options.links, "link counts, instead of the description's");
  add_effect_option(command, options.effects);
  add_yes_option(command, options.yes);
}

void add_effect_option(CLI::App& command, std::vector<std::string>& effects) {
  command.add_option("--effect", effects, "effect to add: built-in id or TOML file; repeatable");
}

std::vector<Effect> effects_of(const std::vector<std::string>& names) {
  std::vector<Effect> effects;
  for (const std::string& name : names)
    effects.push_back(name.ends_with(".toml") ? read_effect(name) : built_in_effect(name));
  if (const std::string conflict = conflict_between(effects); !conflict.empty())
    throw InputError("--effect: " + conflict);
  return effects;
}

CLI::Option* add_format_option(CLI::App& command, std::string& format) {
  return command.add_option("--format", format, "c++, or c: plain C99 for embedding")
      ->check(CLI::IsMember({"c++", "c"}))
      ->capture_default_str();
}

Language language_of(const std::string& format) {
  return format == "c" ? Language::kC : Language::kCpp;
}

Description description_of(const ModelOptions& options, bool needs_links) {
  Description description =
      options.description.empty() ? plain_chain() : read_description(options.description);
  for (const Effect& effect : effects_of(options.effects)) {
    description.effects.push_back(effect);
    if (options.description.empty()) description.id += "_" + effect.id;
  }
  if (const std::string conflict = conflict_in(description); !conflict.empty()) {
    throw InputError("--effect: " + conflict);
  }
  // The id names files; the list of many effects would be longer than a file name may be.
  if (options.description.empty() && description.id.size() > kLongestId) {
    description.id = "chain_" + sha256_hex(canonical_text(description)).substr(0, 16);
  }
  if (!options.links.empty()) description.links = options.links;
  if (needs_links && description.links.empty()) {
    throw InputError("no link count: give --links N, or `links = [...]` in the description");
  }
  for (const int n : description.links) {
    if (n < 1 || n > kMostLinks) {
      throw InputError("--links " + std::to_string(n) + ": must be from 1 to " +
                       std::to_string(kMostLinks));
    }
  }
  return description;
}

}  // namespace catena
