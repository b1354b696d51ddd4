// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/equations.hpp"

#include <algorithm>

#include "common/toml_reader.hpp"
#include "description/effect.hpp"
#include "description/effect_reader.hpp"
#include "description/formula.hpp"

namespace catena::report {
namespace {

bool is_built_in(const std::string& id) {
  const auto ids = built_in_effect_ids();
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

EquationGroup formulas_of(const EffectEntry& entry) {
  EquationGroup group{entry.title.empty() ? entry.id : entry.title, {}};
  if (!entry.formulas.empty()) {
    group.formulas = entry.formulas;
    return group;
  }
  if (entry.text.empty() && !is_built_in(entry.id)) return group;
  const Effect effect =
      entry.text.empty() ? built_in_effect(entry.id)
                         : read_effect(TomlTable::parse(entry.text, entry.id + ".toml", "effect"));
  group.heading = effect.title;
  for (const catena::Formula& formula : formulas(effect))
    group.formulas.push_back({formula.what, formula.latex, formula.mathml});
  return group;
}

}  // namespace catena::report
