// SPDX-License-Identifier: BSD-3-Clause
#include "common/nearest_name.hpp"

#include <doctest/doctest.h>

TEST_CASE("the nearest name is the one meant, or none") {
  const std::vector<std::string> known = {"length", "density", "stiffness", "damping", "load_mass"};
  struct Row {
    const char *word, *nearest;
  };
  const Row rows[] = {
      {"lenght", "length"},
      {"stifness", "stiffness"},
      {"damping", "damping"},
      {"dampping", "damping"},
      {"loadmass", "load_mass"},
      {"temperature", ""},
      {"x", ""},
  };
  for (const Row& row : rows) {
    CAPTURE(row.word);
    CHECK(catena::nearest_name(row.word, known) == row.nearest);
  }
}

TEST_CASE("a suggestion names the nearest, or all that there are") {
  CHECK(catena::suggestion("lenght", {"mass", "length"}) == "; did you mean \"length\"?");
  CHECK(catena::suggestion("zzzzz", {"mass", "length"}) == "; known are length and mass");
  CHECK(catena::suggestion("q", {"N", "m"}) == "; known are N and m");
  CHECK(catena::suggestion("zzzzz", {}) == "; none is known here");
  CHECK(catena::listed({"a", "b", "c"}) == "a, b and c");
}

TEST_CASE("long words and many names give a short suggestion at once") {
  const std::string word(100'000, 'a');
  CHECK(catena::nearest_name(word, {word + "b"}).empty());
  CHECK(catena::nearest_name("length", {"length" + word}).empty());
  CHECK(catena::suggestion("z", {word}).size() < 200);
  std::vector<std::string> columns;
  for (int i = 0; i < 1000; ++i) columns.push_back("column_" + std::to_string(i));
  const std::string text = catena::suggestion("z", columns);
  CHECK(text.starts_with("; some of the 1000 known are column_0, column_1, "));
  CHECK(text.size() < 1000);
}
