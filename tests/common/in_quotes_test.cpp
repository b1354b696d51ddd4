// SPDX-License-Identifier: BSD-3-Clause
#include "common/in_quotes.hpp"

#include <doctest/doctest.h>

TEST_CASE("a message repeats a value whole, or its beginning and how long it is") {
  const std::string longest(catena::kMostQuoted, 'a');
  struct Row {
    std::string value, in_quotes;
  };
  const Row rows[] = {
      {"kg", "\"kg\""},
      {"", "\"\""},
      {"a \"b\" \\", R"("a \"b\" \\")"},
      {"a\nb\x1B[2J", R"("a\nb\u001B[2J")"},
      {longest, "\"" + longest + "\""},
      {longest + "a", "\"" + longest + "...\" (121 characters)"},
      {std::string(40'000, 'a'), "\"" + longest + "...\" (40000 characters)"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.value);
    CHECK(catena::in_quotes(row.value) == row.in_quotes);
  }
  CHECK(catena::shortened("a \"b\"") == "a \"b\"");
  CHECK(catena::shortened("abcd", 3) == "abc... (4 characters)");
}

TEST_CASE("a character of several bytes counts as one and is not cut") {
  CHECK(catena::shortened("äöü", 3) == "äöü");
  CHECK(catena::shortened("äöüß", 3) == "äöü... (4 characters)");
}
