// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every built-in effect as the generator derives it from its file, against the separate naive
// derivation of naive_chain.hpp, at seeded random points in 50-digit arithmetic.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "generator/certificate/exact_evaluation.hpp"
#include "generator/derivation/chain.hpp"
#include "tests/generator/derivation/naive_chain.hpp"
#include "tests/support/near.hpp"

using namespace catena;
using GiNaC::ex;
using GiNaC::numeric;

namespace {

constexpr int kLinks = 3;
constexpr int kDigits = 50;
// Evaluation in 50 digits loses a few to cancellation; a wrong term would be of order one.
constexpr double kTolerance = 1e-40;

// A number for every name, the same each time. Angles, rates and what data give have both signs;
// all else is positive.
ex random_value(const std::string& name, unsigned seed) {
  std::seed_seq sequence(name.begin(), name.end());
  std::mt19937 generator(sequence);
  generator.discard(seed);
  const int draw = static_cast<int>(generator() % 1801) - 900;
  for (const char* family :
       {"theta", "swinging_load_swing", "support_series_support", "joint_hysteresis_slip",
        "steady_wind_wind", "torque", "support_motion_side_phase"}) {
    if (name.starts_with(family)) return numeric(2 * draw + 1, 1000);
  }
  if (name.starts_with("axial_stretch_strain")) return numeric(draw, 5000);
  return numeric(draw + 1100, 1000);
}

using Evaluation = ExactEvaluation;

ex sum(Evaluation& evaluation, const std::vector<ex>& parts) {
  ex total = 0;
  for (const ex& part : parts) total += evaluation.of(part);
  return total;
}

double difference(const ex& a, const ex& b) {
  const ex size = GiNaC::abs(a).evalf() + 1;
  const ex relative = (GiNaC::abs(a - b) / size).evalf();
  REQUIRE(GiNaC::is_a<numeric>(relative));
  return GiNaC::ex_to<numeric>(relative).to_double();
}

Description with(const std::vector<std::string>& effects) {
  Description description = plain_chain();
  for (const std::string& id : effects) description.effects.push_back(built_in_effect(id));
  return description;
}

bool is_sensor_alone(const Effect& effect) {
  return effect.sensor.given() && effect.forces.empty() && effect.scalars.empty();
}

std::vector<std::string> physical_effects() {
  std::vector<std::string> ids;
  for (const std::string& id : built_in_effect_ids()) {
    const Effect effect = built_in_effect(id);
    if (!is_sensor_alone(effect) && why_not_in(Space::kPlane, effect).empty()) ids.push_back(id);
  }
  return ids;
}

// The naive derivation at the point of random_value, the support's motion put in.
class NaivePoint {
 public:
  NaivePoint(NaiveChain& chain, unsigned seed) {
    for (const auto& [symbol, value] : chain.support_motion()) motion_[symbol] = value;
    for (const auto& [name, symbol] : chain.symbols()) {
      if (!motion_.contains(symbol)) values_[symbol] = random_value(name, seed);
    }
    for (auto& [symbol, value] : motion_) values_[symbol] = value.subs(values_).evalf();
  }

  ex of(const ex& expression) const {
    return expression.subs(values_, GiNaC::subs_options::no_pattern).evalf();
  }

 private:
  std::map<ex, ex, GiNaC::ex_is_less> motion_;
  GiNaC::exmap values_;
};

void compare(const std::vector<std::string>& ids, unsigned seed) {
  NaiveChain naive(kLinks, {ids.begin(), ids.end()});
  const std::vector<ex> residual = naive.residual(), state_rates = naive.state_rates();
  const ex stored_rate = naive.stored_rate(), power = naive.power() + naive.support_power();
  const NaivePoint point(naive, seed);

  Chain chain(with(ids), kLinks);
  ex stored = 0;
  for (const EnergyItem& item : chain.energies()) {
    for (const ex& part : item.parts) {
      if (item.kind == EnergyItem::kStored) stored += part;
    }
  }
  const ex derived_stored_rate = chain.rate(stored);
  Evaluation derived(chain.definitions(),
                     [&](const std::string& name) { return random_value(name, seed); });

  REQUIRE(chain.residual().size() == residual.size());
  for (std::size_t i = 0; i < residual.size(); ++i) {
    CAPTURE(i);
    CHECK(difference(point.of(residual[i]), derived.of(chain.residual()[i])) < kTolerance);
  }
  REQUIRE(chain.state_rates().size() == state_rates.size());
  for (std::size_t i = 0; i < state_rates.size(); ++i) {
    CAPTURE(i);
    CHECK(difference(point.of(state_rates[i]), derived.of(chain.state_rates()[i])) < kTolerance);
  }
  REQUIRE(chain.position(catena::kSide).size() == naive.side.size());
  for (std::size_t i = 0; i < naive.side.size(); ++i) {
    CAPTURE(i);
    CHECK(difference(point.of(naive.side[i]), derived.of(chain.position(catena::kSide)[i])) <
          kTolerance);
    CHECK(difference(point.of(naive.down[i]), derived.of(chain.position(catena::kDown)[i])) <
          kTolerance);
  }
  // Energies: what is stored, and what comes in and goes out
  CHECK(difference(point.of(stored_rate), derived.of(derived_stored_rate)) < kTolerance);
  ex derived_power = 0;
  for (const EnergyItem& item : chain.energies()) {
    if (item.kind == EnergyItem::kSupplied) derived_power += sum(derived, item.parts);
    if (item.kind == EnergyItem::kDissipated) derived_power -= sum(derived, item.parts);
  }
  CHECK(difference(point.of(power), derived_power) < kTolerance);
  // and their balance: dE/dt = power + sum v r, whatever the accelerations
  ex work = 0;
  for (std::size_t i = 0; i < chain.residual().size(); ++i) {
    work += derived.of(chain.rates()[i]) * derived.of(chain.residual()[i]);
  }
  CHECK(difference(derived.of(derived_stored_rate), derived_power + work) < kTolerance);
}

}  // namespace

