// SPDX-License-Identifier: GPL-3.0-or-later
//
// With neutral values every built-in effect leaves the plain chain, and the proof notices where
// not.
#include "generator/derivation/neutral_proof.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace catena;

namespace neutral_proof_test {
namespace {

constexpr int kLinks = 3;

Description with(const std::vector<Effect>& effects) {
  Description description = plain_chain();
  description.effects = effects;
  if (effects.size() == 1 && effects[0].space == "3d") description.space = Space::kThreeDimensional;
  return description;
}

bool all_equal(const NeutralProofs& result) {
  for (const Proof& proof : result.proofs) {
    CAPTURE(proof.difference);
    if (!proof.equal) return false;
  }
  return !result.proofs.empty();
}

}  // namespace

TEST_CASE("every built-in effect vanishes at its neutral values, all together too") {
  std::vector<Effect> all;
  for (const std::string& id : built_in_effect_ids()) {
    CAPTURE(id);
    const Effect effect = built_in_effect(id);
    const NeutralProofs result = prove_neutral(with({effect}), kLinks);
    if (id == "axial_stretch") {
      CHECK(result.why_not == "axial_stretch.axial_stiffness vanishes only in the limit");
      continue;
    }
    CHECK(result.why_not.empty());
    CHECK(all_equal(result));
    CHECK(result.proofs.size() == (effect.sensor.given() ? 4u : 3u));
    if (effect.space != "3d") all.push_back(effect);
  }
  CHECK(all_equal(prove_neutral(with(all), kLinks)));
  CHECK(prove_neutral(plain_chain(), kLinks).proofs.empty());
}

TEST_CASE("a wrong neutral value is found") {
  struct Row {
    std::string effect, parameter;
    double wrong;
  };
  for (const Row& row : {Row{"load_drag", "coefficient", 0.5},
                         {"scale", "factor", 1.5},
                         {"gravity_tilt", "tilt", 0.1},
                         {"joint_hysteresis", "moment", 1e-3},
                         {"support_motion", "side_amplitude", 0.25},
                         {"load_mass", "correction", 1},
                         {"swinging_load", "reach", 0.5},
                         {"swinging_load", "hinge_damping", 0.5},
                         {"load_body", "displaced", 0.5}}) {
    CAPTURE(row.effect);
    Effect effect = built_in_effect(row.effect);
    for (EffectParameter& parameter : effect.parameters) {
      if (parameter.name == row.parameter) parameter.neutral = row.wrong;
    }
    const NeutralProofs result = prove_neutral(with({effect}), kLinks);
    CHECK(std::any_of(result.proofs.begin(), result.proofs.end(),
                      [](const Proof& proof) { return !proof.equal; }));
  }
}

TEST_CASE("a moment on a load's own coordinate is found if it depends on the links") {
  struct Row {
    const char* moment;
    bool depends;
  };
  for (const Row& row : {Row{"about_centre*rate^2", true}, {"about_centre*swing_rate^2", false}}) {
    CAPTURE(row.moment);
    Effect effect = built_in_effect("swinging_load");
    ForceTerm force;
    force.at = Place::kLoad;
    force.along.text = "swing_rate";
    force.value.text = row.moment;
    effect.forces = {force};
    CHECK(all_equal(prove_neutral(with({effect}), kLinks)) == !row.depends);
  }
}

}  // namespace neutral_proof_test
