// SPDX-License-Identifier: BSD-3-Clause
#include "description/built_in_effects.hpp"

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "description/effect_reader.hpp"

namespace catena {

std::vector<std::string> built_in_effect_ids() {
  std::vector<std::string> ids;
  for (const BuiltInEffect& effect : built_in_effects()) ids.emplace_back(effect.id);
  return ids;
}

Effect built_in_effect(std::string_view id) {
  for (const BuiltInEffect& effect : built_in_effects())
    if (effect.id == id)
      return read_effect(TomlTable::parse(effect.text, "built in: " + std::string(id), "effect"));
  throw InputError(in_quotes(id) + " is not a built-in effect" +
                   suggestion(id, built_in_effect_ids()));
}

}  // namespace catena
