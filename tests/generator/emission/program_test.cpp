// SPDX-License-Identifier: GPL-3.0-or-later
//
// Statements as data: what they print as, what they cost, and those for any number of links.
#include "generator/emission/program.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <stdexcept>
#include <string>

#include "common/input_error.hpp"
#include "generator/emission/any_links_writer.hpp"
#include "generator/emission/function_body.hpp"
#include "generator/emission/program_pattern.hpp"
#include "generator/emission/statement_text.hpp"
#include "generator/emission/support/link_array.hpp"

using namespace catena;

namespace {

Factor read(const std::string& name) { return {Read{name, {}}}; }
Factor entry(const std::string& name, long shift) {
  return {Read{name, ArrayPlace{{}, true, shift}}};
}
Factor argument(const std::string& name, const Affine& at) {
  return {Read{name, ArrayPlace{{}, false, at}, true}};
}
Product product(std::vector<Factor> above, std::vector<Factor> below = {}) {
  return {false, std::move(above), std::move(below)};
}
Product minus(std::vector<Factor> above) { return {true, std::move(above), {}}; }

Statement assign(const std::string& array, ArrayPlace place, Sum value) {
  return Assignment{{"", array, {}}, place, std::move(value)};
}

std::string cpp(const Statements& statements) {
  return statements_text(statements, Language::kCpp, 0);
}
std::string c(const Statements& statements) { return statements_text(statements, Language::kC, 0); }

// x[2] = a (b - 1/2) / (c d);  x[i] = sin(x[i - 1]) + x[i] for i = 3 ... last
Statements sweep(long last) {
  return {Variable{Type::kScalar, "x", last + 1},
          assign("x", {{}, false, 2},
                 {product({read("a"), {Sum{product({read("b")}), minus({{Number{1, 2}}})}}},
                          {read("c"), argument("d", 2 * last)})}),
          Loop{3,
               last,
               1,
               {assign("x", {{}, true, 0},
                       {product({{Call{"sin", Read{"x", ArrayPlace{{}, true, -1}}}}}),
                        product({entry("x", 0)})})}}};
}

}  // namespace

TEST_CASE("statements in C++ and in C") {
  CHECK(cpp(sweep(12)) ==
        "T x[13];\nx[2] = a * (b - ratio<T>(1, 2)) / (c * d[24]);\n"
        "for (int i = 3; i <= 12; ++i) {\n  x[i] = sin(x[i - 1]) + x[i];\n}\n");
  CHECK(c(sweep(12)) ==
        "double x[13];\nx[2] = a * (b - (1.0 / 2.0)) / (c * d[23]);\n"
        "for (int i = 3; i <= 12; ++i) {\n  x[i] = sin(x[i - 1]) + x[i];\n}\n");
  const Statements others{
      Input{InputKind::kArray, Type::kDifferential, "d_mass", {"along", "p", {}}, 12},
      Input{InputKind::kEntry, Type::kScalar, "gravity", {"at", "p", {}}, 25},
      Block{{NamedValue{Type::kDifferential, "y", {minus({read("gravity")})}}}},
      Assignment{{"matrix", "row", 1}, ArrayPlace{12, true, -1}, {product({{Number{3e9}}})}},
      Assignment{{"", "dr", {}}, ArrayPlace{{}, false, 0}, {product({{Number{0}}})}, true}};
  CHECK(cpp(others) ==
        "const FromOne<D> d_mass(along.p + 12);\nconst T gravity = at.p[25];\n"
        "{\n  const D y = -gravity;\n}\n"
        "matrix.row[1][12 + i - 1] = T(3.00000000000000000e+09);\ndr[0] = D(T(0));\n");
  CHECK(c(others) ==
        "const double* const d_mass = along->p + 12;\nconst double gravity = at->p[25];\n"
        "{\n  const double y = -gravity;\n}\n"
        "matrix->row[1][12 + i - 1] = 3.00000000000000000e+09;\ndr[0] = 0.0;\n");
}

TEST_CASE("aligned arrays of C++ begin a register with entry 1") {
  const Statements array{Variable{Type::kScalar, "x", 13, true}};
  CHECK(statements_text(array, Language::kCpp, 0, Arrays::kAligned) ==
        "LinkArray<T, 13> x = {};\n");
  CHECK(statements_text(array, Language::kC, 0, Arrays::kAligned) == "double x[13] = {};\n");
  const LinkArray<double, 13> numbers = {};
  CHECK(reinterpret_cast<std::uintptr_t>(&numbers[1]) % 64 == 0);
  CHECK(&numbers[12] - &numbers[0] == 12);
}

// a_i = x_i^2 is an entry of the matrix at every link, and read at the next one; the last link has a load.
TEST_CASE(
    "a loop goes to the last link, whose load follows, and what a matrix holds is stored once") {
  constexpr int kLinks = 6;
  Definitions definitions;
  const GiNaC::ex load = definitions.input("load");
  std::vector<GiNaC::ex> a{0};
  std::vector<Output> outputs;
  const auto output = [&](const std::string& name, int link, const GiNaC::ex& value) {
    outputs.push_back({{"matrix", name, 0}, link, ArrayPlace{{}, true, -1}, value});
  };
  for (int i = 1; i <= kLinks; ++i) {
    const GiNaC::ex x = definitions.input("x", i);
    a.push_back(definitions.define("a", i, x * x));
    output("column", i, a.back());
  }
  const GiNaC::ex loaded = definitions.define("loaded", kLinks, load * a[kLinks] + load);
  for (int i = 2; i <= kLinks; ++i) output("row", i, a[i - 1] * (i == kLinks ? loaded : a[i]));
  const Inputs inputs{{"load", Input{InputKind::kEntry, Type::kScalar, "load", {"at", "p", {}}, 0}},
                      {"x", Input{InputKind::kArray, Type::kScalar, "x", {"at", "q", {}}, 0}}};
  CHECK(cpp(function_body(definitions, outputs, inputs, Layout::kLoops)) ==
        "const T load = at.p[0];\nconst FromOne<T> x(at.q);\n"
        "for (int i = 1; i <= 6; ++i) {\n  const T a = x[i] * x[i];\n"
        "  matrix.column[0][i - 1] = a;\n}\n"
        "const FromOne<T> a(matrix.column[0]);\n"
        "T loaded[7];\nloaded[6] = load * (T(1) + a[6]);\n"
        "for (int i = 2; i <= 5; ++i) {\n  matrix.row[0][i - 1] = a[i - 1] * a[i];\n}\n"
        "matrix.row[0][5] = a[5] * loaded[6];\n");
}