TEST_CASE("each effect alone agrees with its naive derivation, its energies balance") {
  GiNaC::Digits = kDigits;
  for (const std::string& id : physical_effects()) {
    CAPTURE(id);
    REQUIRE(NaiveChain::knows(id));
    for (const unsigned seed : {1u, 2u}) compare({id}, seed);
  }
}

TEST_CASE("all effects at once agree with their naive derivation") {
  GiNaC::Digits = kDigits;
  compare(physical_effects(), 3);
}

TEST_CASE("at the neutral values the equations are those of the plain chain") {
  GiNaC::Digits = kDigits;
  Chain plain(plain_chain(), kLinks);
  Evaluation expected(plain.definitions(),
                      [](const std::string& name) { return random_value(name, 4); });
  for (const std::string& id : physical_effects()) {
    CAPTURE(id);
    const Effect effect = built_in_effect(id);
    std::map<std::string, ex> neutral;
    bool reached = true;
    for (const EffectParameter& parameter : effect.parameters) {
      if (std::isinf(parameter.neutral)) reached = false;
      if (std::isfinite(parameter.neutral)) {
        neutral[id + "_" + parameter.name] = numeric(parameter.neutral);
      }
    }
    Chain chain(with({id}), kLinks);
    Evaluation derived(chain.definitions(), [&](const std::string& name) {
      const auto found = neutral.find(name);
      if (found != neutral.end()) return found->second;
      // Where the effect vanishes only in a limit, its own coordinates are held at zero.
      if (!reached && name.starts_with(id + "_strain")) return ex(0);
      return random_value(name, 4);
    });
    for (std::size_t i = 0; i < kLinks; ++i) {
      CAPTURE(i);
      CHECK(difference(expected.of(plain.residual()[i]), derived.of(chain.residual()[i])) <
            kTolerance);
    }
  }
}

