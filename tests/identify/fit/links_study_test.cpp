// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/links_study.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace catena;

namespace {

std::vector<LinksResult> study(const std::vector<std::pair<int, double>>& errors) {
  std::vector<LinksResult> results;
  for (const auto& [links, error] : errors) {
    results.emplace_back().links = links;
    results.back().fit.error = error;
  }
  return results;
}

}  // namespace

TEST_CASE("the fewest links that are enough are recommended") {
  const auto falling = study({{2, 9.0}, {24, 1.01}, {6, 1.04}, {48, 1.0}});
  CHECK(recommended_links(falling, 0.05) == 6);
  CHECK(recommended_links(falling, 0.02) == 24);
  CHECK_FALSE(more_links_are_worse(falling, 0.05));
}

TEST_CASE("errors that grow with the links show a wrong model") {
  CHECK(more_links_are_worse(study({{6, 9.7}, {24, 14.0}, {12, 12.4}}), 0.05));
  CHECK_FALSE(more_links_are_worse(study({{6, 1.0}, {24, 1.04}}), 0.05));
  CHECK_FALSE(more_links_are_worse({}, 0.05));
}

TEST_CASE("fits that failed count for nothing") {
  const double failed = std::nan("");
  CHECK(recommended_links(study({{2, failed}, {4, 2.0}}), 0.05) == 4);
  CHECK(recommended_links(study({{2, failed}}), 0.05) == -1);
}
