// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/parameter_map.hpp"

#include <doctest/doctest.h>

#include <array>
#include <limits>

#include "common/input_error.hpp"
#include "identify/cases/case_reader.hpp"
#include "tests/identify/differences.hpp"
#include "tests/runtime/reference_model.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace {

Case case_of(const std::string& cable, const std::string& parameters) {
  return parse_case("format = 1\nkind = \"case\"\n[model]\nlinks = 3\n[cable]\nload_mass = 0.5\n" +
                        cable + "\n" + parameters,
                    "case.toml", "");
}

const char* const kUniform = "length = 1.5\ndensity = 0.2";

std::string parameter(const std::string& name, const std::string& sets, const std::string& rest) {
  return "[[parameter]]\nname = \"" + name + "\"\nsets = \"" + sets + "\"\n" + rest + "\n";
}

const Model& model() {
  static const Model three(testing::reference_model<3>());
  return three;
}

}  // namespace

TEST_CASE("names, families, ranges, factors and physical quantities set what they say") {
  const Case the_case =
      case_of("link_lengths = [0.5, 0.4, 0.6]\ndensity = 0.2",
              parameter("EI", "bending_stiffness", "value = 0.9\nunit = \"N m^2\"") +
                  parameter("c1", "damping_1", "value = 0.01\nunit = \"N m s/rad\"") +
                  parameter("c", "damping_2..3", "value = 3.0\nfactor = 0.002") +
                  parameter("T", "torque", "value = 0.25"));
  const ParameterMap map(the_case, model());
  const Eigen::VectorXd p = map(case_values(the_case));
  const auto value = [&](const char* name) { return p[model().parameter_index(name)]; };
  struct Row {
    const char* name;
    double expected;
  };
  const Row rows[] = {
      {"length_2", 0.4},           {"mass_3", 0.12},    {"inertia_3", 0.12 * 0.36 / 12},
      {"stiffness_1", 0.9 / 0.25},  // from the clamp to the middle of link 1
      {"stiffness_2", 0.9 / 0.45},  // between the middles of links 1 and 2
      {"stiffness_3", 0.9 / 0.5},  {"damping_1", 0.01}, {"damping_3", 0.006},
      {"torque_2", 0.25},          {"load_mass", 0.5},  {"gravity", 9.81}};
  for (const Row& row : rows) {
    CAPTURE(row.name);
    CHECK(value(row.name) == catena::near(row.expected, 1e-14));
  }
}

TEST_CASE("a cable on a hinge bends from joint 2 on") {
  const Case the_case = case_of(kUniform, parameter("EI", "bending_stiffness_2..3", "value = 0.9") +
                                              parameter("k1", "stiffness_1", "value = 0.0") +
                                              parameter("b", "damping_length", "value = 0.02"));
  const ParameterMap map(the_case, model());
  const Eigen::VectorXd p = map(case_values(the_case));
  CHECK(p[model().parameter_index("stiffness_1")] == 0);
  CHECK(p[model().parameter_index("stiffness_2")] == doctest::Approx(0.9 / 0.5));
  CHECK(p[model().parameter_index("damping_1")] == doctest::Approx(0.02 / 0.25));
}

TEST_CASE("a parameter of the case may have the values that the model admits") {
  const double infinity = std::numeric_limits<double>::infinity();
  const Case the_case =
      case_of(kUniform, parameter("EI", "bending_stiffness", "value = 0.9") +
                            parameter("c", "damping", "value = -3.0\nfactor = -0.1") +
                            parameter("T", "torque_2..3", "value = 0.25") +
                            parameter("L", "cable.length", "value = -1.4\nfactor = -1") +
                            parameter("rho", "cable.density", "value = 0.3"));
  const ParameterMap map(the_case, model());
  const std::array<std::array<double, 2>, 5> expected = {
      {{0, infinity}, {-infinity, 0}, {-infinity, infinity}, {-infinity, 0}, {0, infinity}}};
  for (std::size_t j = 0; j < expected.size(); ++j) {
    CAPTURE(the_case.parameters[j].name);
    CHECK(map.admitted(j).lower == expected[j][0]);
    CHECK(map.admitted(j).upper == expected[j][1]);
  }
}