TEST_CASE("sensor effects report what they say, and the truth at their neutral values") {
  GiNaC::Digits = kDigits;
  const ex side = numeric(3, 10), down = numeric(7, 10), angle = numeric(4, 10), time = 2;
  const auto p = [](const std::string& name) { return random_value(name, 5); };
  struct Reported {
    ex side, down, angle, time;
  };
  const auto lens = [&](const std::string& name) { return p("camera_lens_" + name); };
  const ex seen_larger = (1 + lens("radial") * (side * side + down * down)) /
                         (1 + lens("side_perspective") * side + lens("down_perspective") * down);
  const auto encoder = [&](const std::string& name) { return p("encoder_error_" + name); };
  const std::map<std::string, Reported> expected = {
      {"camera_lens", {side * seen_larger, down * seen_larger * (1 + lens("aspect")), angle, time}},
      // a sine and a cosine of twice the angle by those of the angle
      {"encoder_error",
       {side, down,
        angle + encoder("offset") + encoder("sine") * GiNaC::sin(angle) +
            encoder("cosine") * GiNaC::cos(angle) +
            2 * encoder("second_sine") * GiNaC::sin(angle) * GiNaC::cos(angle) +
            encoder("second_cosine") * (2 * GiNaC::pow(GiNaC::cos(angle), 2) - 1),
        time}},
      {"clock_offset", {side, down, angle, time + p("clock_offset_offset")}},
      {"scale", {side * p("scale_factor"), down * p("scale_factor"), angle, time}},
      // a point at distance r and angle phi from down is seen at phi + tilt
      {"camera_tilt",
       {GiNaC::sqrt(side * side + down * down) *
            GiNaC::sin(GiNaC::atan(side / down) + p("camera_tilt_tilt")),
        GiNaC::sqrt(side * side + down * down) *
            GiNaC::cos(GiNaC::atan(side / down) + p("camera_tilt_tilt")),
        angle + p("camera_tilt_tilt"), time}},
      {"marker_offset",
       {side + p("marker_offset_along") * GiNaC::sin(angle) +
            p("marker_offset_across") * GiNaC::sin(angle + GiNaC::Pi / 2),
        down + p("marker_offset_along") * GiNaC::cos(angle) +
            p("marker_offset_across") * GiNaC::cos(angle + GiNaC::Pi / 2),
        angle, time}},
      {"origin_offset",
       {side + p("origin_offset_side_shift"), down + p("origin_offset_down_shift"), angle, time}},
  };
  for (const std::string& id : built_in_effect_ids()) {
    const Effect effect = built_in_effect(id);
    if (!is_sensor_alone(effect) || effect.space == "3d") continue;
    CAPTURE(id);
    REQUIRE(expected.contains(id));
    Chain chain(with({id}), kLinks);
    REQUIRE(chain.sensor().given);
    for (const bool at_neutral : {false, true}) {
      Evaluation derived(chain.definitions(), [&](const std::string& name) -> ex {
        if (name == "side") return side;
        if (name == "down") return down;
        if (name == "angle") return angle;
        if (name == "time") return time;
        if (!at_neutral) return random_value(name, 5);
        for (const EffectParameter& parameter : effect.parameters) {
          if (name == id + "_" + parameter.name) return numeric(parameter.neutral);
        }
        return 0;
      });
      const Reported truth = at_neutral ? Reported{side, down, angle, time} : expected.at(id);
      const std::vector<ex>& reported = chain.sensor().reported;
      CHECK(difference(truth.side.evalf(), derived.of(reported[0])) < kTolerance);
      CHECK(difference(truth.down.evalf(), derived.of(reported[1])) < kTolerance);
      CHECK(difference(truth.angle.evalf(), derived.of(reported[2])) < kTolerance);
      CHECK(difference(truth.time.evalf(), derived.of(chain.sensor().clock)) < kTolerance);
    }
  }
}

// Equality cannot be had: at finite stiffness EA the links stretch by strain = tension/EA. With
// that strain, held, what is left of the equations of the stretch, and what the equations of the
// angles differ from the plain chain's, falls as 1/EA.
TEST_CASE("axial stretch converges to the plain chain as its stiffness grows") {
  GiNaC::Digits = kDigits;
  Chain plain(plain_chain(), kLinks);
  Evaluation expected(plain.definitions(),
                      [](const std::string& name) { return random_value(name, 6); });
  Chain chain(with({"axial_stretch"}), kLinks);
  std::map<std::string, ex> strain;  // "axial_stretch_strain[2]"; zero if not given
  const auto residual = [&](const ex& axial_stiffness) {
    Evaluation derived(chain.definitions(), [&](const std::string& name) -> ex {
      if (name == "axial_stretch_axial_stiffness") return axial_stiffness;
      if (name.starts_with("axial_stretch_strain")) return strain.contains(name) ? strain[name] : 0;
      return random_value(name, 6);
    });
    std::vector<ex> values;
    for (const ex& r : chain.residual()) values.push_back(derived.of(r));
    return values;
  };
  const auto remainder = [&](const ex& axial_stiffness) {
    strain.clear();
    const std::vector<ex> rigid =
        residual(axial_stiffness);  // in the strains' rows: -length tension
    for (int i = 1; i <= kLinks; ++i) {
      const std::string index = "[" + std::to_string(i) + "]";
      strain["axial_stretch_strain" + index] = -rigid[static_cast<std::size_t>(kLinks + i - 1)] /
                                               random_value("length" + index, 6) / axial_stiffness;
    }
    double largest = 0;
    const std::vector<ex> stretched = residual(axial_stiffness);
    for (std::size_t i = 0; i < stretched.size(); ++i) {
      const ex goal = i < kLinks ? expected.of(plain.residual()[i]) : ex(0);
      largest = std::max(largest, difference(goal, stretched[i]));
    }
    return largest;
  };
  const double soft = remainder(10000), stiff = remainder(1000000);
  CHECK(soft < 0.1);
  CHECK(soft / stiff == catena::near(100, 0.05));
}
