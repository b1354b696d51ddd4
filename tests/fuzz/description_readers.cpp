// SPDX-License-Identifier: GPL-3.0-or-later
#include <stdexcept>

#include "common/toml_reader.hpp"
#include "description/description.hpp"
#include "description/effect_reader.hpp"
#include "description/expression_syntax.hpp"
#include "description/formula.hpp"
#include "description/unit.hpp"
#include "tests/fuzz/readers.hpp"

namespace catena::tests {
namespace {

void read_an_effect(const std::string& text) {
  const Effect effect = read_effect(TomlTable::parse(text, "effect.toml", "effect"));
  (void)formulas(effect);
  Description description = plain_chain();
  description.effects.push_back(effect);
  (void)canonical_text(description);
}

void read_a_description(const std::string& text) {
  (void)canonical_text(read_description(written("model.toml", text)));
}

void read_a_formula(const std::string& text) { (void)parse_syntax({text, "formula", 1, "force"}); }

void read_a_unit(const std::string& text) {
  try {
    const Unit unit = Unit::parse(text);
    if (Unit::parse(unit.text()) != unit) throw std::logic_error("a unit is not read as written");
  } catch (const std::invalid_argument& error) {
    require_short(error.what());
  }
}

constexpr Reader kDescriptionReaders[] = {
    {"effect", refused_or_read<read_an_effect>},
    {"description", refused_or_read<read_a_description>},
    {"formula", refused_or_read<read_a_formula>},
    {"unit", refused_or_read<read_a_unit>},
};

}  // namespace

std::span<const Reader> description_readers() { return kDescriptionReaders; }

}  // namespace catena::tests
