// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/wrong_knowns.hpp"

#include <doctest/doctest.h>

using namespace catena;

namespace {

/// What the effect's only parameter says at this estimate.
std::vector<std::string> said(const std::string& effect, const std::string& parameter, double value,
                              double standard_error, double load = 0.2) {
  const FinalParameter estimate = {effect + "." + parameter, "", effect, value, standard_error};
  return wrong_knowns(built_in_effect(effect), {estimate}, load);
}

}  // namespace

TEST_CASE("a wrong known is called what it is, in units of a person") {
  CHECK(said("load_mass", "correction", 0.0042, 0.0002) ==
        std::vector<std::string>{"the load is 2.1 % (1.9 to 2.3) heavier than the case says"});
  CHECK(said("load_mass", "correction", -0.0042, 0.0002) ==
        std::vector<std::string>{"the load is 2.1 % (1.9 to 2.3) lighter than the case says"});
  CHECK(said("load_mass", "correction", 0.0042, 0.0002, 0) ==
        std::vector<std::string>{
            "the load is 0.0042 kg (0.00381 to 0.00459) heavier than the case says"});
  CHECK(said("scale", "factor", 0.97, 0.005) ==
        std::vector<std::string>{"lengths in the recording are 3 % (2.02 to 3.98) too small"});
  CHECK(said("gravity_tilt", "tilt", 0.1, 0.01) ==
        std::vector<std::string>{
            "gravity is turned by 5.73 degrees (4.61 to 6.85) from down towards side"});
}

TEST_CASE("nothing is said of what may be neutral, of other effects and of physics") {
  CHECK(said("load_mass", "correction", 0.0042, 0.003).empty());
  const FinalParameter other = {"scale.factor", "1", "scale", 1.2, 0.01};
  CHECK(wrong_knowns(built_in_effect("load_mass"), {other}, 0.2).empty());
  CHECK(said("load_drag", "coefficient", 0.01, 0.001).empty());
}
