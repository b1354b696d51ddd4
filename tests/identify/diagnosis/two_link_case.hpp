// SPDX-License-Identifier: BSD-3-Clause
//
// A pendulum of two links with few candidates, so that the model with all of them is made in a second.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "identify/diagnosis/doubted_knowns.hpp"
#include "identify/models/model_provider.hpp"
#include "identify/problem/marker_places.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/data.hpp"

namespace catena::testing {

/// With an experiment "run" without data. Only effects of these names are possible.
inline Case two_links_with(const std::vector<std::string>& possible) {
  Case the_case = sections(kTwoLinks);
  add_experiment(the_case, "run");
  std::vector<std::string> known = built_in_effect_ids();
  for (const char* id : {kMarkerPlaces, kCableKnowns}) known.emplace_back(id);
  for (const std::string& id : known)
    if (std::find(possible.begin(), possible.end(), id) == possible.end())
      the_case.diagnosis.impossible.push_back(id);
  return the_case;
}

inline ProviderOptions provider_of_build() {
  ProviderOptions options;
  options.derive_program = tests::build_folder() / "bin" / "catena-derive";
  return options;
}

}  // namespace catena::testing
