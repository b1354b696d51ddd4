// SPDX-License-Identifier: GPL-3.0-or-later
//
// Emitted models in doubles against the same text in fifty digits, from the same inputs: the worst
// error of each function in units of rounding, 2^-53 of the largest entry of its result. Measured:
// at most 6 for chains of 12 and 60 links, 15 for short ones (two angles that happen to be close
// make the centrifugal term small beside the products it is the difference of), 190 with every
// effect at once.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "tests/generated/emitted_model.hpp"

using namespace catena::tests;

namespace {

constexpr double kRounding = 0x1p-53;

// Four times what was measured: a prefix sum taken in a worse order shows.
constexpr double kMostOfChain = 60;
// A harmonically moved support takes the sine of 2 pi f t, up to 40 rad here: its rounding counts
// 40 times, and again for the rate and the acceleration.
constexpr double kMostWithEffects = 800;

/// Largest error over largest entry, in units of rounding; 0 where all is 0.
double worst_error(const std::vector<double>& values, const std::vector<FiftyDigits>& exact) {
  REQUIRE(values.size() == exact.size());
  double error = 0, scale = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    error = std::max(error, double(abs(FiftyDigits(values[i]) - exact[i])));
    scale = std::max(scale, double(abs(exact[i])));
  }
  return error == 0 ? 0 : error / scale / kRounding;
}

int states_for(const catena_model& model) { return model.links > 12 ? 4 : 40; }

}  // namespace

TEST_CASE("every function is accurate to a few units of rounding") {
  for (const EmittedModel& model : emitted_models()) {
    std::mt19937_64 random(50);
    std::map<std::string, double> worst;
    for (int state = 0; state < states_for(*model.table); ++state) {
      const Input<double> input = random_input(*model.table, random);
      const auto values = model.values(input);
      const auto exact = model.exact_values(converted<FiftyDigits>(input));
      for (std::size_t i = 0; i < values.size(); ++i) {
        double& entry = worst[values[i].first];
        entry = std::max(entry, worst_error(values[i].second, exact[i].second));
      }
      const Input<double> along = random_input(*model.table, random);
      const auto tangents = model.tangents(input, along);
      const auto exact_tangents =
          model.exact_tangents(converted<FiftyDigits>(input), converted<FiftyDigits>(along));
      for (std::size_t i = 0; i < tangents.size(); ++i) {
        double& entry = worst[tangents[i].first + " tangent"];
        entry = std::max(entry, worst_error(tangents[i].second, exact_tangents[i].second));
      }
    }
    std::string table;
    for (const auto& [function, units] : worst) {
      char line[128];
      std::snprintf(line, sizeof line, "%s %s: %.1f\n", model.table->id, function.c_str(), units);
      table += line;
      INFO(line);
      CHECK(units < (std::string(model.table->id).rfind("chain", 0) == 0 ? kMostOfChain
                                                                         : kMostWithEffects));
    }
    MESSAGE("worst errors in units of rounding\n" << table);
  }
}