TEST_CASE("bounds over a factor are within the model's after rounding, too") {
  catena_model table = model().table();
  std::vector<catena_parameter> entries(table.parameter, table.parameter + table.parameters);
  catena_parameter& bounded =
      entries[static_cast<std::size_t>(model().parameter_index("torque_1"))];
  bounded.lower = -0.1;
  bounded.upper = 0.7;
  table.parameter = entries.data();
  const Model with(&table);
  const std::string others =
      parameter("k", "stiffness", "value = 1.0") + parameter("c", "damping", "value = 1.0");
  for (const double factor : {0.3, -0.3, 7.0, -49.0, 1e-3, 1.0}) {
    CAPTURE(factor);
    const Case the_case = case_of(
        kUniform,
        parameter("T", "torque_1", "value = 0\nfactor = " + std::to_string(factor)) + others);
    const ParameterMap::Range range = ParameterMap(the_case, with).admitted(0);
    const double at_lower = factor * (factor > 0 ? range.lower : range.upper);
    const double at_upper = factor * (factor > 0 ? range.upper : range.lower);
    CHECK(at_lower >= -0.1);
    CHECK(at_upper <= 0.7);
    CHECK(at_lower == catena::near(-0.1, 1e-15));
    CHECK(at_upper == catena::near(0.7, 1e-15));
  }
}

TEST_CASE("the Jacobian is the derivative of the map") {
  const Case the_case = case_of(kUniform, parameter("EI", "bending_stiffness", "value = 0.9") +
                                              parameter("b", "damping_length", "value = 0.02") +
                                              parameter("L", "cable.length", "value = 1.4") +
                                              parameter("rho", "cable.density", "value = 0.3"));
  const ParameterMap map(the_case, model());
  const Eigen::VectorXd values = case_values(the_case);
  const Eigen::MatrixXd jacobian = map.jacobian(values);
  for (Eigen::Index j = 0; j < values.size(); ++j) {
    const double h = 1e-6 * values[j];  // central differences: h^2 times the third derivative
    const Eigen::VectorXd difference = testing::central_difference(map, values, j, h);
    CHECK((difference - jacobian.col(j)).cwiseAbs().maxCoeff() <
          1e-8 * jacobian.col(j).cwiseAbs().maxCoeff());
  }
  CHECK(map(values)[model().parameter_index("length_1")] == doctest::Approx(1.4 / 3));
}

TEST_CASE("what cannot be set is named") {
  const std::string k = parameter("k", "stiffness", "value = 1.0");
  const std::string c = parameter("c", "damping", "value = 1.0");
  struct Row {
    std::string parameters;
    const char* expected;
  };
  const Row rows[] = {
      {k, "the model's damping_1 (N m s/rad) has no value"},
      {k + c + parameter("k1", "stiffness_1", "value = 1.0"), "stiffness_1, which parameter \"k\""},
      {c + parameter("k", "stifness", "value = 1.0"), "did you mean \"stiffness\"?"},
      {c + parameter("k", "stiffness_1..4", "value = 1.0"), "within 1..3"},
      {c + parameter("k", "stiffness_4", "value = 1.0"), "no such parameter"},
      {c + parameter("k", "stiffness", "value = 1.0\nunit = \"N/m\""), "stiffness is in N m/rad"},
      {c + parameter("k", "stiffness", "value = 1.0\nunit = \"furlong\""), "furlong"},
      {c + parameter("k", "stiffness", "value = -1.0"), "must lie within 0 and inf"},
      {k + parameter("c", "damping", "value = 0.0\nfree = true\nupper = 0.0"),
       "upper = 0: a free parameter needs room, and damping admits only 0 of that"},
      {k + c + parameter("L", "cable.length", "value = -1.0"), "must be positive"},
      {k + c + parameter("L", "cable.length", "value = 1.0") +
           parameter("L2", "cable.length", "value = 1.0"),
       "set twice"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.parameters);
    std::string message;
    try {
      const Case the_case = case_of(kUniform, row.parameters);
      ParameterMap(the_case, model()).check_values(the_case, model());
    } catch (const InputError& error) {
      message = error.what();
    }
    CHECK_MESSAGE(message.find(row.expected) != std::string::npos, message, " lacks ",
                  std::string(row.expected));
    CHECK(message.starts_with("case.toml"));
  }
}
