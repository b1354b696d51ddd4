// SPDX-License-Identifier: BSD-3-Clause
#include "common/split.hpp"

#include <doctest/doctest.h>

using catena::lines_of;
using catena::split;

using Parts = std::vector<std::string_view>;

TEST_CASE("a text has one part more than separators") {
  CHECK(split("", ',') == Parts{""});
  CHECK(split("a", ',') == Parts{"a"});
  CHECK(split("a,b", ',') == Parts{"a", "b"});
  CHECK(split(",a,,", ',') == Parts{"", "a", "", ""});
}

TEST_CASE("nothing follows the last end of a line") {
  CHECK(lines_of("").empty());
  CHECK(lines_of("\n") == Parts{""});
  CHECK(lines_of("a\nb") == Parts{"a", "b"});
  CHECK(lines_of("a\n\nb\n") == Parts{"a", "", "b"});
}
