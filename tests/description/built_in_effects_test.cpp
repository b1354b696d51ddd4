// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "description/description.hpp"
#include "tests/support/failure.hpp"

using namespace catena;

TEST_CASE("every built-in effect reads, is named as its file and says what it is") {
  const auto ids = built_in_effect_ids();
  CHECK(ids.size() >= 24);
  CHECK(std::is_sorted(ids.begin(), ids.end()));
  for (const std::string& id : ids) {
    CAPTURE(id);
    const Effect effect = built_in_effect(id);
    CHECK(effect.id == id);
    CHECK(effect.source_file == "built in: " + id);
    CHECK(effect.title.size() > 4);
    CHECK(effect.description.size() > 40);
    // Something must make it vanish, or a fit could never find that it is not there.
    CHECK(std::any_of(effect.parameters.begin(), effect.parameters.end(),
                      [](const EffectParameter& p) { return !std::isnan(p.neutral); }));
    for (const EffectParameter& parameter : effect.parameters) {
      CAPTURE(parameter.name);
      CHECK(parameter.description.size() > 4);
      CHECK(std::isfinite(parameter.lower));
      // Without a default a case has to give a value; built in, only limits are such.
      CHECK(std::isnan(parameter.default_value) == std::isinf(parameter.neutral));
    }
  }
}

TEST_CASE("a built-in effect that is not there names the nearest") {
  CHECK(failure([] { built_in_effect("air_drag_quadratik"); }) ==
        "\"air_drag_quadratik\" is not a built-in effect; did you mean \"air_drag_quadratic\"?");
}