TEST_CASE("operations are counted, those of a loop for every step") {
  const OperationCount count = operations_of(sweep(12));
  CHECK(count.additions == Affine(1 + 10));
  CHECK(count.multiplications == Affine(2));
  CHECK(count.divisions == Affine(1));
  CHECK(count.functions == Affine(10));
  const Statements any = for_any_links(sweep(12), sweep(13), 12);
  CHECK(operations_of(any).additions == Affine(-1, 1));
  CHECK(affine_text(operations_of(any).functions) == "links - 2");
  CHECK_THROWS_AS(operations_of({Loop{1, Affine(0, 1), 1, any}}), std::logic_error);
}

TEST_CASE("statements for any number of links") {
  const Statements any = for_any_links(sweep(12), sweep(13), 12);
  CHECK(cpp(any) ==
        "T x[links + 1];\nx[2] = a * (b - ratio<T>(1, 2)) / (c * d[2 * links]);\n"
        "for (int i = 3; i <= links; ++i) {\n  x[i] = sin(x[i - 1]) + x[i];\n}\n");
  for (const long links : {5, 12, 240}) CHECK(at_links(any, links) == sweep(links));
  const auto sines = [](long links) {
    return Statements{
        Input{InputKind::kSinesAndCosines, Type::kScalar, "sine", {"at", "q", {}}, links}};
  };
  CHECK(cpp(sines(12)) ==
        "T sine[13], cosine[13];\nsines_and_cosines<12>(at.q, sine + 1, cosine + 1);\n");
  CHECK(cpp(for_any_links(sines(12), sines(13), 12)) ==
        "T sine[links + 1], cosine[links + 1];\n"
        "sines_and_cosines(links, at.q, sine + 1, cosine + 1);\n");
}

TEST_CASE("statements that differ in more than integers are refused") {
  const auto refused = [](const Statements& a, const Statements& b) {
    CHECK_THROWS_AS(for_any_links(a, b, 12), std::logic_error);
    CHECK_THROWS_AS(for_any_links(b, a, 12), std::logic_error);
  };
  refused(sweep(12), {});
  Statements other = sweep(13);
  other.push_back(other.front());
  refused(sweep(12), other);
  other = sweep(13);
  std::get<Loop>(other[2]).step = -1;
  refused(sweep(12), other);
  other = sweep(13);
  std::get<Variable>(other[0]).name = "y";
  refused(sweep(12), other);
  other = sweep(13);
  std::get<Assignment>(other[1]).value[0].negative = true;
  refused(sweep(12), other);
  // a number in an equation is no integer of the program
  const auto value = [](double number) {
    return Statements{NamedValue{Type::kScalar, "x", {product({{Number{number}}})}}};
  };
  refused(value(12), value(13));
}

TEST_CASE("loops written out") {
  const auto at = [](long place) { return ArrayPlace{24, false, place}; };
  const auto of_step = [&](ArrayPlace place, ArrayPlace before) {
    return Statements{
        NamedValue{Type::kScalar, "y", {product({{Read{"x", before}}})}},
        Assignment{{"", "p", {}}, place, {product({read("y"), {Read{"x", place}}})}, false}};
  };
  const Statements body = of_step({24, true, 0}, {24, true, -1});
  Statements two = of_step(at(2), at(1));
  for (const Statement& one : of_step(at(3), at(2))) two.push_back(one);
  CHECK(written_out({Loop{2, 3, 1, body}}) == two);
  CHECK(written_out({Block{of_step(at(2), at(1))}, Loop{3, 3, -1, body}}) == two);
  CHECK(written_out({Loop{3, 2, -1, body}}) != two);
  CHECK(written_out({Loop{4, 3, 1, body}}).empty());
}

TEST_CASE("the plain chain has a program for any number of links") {
  const auto files = emit_any_links(plain_chain());
  REQUIRE(files.size() == 2);
  const std::string& header = files.at("chain_any.hpp");
  CHECK(header.find("sines_and_cosines(links, at.q, sine + 1, cosine + 1);") != std::string::npos);
  CHECK(header.find("const T gravity = at.p[6 * links + 1];") != std::string::npos);
  for (const char* number : {"12]", "13]", "14]", "<= 12", "at.p + 12", "at.p[72]"})
    CHECK(header.find(number) == std::string::npos);
}

TEST_CASE("coordinates that an effect adds stand in loops too") {
  Description description = plain_chain();
  description.id = "stretch";
  description.effects.push_back(built_in_effect("axial_stretch"));
  CHECK(emit_any_links(description).contains("stretch_any.hpp"));
}

TEST_CASE("what changes the equations with the number of links is named") {
  Description description = plain_chain();
  description.space = Space::kThreeDimensional;
  CHECK_THROWS_WITH_AS(emit_any_links(description), doctest::Contains("because of space = \"3d\""),
                       InputError);
}
