// SPDX-License-Identifier: GPL-3.0-or-later
//
// Text for any number of links from the texts for two, and what two texts must have in common.
#include "generator/emission/size_pattern.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "generator/emission/any_links_writer.hpp"

namespace {

using catena::SizePattern;
using catena::written_out;

std::string text(const std::string& a, const std::string& b) {
  return SizePattern(a, b, 12).text();
}

TEST_CASE("integers that differ become expressions in the number of links") {
  CHECK(text("T x[13]; x[12] = p[72] + p[73] + p[2];", "T x[14]; x[13] = p[78] + p[79] + p[2];") ==
        "T x[links + 1]; x[links] = p[6 * links] + p[6 * links + 1] + p[2];");
  CHECK(text("i <= 11; i >= 24", "i <= 12; i >= 26") == "i <= links - 1; i >= 2 * links");
  CHECK(text("f<12>(x); g<T>(2);", "f<13>(x); g<T>(2);") == "f(links, x); g<T>(2);");
}

TEST_CASE("names and numbers with a point are no integers") {
  CHECK(text("x_12 = 0.5 * y12;", "x_12 = 0.5 * y12;") == "x_12 = 0.5 * y12;");
  CHECK_THROWS_AS(text("x_12 = y;", "x_13 = y;"), std::logic_error);
  CHECK_THROWS_AS(text("x = 1.5;", "x = 2.5;"), std::logic_error);
}

TEST_CASE("the text at another number of links") {
  const SizePattern pattern("a[12] = b[4] + c[36];", "a[13] = b[4] + c[39];", 12);
  CHECK(pattern.at(12) == "a[12] = b[4] + c[36];");
  CHECK(pattern.at(5) == "a[5] = b[4] + c[15];");
  CHECK(pattern.at(1000) == "a[1000] = b[4] + c[3000];");
}

TEST_CASE("texts that differ in more are refused") {
  CHECK_THROWS_AS(text("a[12] = b;", "a[13] = c;"), std::logic_error);
  CHECK_THROWS_AS(text("a[12] = b;", "a[13] = b; c[1] = d;"), std::logic_error);
  CHECK_THROWS_AS(text("a[12] = b; c[1] = d;", "a[13] = b;"), std::logic_error);
  CHECK_THROWS_AS(text("of 12", "of "), std::logic_error);
  CHECK_THROWS_AS(text("of ", "of 13"), std::logic_error);
  // what would need brackets, or is a type
  CHECK_THROWS_AS(text("a - 12", "a - 13"), std::logic_error);
  CHECK_THROWS_AS(text("Lanes<12> a;", "Lanes<13> a;"), std::logic_error);
}

TEST_CASE("loops written out") {
  CHECK(written_out("  x[1] = 0;\n"
                    "  for (int i = 2; i <= 4; ++i) {\n"
                    "    const T y = x[i - 1];\n"
                    "    p[24 + i - 1] = x[i] + y + x[i + 1];\n"
                    "  }\n"
                    "  for (int i = 2; i >= 1; --i) {\n    x[i] = 0;\n  }\n") ==
        "x[1] = 0;\n"
        "const T y = x[1];\np[24 + 1] = x[2] + y + x[3];\n"
        "const T y = x[2];\np[24 + 2] = x[3] + y + x[4];\n"
        "const T y = x[3];\np[24 + 3] = x[4] + y + x[5];\n"
        "x[2] = 0;\nx[1] = 0;\n");
  // as blocks of single links, and as a loop that runs over none
  CHECK(written_out("  {\n    x[3] = y[2];\n  }\n") == "x[3] = y[2];\n");
  CHECK(written_out("  for (int i = 4; i <= 3; ++i) {\n    x[i] = 0;\n  }\n").empty());
}

TEST_CASE("the plain chain has such a text") {
  const auto files = catena::emit_any_links(catena::plain_chain());
  REQUIRE(files.size() == 2);
  const std::string& header = files.at("chain_any.hpp");
  CHECK(header.find("sines_and_cosines(links, at.q, sine + 1, cosine + 1);") != std::string::npos);
  CHECK(header.find("const T gravity = at.p[6 * links + 1];") != std::string::npos);
  for (const char* number : {"12]", "13]", "14]", "<= 12", "at.p + 12", "at.p[72]"})
    CHECK(header.find(number) == std::string::npos);
}

TEST_CASE("a model of another structure has none") {
  catena::Description description = catena::plain_chain();
  description.effects.push_back(catena::built_in_effect("axial_stretch"));
  CHECK_THROWS_AS(catena::emit_any_links(description), std::logic_error);
}

}  // namespace
