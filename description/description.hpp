// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "description/effect.hpp"

namespace catena {

/// Which model: the plain chain with the effects listed, in their order.
/// Read from a TOML file of kind "model".
struct Description {
  std::string id;
  std::vector<int> links;  ///< the link counts to derive when none is asked for; may be empty
  std::vector<Effect> effects;
  std::string source_file;
};

/// The chain without any effect, id "chain".
Description plain_chain();

/// Reads a description and the effects it names: a built-in id, or a path to a file (ending in
/// .toml) relative to the description. Throws InputError naming file, line, key, value and rule.
Description read_description(const std::filesystem::path& path);

/// Why effects cannot stand in one description (an id twice, or two that add a coordinate, state or
/// signal of one name), and what to do; empty if they can.
std::string conflict_between(const std::vector<Effect>& effects);

/// Writes a description that read_description reads back to the same canonical text. Effects read
/// from files are named by their path relative to where the description is written.
/// The file is written whole or not at all.
void write_description(const Description& description, const std::filesystem::path& path);

/// What decides the equations, and nothing else: not spaces, comments, titles, paths, the id of the
/// description, its link counts, or the order of keys. For hashing and comparing.
std::string canonical_text(const Description& description);

}  // namespace catena
