// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "description/effect.hpp"

namespace catena {

/// Where the chain moves: in one vertical plane, or in space.
enum class Space { kPlane, kThreeDimensional };

/// The words for them in files and options, in their order.
std::vector<std::string> space_words();

/// Describes a model: the plain chain and its effects, in their order. The file is TOML of kind
/// "model".
///
///     Description description = plain_chain();
///     description.id = "falling";
///     description.effects.push_back(built_in_effect("air_drag_quadratic"));
///     write_description(description, "falling.toml");
struct Description {
  std::string id;
  std::vector<int> links;  ///< numbers of links to derive if the caller names none; may be empty
  std::vector<Effect> effects;
  std::string source_file;
  Space space = Space::kPlane;

  /// The effects that hold the far end or a joint, in their order; none: the cable hangs from its support alone.
  std::vector<const Effect*> holding() const {
    std::vector<const Effect*> list;
    for (const Effect& effect : effects)
      if (effect.held_end.holds()) list.push_back(&effect);
    return list;
  }
};

/// The chain without any effect, id "chain".
Description plain_chain();

/// Whether it is the plane chain without any effect, whatever its id.
bool is_plain_chain(const Description& description);

/// Reads a description and the effects it names: a built-in id, or a path to a file (ending in
/// .toml) relative to the description. Throws InputError naming file, line, key, value and rule.
Description read_description(const std::filesystem::path& path);

/// The same from the text of a description. `name` stands for the file in messages, and paths in the
/// text are relative to its folder.
Description parse_description(const std::string& text, const std::string& name);

/// Why `effects` cannot be in one description, and what to do: an id is there twice, or two effects
/// add a coordinate, state or signal of the same name. Empty if they can.
std::string conflict_between(const std::vector<Effect>& effects);

/// Why an effect has no meaning in this space; empty: it has one. In the plane no effect moves the
/// support across or turns its clamp, or holds the far end. In space none has what only the plane gives
/// a meaning: torques, coordinates of links, stretch, the angle of a link, sensors of positions that
/// say nothing of what is across.
std::string why_not_in(Space space, const Effect& effect);

/// The same for the effects of a description: each has a meaning in its space, and no two give the
/// direction of the clamp or hold the far end. None has an id that what holds the far end has.
std::string conflict_in(const Description& description);

/// The file of a description that is to be in `folder`; read_description gives the same canonical
/// text. Effects that were read from files are named by their path relative to the folder.
std::string description_text(const Description& description, const std::filesystem::path& folder);

/// Writes description_text whole or not at all. Throws InputError that names the path if it cannot
/// be written.
void write_description(const Description& description, const std::filesystem::path& path);

/// Writes a description and its effect files, as they were read (ReadOnce), into a folder of their
/// own: another program then reads what this one did. Returns the description with the paths of the
/// copies.
Description copy_as_read(const Description& description, const std::filesystem::path& folder);

/// A text for hashing and comparing, which contains what the equations depend on and nothing else:
/// no spaces, comments, titles, paths, numbers of links or order of keys, nor the description's own
/// id.
std::string canonical_text(const Description& description);

}  // namespace catena
