// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every built-in effect, emitted, compiled and run, against its derivation in 50 digits.
#include "generator/certificate/accuracy.hpp"

#include <doctest/doctest.h>

#include "generator/certificate/compiled_model.hpp"

using namespace catena;

namespace {

// What the certificates allow; measured are up to 6.
constexpr double kRoundings = 30;

void check(const Description& description, int links, int points, Language language,
           unsigned seed = 1) {
  CAPTURE(links);
  CAPTURE(static_cast<int>(language));
  const EmittedFiles files = emit_files(
      description, {links}, false, [](const ModelSummary&, double) {}, std::nullopt, language);
  const CompiledModel model(files, model_name(description, links), language);
  for (const FunctionAccuracy& accuracy :
       measure_accuracy(description, links, model.table(), points, seed)) {
    CAPTURE(accuracy.function);
    CHECK(accuracy.worst < kRoundings);
  }
}

}  // namespace

TEST_CASE("each effect as emitted computes what was derived") {
  unsigned seed = 0;
  for (const std::string& id : built_in_effect_ids()) {
    CAPTURE(id);
    Description description = plain_chain();
    description.effects.push_back(built_in_effect(id));
    if (description.effects[0].space == "3d") description.space = Space::kThreeDimensional;
    check(description, 5, 1, Language::kCpp, ++seed);  // each at another point
  }
}

TEST_CASE("all effects at once as emitted compute what was derived") {
  Description description = plain_chain();
  for (const std::string& id : built_in_effect_ids()) {
    const Effect effect = built_in_effect(id);
    if (effect.space != "3d") description.effects.push_back(effect);
  }
  check(description, 3, 2, Language::kCpp);
  check(description, 3, 2, Language::kC);
}
