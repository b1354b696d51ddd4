// SPDX-License-Identifier: BSD-3-Clause
#include "common/toml_reader.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "common/number_text.hpp"
#include "tests/support/failure.hpp"

using catena::failure;
using catena::TomlTable;

namespace {

TomlTable parsed(const std::string& body) {
  return TomlTable::parse("format = 1\nkind = \"case\"\n" + body, "some.toml", "case");
}

}  // namespace

TEST_CASE("values are read as they stand") {
  const TomlTable file = parsed(
      "title = \"a cable\"\nlength = 3\nlow = -inf\nsteps = 7\nfree = true\nlist = [1, 2.5]\n"
      "counts = [1, 2]\nwords = [\"a\", \"b\"]\n[cable]\ndensity = 0.5\n[[run]]\nname = \"x\"\n"
      "[[run]]\nname = \"y\"\n[parameters.z]\nvalue = 1\n[parameters.a]\nvalue = 2\n");
  CHECK(file.text("title") == "a cable");
  CHECK(file.number("length") == 3.0);
  CHECK(std::isinf(file.number("low")));
  CHECK(file.integer("steps") == 7);
  CHECK(file.optional_flag("free") == true);
  CHECK(file.numbers("list") == std::vector<double>{1, 2.5});
  CHECK(file.integers("counts") == std::vector<long>{1, 2});
  CHECK(file.texts("words") == std::vector<std::string>{"a", "b"});
  CHECK(file.table("cable").number("density") == 0.5);
  REQUIRE(file.tables("run").size() == 2);
  CHECK(file.tables("run")[1].text("name") == "y");
  const auto parameters = file.named_tables("parameters");
  REQUIRE(parameters.size() == 2);
  CHECK(parameters[0].first == "z");  // the order of the file, not of the alphabet
  CHECK(parameters[1].second.number("value") == 2);
  CHECK(parameters[0].second.number("value") == 1);
  CHECK_FALSE(file.optional_number("absent").has_value());
  CHECK(file.tables("absents").empty());
  file.finish();
}

TEST_CASE("every error names file, line, key, value and what to do") {
  struct Row {
    const char* body;
    void (*read)(const TomlTable&);
    const char* said;
  };
  const Row rows[] = {
      {"length = \"long\"\n", [](const TomlTable& t) { t.number("length"); },
       "some.toml:3: length: \"long\" is a text where a number is wanted"},
      {"length = nan\n", [](const TomlTable& t) { t.number("length"); },
       "some.toml:3: length: nan is not a number; give one"},
      {"\nsteps = 1.5\n", [](const TomlTable& t) { t.integer("steps"); },
       "some.toml:4: steps: 1.5 is a number where a whole number is wanted"},
      {"free = 1\n", [](const TomlTable& t) { t.optional_flag("free"); },
       "some.toml:3: free: 1 is a whole number where true or false is wanted"},
      {"title = 3\n", [](const TomlTable& t) { t.text("title"); },
       "some.toml:3: title: 3 is a whole number where a text in quotes is wanted"},
      {"list = 3\n", [](const TomlTable& t) { t.numbers("list"); },
       "some.toml:3: list: 3 is a whole number where a list of numbers is wanted"},
      {"list = [1, \"b\"]\n", [](const TomlTable& t) { t.numbers("list"); },
       "some.toml:3: list: \"b\" in the list is not a number; give a list of numbers"},
      {"list = [1, 2.5]\n", [](const TomlTable& t) { t.integers("list"); },
       "some.toml:3: list: 2.5 in the list is not a whole number"},
      {"list = [1]\n", [](const TomlTable& t) { t.texts("list"); },
       "some.toml:3: list: 1 in the list is not a text"},
      {"cable = 3\n", [](const TomlTable& t) { t.table("cable"); },
       "some.toml:3: cable: 3 is a whole number where a table ([cable]) is wanted"},
      {"run = [1]\n", [](const TomlTable& t) { t.tables("run"); },
       "some.toml:3: run: 1 in the list is not a table; write [[run]]"},
      {"[cable]\n", [](const TomlTable& t) { t.table("cable").number("length"); },
       "some.toml:3: cable: \"length\" is missing; give a number"},
      {"[cable]\n\nlenght = 1\n", [](const TomlTable& t) { t.table("cable").number("length"); },
       "some.toml:3: cable: \"length\" is missing; give a number (there is \"lenght\" on line 5)"},
      {"", [](const TomlTable& t) { t.table("cable"); },
       "some.toml:1: \"cable\" is missing; give a table ([cable])"},
      {"use = \"fitt\"\n",
       [](const TomlTable& t) {
         t.choice("use", {"fit", "validate"});
       },
       "some.toml:3: use: \"fitt\" is not known here; did you mean \"fit\"?"},
      {"[cable]\ndensty = 1\n",
       [](const TomlTable& t) {
         t.table("cable").optional_number("density");
         t.finish();
       },
       "some.toml:4: unknown key \"cable.densty\"; did you mean \"density\"?"},
      {"[[run]]\nzzzzzzz = 1\n",
       [](const TomlTable& t) {
         t.tables("run")[0].optional_text("name");
         t.finish();
       },
       "some.toml:4: unknown key \"run.zzzzzzz\"; known are name"},
      {"[parameters]\nx = 1\n", [](const TomlTable& t) { t.named_tables("parameters"); },
       "some.toml:4: parameters.x: 1 is a whole number where a table ([parameters.x]) is wanted"},
  };
  for (const Row& row : rows) {
    const std::string said = failure([&] { row.read(parsed(row.body)); });
    CAPTURE(row.body);
    CAPTURE(said);
    CHECK(said.find(row.said) == 0);
  }
}

