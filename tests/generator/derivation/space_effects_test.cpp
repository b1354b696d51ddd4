// SPDX-License-Identifier: GPL-3.0-or-later
//
// Effects in space, derived from their files: against the same files in the plane, and against themselves turned about
// the vertical.
#include <doctest/doctest.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "generator/certificate/exact_evaluation.hpp"
#include "generator/derivation/chain.hpp"
#include "tests/generator/derivation/space_point.hpp"

namespace catena::testing::space_point {

namespace {

// Those that hold in the plane and in space.
const std::vector<std::string> kEffects = {"added_mass",
                                           "air_drag_isotropic",
                                           "air_drag_linear",
                                           "air_drag_quadratic",
                                           "buoyancy",
                                           "centre_offset",
                                           "current",
                                           "current_series",
                                           "gravity_tilt",
                                           "joint_damping_quadratic",
                                           "joint_dry_friction",
                                           "joint_hysteresis",
                                           "joint_stiffness_cubic",
                                           "link_damping",
                                           "load_drag",
                                           "load_inertia",
                                           "load_mass",
                                           "pivot_damping",
                                           "pivot_dry_friction",
                                           "pivot_rest_angle",
                                           "pivot_stiffness",
                                           "rest_curvature",
                                           "sea_floor",
                                           "steady_wind",
                                           "support_motion",
                                           "support_series"};

// Powers and rates of energies, by item.
std::map<std::string, ex> powers(Chain& chain, ExactEvaluation& evaluation) {
  std::map<std::string, ex> sums;
  for (const EnergyItem& item : chain.energies()) {
    for (const ex& part : item.parts) {
      const bool stored = item.kind == EnergyItem::kStored;
      sums[item.name + (stored ? " stored" : "")] +=
          evaluation.of(stored ? chain.rate(part) : part);
    }
  }
  return sums;
}

// The state of the plane in the plane of side and down; what acts is along side too.
void compare_with_plane(const std::vector<std::string>& ids, unsigned seed) {
  Chain plane(with(ids, Space::kPlane), kLinks), space(with(ids, Space::kThreeDimensional), kLinks);
  Inputs inputs{seed};
  for (const char* none : {"current_across_speed", "current_series_current_across",
                           "current_series_current_across_shear"})
    inputs.set[none] = 0;
  std::vector<Vector> tangent(kLinks + 1);
  for (int i = 1; i <= kLinks; ++i) {
    const ex theta = draw(name("theta", i), seed), rate = draw(name("theta_dot", i), seed),
             acceleration = draw(name("theta_ddot", i), seed);
    const ex s = GiNaC::sin(theta), c = GiNaC::cos(theta);
    inputs.set[name("theta", i)] = theta;
    inputs.set[name("theta_dot", i)] = rate;
    inputs.set[name("theta_ddot", i)] = acceleration;
    inputs.set[name("torque", i)] = 0;
    // The joint turns towards side about the axis opposite to across.
    inputs.set[name("joint_hysteresis_slip", i)] = draw(name("slip", i), seed);
    set_slip(inputs, i, {0, 0, -draw(name("slip", i), seed)});
    set_vector(inputs, i, "", {s, c, 0});
    set_vector(inputs, i, "_dot", {c * rate, -s * rate, 0});
    set_vector(inputs, i, "_ddot",
               {c * acceleration - s * rate * rate, -s * acceleration - c * rate * rate, 0});
    tangent[static_cast<std::size_t>(i)] = {c.evalf(), numeric_of(-s), 0};
  }
  ExactEvaluation of_plane(plane.definitions(), inputs), of_space(space.definitions(), inputs);
  for (int i = 1; i <= kLinks; ++i) {
    CAPTURE(i);
    ex projected = 0;
    for (std::size_t k = 0; k < 3; ++k)
      projected += tangent[static_cast<std::size_t>(i)][k] * component(space, of_space, i, k);
    CHECK(difference(of_plane.of(plane.residual()[static_cast<std::size_t>(i) - 1]), projected) <
          kTolerance);
    CHECK(size(component(space, of_space, i, 2)) < kTolerance);
    const auto at = static_cast<std::size_t>(i) - 1;
    CHECK(difference(of_plane.of(plane.tensions()[at]), of_space.of(space.tensions()[at])) <
          kTolerance);
    CHECK(difference(GiNaC::abs(of_plane.of(plane.moments()[at])),
                     of_space.of(space.moments()[at])) < kTolerance);
  }
  auto expected = powers(plane, of_plane), found = powers(space, of_space);
  expected.erase("torque");
  CHECK(expected.size() == found.size());
  for (const auto& power : expected) {
    CAPTURE(power.first);
    CHECK(difference(power.second, found[power.first]) < kTolerance);
  }
}

// A state that is nowhere in a plane; vectors that are no unit vectors and change their lengths.
void set_askew(Inputs& inputs, int i, const char* dots, const numeric& cosine,
               const numeric& sine) {
  const auto of = [&](int k) { return draw(name(kAxes[k] + std::string(dots), i), inputs.seed); };
  const ex down = std::string(dots).empty() ? 1 + of(1) / 4 : of(1);
  set_vector(inputs, i, dots, {cosine * of(0) - sine * of(2), down, sine * of(0) + cosine * of(2)});
}

Inputs turned(unsigned seed, const numeric& cosine, const numeric& sine) {
  Inputs inputs{seed};
  for (int i = 1; i <= kLinks; ++i) {
    for (const char* dots : {"", "_dot", "_ddot"}) set_askew(inputs, i, dots, cosine, sine);
    const auto slip = [&](int k) { return draw(name(kAxes[k] + std::string("_slip"), i), seed); };
    set_slip(inputs, i,
             {cosine * slip(0) - sine * slip(2), slip(1), sine * slip(0) + cosine * slip(2)});
  }
  // what flows
  for (const auto& [side, across] :
       {std::pair{"current_side_speed", "current_across_speed"},
        {"current_series_current_side", "current_series_current_across"},
        {"current_series_current_side_shear", "current_series_current_across_shear"}}) {
    const ex s = draw(side, seed), a = draw(across, seed);
    inputs.set[side] = cosine * s - sine * a;
    inputs.set[across] = sine * s + cosine * a;
  }
  return inputs;
}

}  // namespace

TEST_CASE("in a vertical plane an effect in space is the effect of the plane") {
  GiNaC::Digits = kDigits;
  for (const std::string& id : kEffects) {
    CAPTURE(id);
    for (const unsigned seed : {1u, 2u}) compare_with_plane({id}, seed);
  }
  compare_with_plane({"added_mass", "air_drag_quadratic", "buoyancy", "current", "centre_offset",
                      "joint_dry_friction", "link_damping", "load_inertia", "load_drag"},
                     3);
}

TEST_CASE("every built-in effect that space does not refuse is compared with the plane") {
  for (const std::string& id : built_in_effect_ids()) {
    CAPTURE(id);
    const Effect effect = built_in_effect(id);
    if (effect.space == "3d" || effect.sensor.given()) continue;  // of no plane; below
    const bool taken = conflict_in(with({id}, Space::kThreeDimensional)).empty();
    CHECK(taken == (std::find(kEffects.begin(), kEffects.end(), id) != kEffects.end()));
  }
}

TEST_CASE("sensors in space report what they say, and the truth at their neutral values") {
  GiNaC::Digits = kDigits;
  const Vector at = {numeric(3, 10), numeric(7, 10), numeric(-4, 10)};
  const auto p = [](const std::string& id, const std::string& parameter) {
    return value_of(id + "_" + parameter, 4);
  };
  // Turned in the plane of two axes, from the first towards the second.
  const auto turned = [](Vector v, std::size_t from, std::size_t to, const ex& angle) {
    const ex first = v[from], second = v[to];
    v[from] = first * GiNaC::cos(angle) - second * GiNaC::sin(angle);
    v[to] = second * GiNaC::cos(angle) + first * GiNaC::sin(angle);
    return v;
  };
  const ex factor = p("scale", "factor");
  const std::map<std::string, Vector> expected = {
      {"clock_offset", at},
      {"frame_offset",
       {at[0] + p("frame_offset", "side_shift"), at[1] + p("frame_offset", "down_shift"),
        at[2] + p("frame_offset", "across_shift")}},
      {"frame_tilt", turned(turned(at, 1, 0, p("frame_tilt", "side_tilt")), 1, 2,
                            p("frame_tilt", "across_tilt"))},
      {"frame_turn", turned(at, 0, 2, p("frame_turn", "turn"))},
      {"scale", {factor * at[0], factor * at[1], factor * at[2]}}};
  for (const std::string& id : built_in_effect_ids()) {
    const Effect effect = built_in_effect(id);
    if (!effect.sensor.given()) continue;
    CAPTURE(id);
    const bool taken = conflict_in(with({id}, Space::kThreeDimensional)).empty();
    REQUIRE(taken == expected.contains(id));
    if (!taken) continue;
    Chain chain(with({id}, Space::kThreeDimensional), kLinks);
    REQUIRE(chain.sensor().given);
    for (const bool at_neutral : {false, true}) {
      Inputs inputs{4};
      for (std::size_t k = 0; k < 3; ++k) inputs.set[kAxes[k]] = at[k];
      if (at_neutral)
        for (const EffectParameter& parameter : effect.parameters)
          inputs.set[id + "_" + parameter.name] = numeric(parameter.neutral);
      ExactEvaluation derived(chain.definitions(), inputs);
      for (std::size_t k = 0; k < 3; ++k)
        CHECK(difference(at_neutral ? at[k] : expected.at(id)[k],
                         derived.of(chain.sensor().reported[k])) < kTolerance);
      const ex delay = at_neutral || id != "clock_offset" ? ex(0) : p(id, "offset");
      CHECK(difference(inputs("time") + delay, derived.of(chain.sensor().clock)) < kTolerance);
    }
  }
  const std::string why = why_not_in(Space::kThreeDimensional, built_in_effect("camera_tilt"));
  CAPTURE(why);
  CHECK(why.find("sensor.side: it says nothing of what is across") != std::string::npos);
}

TEST_CASE("effects in space do not see a turn about the vertical, and their powers balance") {
  GiNaC::Digits = kDigits;
  const numeric cosine(-33, 65), sine(56, 65);
  for (const std::string& id : kEffects) {
    CAPTURE(id);
    Chain chain(with({id}, Space::kThreeDimensional), kLinks);
    const bool has_direction = id == "steady_wind" || id == "gravity_tilt" ||
                               id == "support_motion" || id == "support_series" ||
                               id == "rest_curvature" || id == "pivot_rest_angle";
    ExactEvaluation here(chain.definitions(), turned(4, 1, 0)),
        there(chain.definitions(), turned(4, cosine, sine));
    CHECK(imbalance(chain, here) < kTolerance);
    CHECK(imbalance(chain, there) < kTolerance);
    if (has_direction) continue;
    for (int i = 1; i <= kLinks; ++i) {
      CAPTURE(i);
      const ex side = component(chain, here, i, 0), across = component(chain, here, i, 2);
      CHECK(difference(cosine * side - sine * across, component(chain, there, i, 0)) < kTolerance);
      CHECK(difference(component(chain, here, i, 1), component(chain, there, i, 1)) < kTolerance);
      CHECK(difference(sine * side + cosine * across, component(chain, there, i, 2)) < kTolerance);
    }
    const auto before = powers(chain, here);
    for (const auto& power : powers(chain, there)) {
      CAPTURE(power.first);
      CHECK(difference(before.at(power.first), power.second) < kTolerance);
    }
  }
}

}  // namespace catena::testing::space_point
