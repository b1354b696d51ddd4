// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/model.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "common/input_error.hpp"
#include "tests/runtime/reference_model.hpp"
#include "tests/support/data.hpp"

namespace {

using catena::InputError;
using catena::Model;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST_CASE("built-in models are found by their number of links") {
  CHECK(Model::has_built_in(12));
  CHECK_FALSE(Model::has_built_in(7));
  const Model model = Model::built_in(12);
  CHECK(model.links() == 12);
  CHECK(model.coordinates() == 12);
  CHECK(model.parameters() == 74);
  const std::string message = message_of([] { Model::built_in(7); });
  CHECK(message.find("no model of 7 links") != std::string::npos);
  CHECK(message.find("2, 3, 4, 12, 60") != std::string::npos);
}

TEST_CASE("parameters are found by name, and the nearest name is offered") {
  const Model model(catena::testing::reference_model<3>());
  CHECK(model.parameter_index("length_1") == 0);
  CHECK(model.parameter_index("stiffness_2") == 10);
  CHECK(model.parameter_index("load_mass") == 18);
  CHECK(message_of([&] { model.parameter_index("stifness_2"); }).find("stiffness_2") !=
        std::string::npos);
}

TEST_CASE("defaults are there where the table has them") {
  const Model model(catena::testing::reference_model<3>());
  const Eigen::VectorXd p = model.default_parameters();
  CHECK(p[model.parameter_index("gravity")] == 9.81);
  CHECK(p[model.parameter_index("torque_3")] == 0.0);
  CHECK(std::isnan(p[model.parameter_index("length_3")]));
}

TEST_CASE("a compiled model is loaded, and outlives the object that loaded it") {
  std::optional<Model> copy;
  {
    const Model loaded = Model::load(LOADABLE_GOOD);
    copy = loaded;
  }
  CHECK(copy->links() == 3);
  CHECK(std::string(copy->table().parameter[0].name) == "length_1");
}

TEST_CASE("what cannot be loaded is named with the reason") {
  struct Row {
    std::filesystem::path file;
    const char* reason;
  };
  const Row rows[] = {
      {"no/such/file.so", "no such file"},
      {catena::tests::source_folder() / "CMakeLists.txt", "cannot be loaded"},
      {LOADABLE_WITHOUT_ENTRY, "does not export catena_model_table"},
      {LOADABLE_OTHER_ABI,
       "interface version 1, this program needs version 4; derive and compile it again"},
      {LOADABLE_SHORT, "its table has 64 bytes"},
      {LOADABLE_INCOMPLETE, "functions are missing"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.file);
    const std::string message = message_of([&] { Model::load(row.file); });
    CAPTURE(message);
    CHECK(message.find(row.file.string()) == 0);
    CHECK(message.find(row.reason) != std::string::npos);
  }
  CHECK(message_of([] { Model{nullptr}; }).find("no model table") != std::string::npos);
}

}  // namespace
