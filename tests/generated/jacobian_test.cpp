// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every derivative against central differences, column by column: time, angles, rates,
// accelerations, states, signals and every parameter. In fifty digits a step h = 1e-16 leaves
// errors of h^2 (the next derivative) and 1e-50 / h (rounding): 2e-30 at most was measured, far
// below anything wrong.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/generated/emitted_model.hpp"

using namespace catena::tests;

namespace {

/// What varies in one column, and its name.
struct Column {
  std::string name;
  Input<double> direction;
};

std::vector<Column> columns_of(const catena_model& model) {
  std::vector<Column> result;
  const auto add = [&](const std::string& name, auto member, int count) {
    for (int i = 0; i < count; ++i) {
      result.push_back({name + " " + std::to_string(i), zeros(model)});
      (result.back().direction.*member)[static_cast<std::size_t>(i)] = 1;
    }
  };
  result.push_back({"t", zeros(model)});
  result.back().direction.t = 1;
  add("q", &Input<double>::q, model.coordinates);
  add("v", &Input<double>::v, model.coordinates);
  add("a", &Input<double>::a, model.coordinates);
  add("z", &Input<double>::z, model.states);
  add("u", &Input<double>::u, 3 * model.signals);
  add("marker", &Input<double>::marker, 3);
  add("p", &Input<double>::p, model.parameters);
  return result;
}

Input<FiftyDigits> moved(Input<FiftyDigits> input, const Input<FiftyDigits>& along,
                         const FiftyDigits& step) {
  input.t += step * along.t;
  for (const auto member : {&Input<FiftyDigits>::q, &Input<FiftyDigits>::v, &Input<FiftyDigits>::a,
                            &Input<FiftyDigits>::z, &Input<FiftyDigits>::u, &Input<FiftyDigits>::p,
                            &Input<FiftyDigits>::marker})
    for (std::size_t i = 0; i < (input.*member).size(); ++i)
      (input.*member)[i] += step * (along.*member)[i];
  return input;
}

const std::vector<FiftyDigits>& named(const Outputs<FiftyDigits>& outputs,
                                      const std::string& name) {
  return std::find_if(outputs.begin(), outputs.end(),
                      [&](const auto& output) { return output.first == name; })
      ->second;
}

}  // namespace

TEST_CASE("every column of every Jacobian agrees with differences in fifty digits") {
  const FiftyDigits step(1e-16);
  for (const EmittedModel& model : emitted_models()) {
    const catena_model& table = *model.table;
    std::mt19937_64 random(16);
    double worst = 0;
    const int states = table.links > 12 ? 1 : 3;
    for (int state = 0; state < states; ++state) {
      const auto input = converted<FiftyDigits>(random_input(table, random));
      for (const Column& column : columns_of(table)) {
        const auto along = converted<FiftyDigits>(column.direction);
        const auto derivative = model.exact_tangents(input, along);
        const auto above = model.exact_values(moved(input, along, step));
        const auto below = model.exact_values(moved(input, along, FiftyDigits(0) - step));
        for (const auto& entry : derivative) {
          const auto& name = entry.first;
          const auto& values = entry.second;
          // Tangents of sensors are along parameters and marker, not along time.
          if (column.name == "t" && (name == "clock" || name == "observe")) continue;
          const auto& high = named(above, name);
          const auto& low = named(below, name);
          for (std::size_t i = 0; i < values.size(); ++i) {
            const FiftyDigits difference = (high[i] - low[i]) / (step + step);
            const double error =
                double(abs(difference - values[i])) / (1 + double(abs(difference)));
            worst = std::max(worst, error);
            INFO(table.id << " d" << name << "[" << i << "]/d" << column.name);
            CHECK(error < 1e-18);
          }
        }
      }
    }
    MESSAGE(std::string(table.id) << ": worst relative difference " << worst);
  }
}