TEST_CASE("a file of another kind or format is refused") {
  struct Row {
    const char *text, *said;
  };
  std::string deep = "format = 1\n# a comment with " + std::string(1000, '.') + "\na";
  for (int k = 0; k < 40'000; ++k) deep += k % 2 ? ".b" : " . \"c.d\"";
  deep += " = 1\n";
  const auto nested = [](int depth) {
    std::string text = "format = 1\n[[t]]\na = ";
    for (int k = 0; k < depth; ++k) text += k % 2 ? "{ b = " : "[";
    text += "1";
    for (int k = depth; k-- > 0;) text += k % 2 ? "}" : "]";
    return text + "\n";
  };
  const std::string deepest = nested(200), too_deep = nested(201), far_too_deep = nested(40'000);
  const std::string long_text =
      "format = 1\ntitle = \"" + std::string(1000, '.') + "\"\nkind = \"x\"\n";
  const Row rows[] = {
      {"", "f.toml:1: format = 1 is missing"},
      {"format = 2\nkind = \"case\"\n", "f.toml:1: format: 2 is not known to this catena"},
      {"format = 1\n", "f.toml:1: kind is missing; write kind = \"case\""},
      {"format = 1\nkind = \"model\"\n",
       "f.toml:2: kind: \"model\" where a file of kind \"case\" is wanted"},
      {"format = 1\nkind = = 2\n", "f.toml:2: not valid TOML: "},
      {"format = 1\n[ = 2]\n", "f.toml:2: not valid TOML: "},
      {"format = 1\nformat = 1\n", "f.toml:2: not valid TOML: "},
      {"format = 1\nl\u00e4nge = 2\n", "f.toml:2: not valid TOML: "},
      {"\u0393oA\n[ = \"c\"\n", "f.toml:1: not valid TOML: "},
      {"format = 1\nl = 1\'\'\'\ufcff\n", "f.toml:2: not valid TOML: "},
      {"\uFEFFformat = 1 # \u00e4\nkind = \"\u00e4\"\n",
       "f.toml:2: kind: \"\u00e4\" where a file of kind \"case\" is wanted"},
      {deep.c_str(), "f.toml:3: a key of more than 200 parts"},
      {deepest.c_str(), "f.toml:1: kind is missing"},
      {too_deep.c_str(), "f.toml:3: lists or tables are nested more than 200 deep"},
      {far_too_deep.c_str(), "f.toml:3: lists or tables are nested more than 200 deep"},
      {long_text.c_str(), "f.toml:3: kind: \"x\" where a file of kind \"case\" is wanted"},
  };
  for (const Row& row : rows) {
    const std::string said = failure([&] { TomlTable::parse(row.text, "f.toml", "case"); });
    CAPTURE(said);
    CHECK(said.find(row.said) == 0);
  }
  CHECK(failure([] {
          TomlTable::read("/does/not/exist.toml", "case");
        }).find("/does/not/exist.toml: there is no such file") == 0);
  CHECK(failure([] { TomlTable::read("/", "case"); }).find("/: is a folder") == 0);
  CHECK(failure([] { TomlTable::read("m\xE4rz.toml", "case"); }) ==
        "the name of the file m\xE4rz.toml is not UTF-8; give it another (mv)");
}

TEST_CASE("the shortest text of a number reads back to it") {
  for (const double value : {0.1, 1e-6, 3.39, 1.0 / 3.0, 1e300, -0.0, 2.3e-308}) {
    CHECK(std::stod(catena::shortest_number(value)) == value);
  }
  CHECK(catena::shortest_number(0.1) == "0.1");
  CHECK(catena::shortest_number(std::numeric_limits<double>::infinity()) == "inf");
}
