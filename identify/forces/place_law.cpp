// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/place_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

constexpr int kHighestPower = 3;  // of a position
/// Width of the sign's step, as a share of the largest velocity. A step is not linear in a state.
constexpr double kSignWidth = 0.05;
/// m/s, rad/s: |v| is sqrt(v^2 + floor^2) in effects, which has derivatives at rest.
constexpr double kSpeedFloor = 1e-6;

struct PairNames {
  ConjugatePair pair;
  const char *force, *variable, *force_unit, *variable_unit;
  const char* symbols;  ///< the variable in the language of effects
};
constexpr PairNames kPairNames[] = {
    {ConjugatePair::kSidePosition, "side force", "side position", "N", "m",
     "side + offset*sin(angle)"},
    {ConjugatePair::kDownPosition, "down force", "down position", "N", "m",
     "down + offset*cos(angle)"},
    {ConjugatePair::kSideVelocity, "side force", "side velocity", "N", "m/s",
     "velocity_side + offset*cos(angle)*rate"},
    {ConjugatePair::kDownVelocity, "down force", "down velocity", "N", "m/s",
     "velocity_down - offset*sin(angle)*rate"},
    {ConjugatePair::kNormalVelocity, "force normal to the cable", "normal velocity", "N", "m/s",
     "velocity_normal + offset*rate"},
    {ConjugatePair::kTangentialVelocity, "force along the cable", "tangential velocity", "N", "m/s",
     "velocity_tangential"},
    {ConjugatePair::kSpeed, "force along the velocity", "speed", "N", "m/s", nullptr},
    {ConjugatePair::kAngle, "torque at the support", "angle of link 1", "N m", "rad",
     "joint_angle"},
    {ConjugatePair::kAngularVelocity, "torque at the support", "rate of link 1", "N m", "rad/s",
     "joint_rate"},
};

const PairNames& names_of(ConjugatePair pair) {
  return *std::find_if(std::begin(kPairNames), std::end(kPairNames),
                       [&](const PairNames& names) { return names.pair == pair; });
}

/// Unit of a force by the power of a variable: "N/m^2", "N s^2/m^2".
std::string unit_by_power(const PairNames& names, int power) {
  if (power == 0) return names.force_unit;
  const std::string variable = names.variable_unit;
  const std::size_t slash = variable.find('/');
  const std::string exponent = power == 1 ? std::string() : fmt::format("^{}", power);
  return fmt::format("{}{}/{}{}", names.force_unit,
                     slash == std::string::npos ? std::string() : fmt::format(" s{}", exponent),
                     variable.substr(0, slash), exponent);
}

/// The square of the variable in the language of effects.
std::string squared_symbols(const PairNames& names) {
  if (names.pair != ConjugatePair::kSpeed) return fmt::format("({})^2", names.symbols);
  return fmt::format("({})^2 + ({})^2", names_of(ConjugatePair::kSideVelocity).symbols,
                     names_of(ConjugatePair::kDownVelocity).symbols);
}

/// Name, factor in words and dissipation of each term of a velocity: {0} is the variable's name, or
/// its square in the language of effects.
struct VelocityTerm {
  const char *name, *words, *words_of_speed, *dissipation;
};
constexpr VelocityTerm kVelocityTerms[] = {
    {"friction", " x sign of {0}", "", "friction*(sqrt({0} + step^2) - step)"},
    {"linear", " x {0}", " x {0}", "linear*({0})/2"},
    {"quadratic", " x |{0}| x {0}", " x {0}^2", "quadratic*({0} + floor^2)^(3/2)/3"},
    {"cubic", " x {0}^3", " x {0}^3", "cubic*({0})^2/4"},
};

/// Those of a position: {0} is the distance from the middle of the visited range.
struct PositionTerm {
  const char *name, *words, *potential;
};
constexpr PositionTerm kPositionTerms[] = {
    {"constant", "", "constant*({0})"},
    {"linear", " x ({0})", "linear*({0})^2/2"},
    {"quadratic", " x ({0})^2", "quadratic*({0})^3/3"},
    {"cubic", " x ({0})^3", "cubic*({0})^4/4"},
};

}  // namespace

PlaceKinematics place_kinematics(const VectorXd& state, Index coordinates, const VectorXd& lengths,
                                 double s) {
  PlaceKinematics place;
  place.motion.setZero();
  place.by_state.setZero(6, state.size());
  double begin = 0;
  for (Index k = 0; k < lengths.size(); ++k) {
    const bool on_it = k == 0 || s > begin;
    const double length = std::clamp(s - begin, 0.0, lengths[k]);
    begin += lengths[k];
    if (!on_it) break;
    const double angle = state[k], rate = state[coordinates + k];
    const double across = length * std::cos(angle), along = length * std::sin(angle);
    place.motion.head<4>() += Eigen::Vector4d(along, across, across * rate, -along * rate);
    place.motion.tail<2>() << angle, rate;
    place.by_state.col(k).head<4>() << across, -along, -along * rate, -across * rate;
    place.by_state.col(coordinates + k).segment<2>(2) << across, -along;
    place.by_state.bottomRows<2>().setZero();
    place.by_state(4, k) = place.by_state(5, coordinates + k) = 1;
  }
  return place;
}

PlaceLaw::PlaceLaw(ConjugatePair pair, const std::vector<PlaceMotion>& visited) : pair_(pair) {
  double least = variable(visited.front()), most = least;
  for (const PlaceMotion& motion : visited) {
    least = std::min(least, variable(motion));
    most = std::max(most, variable(motion));
  }
  if (!dissipative()) middle_ = 0.5 * (least + most);
  half_ = std::max({std::abs(least - middle_), std::abs(most - middle_), 1e-9});
}

bool PlaceLaw::dissipative() const {
  return pair_ != ConjugatePair::kSidePosition && pair_ != ConjugatePair::kDownPosition &&
         pair_ != ConjugatePair::kAngle;
}

double PlaceLaw::variable(const PlaceMotion& motion) const {
  const double across = std::cos(motion[4]), along = std::sin(motion[4]);
  switch (pair_) {
    case ConjugatePair::kSidePosition:
      return motion[0];
    case ConjugatePair::kDownPosition:
      return motion[1];
    case ConjugatePair::kSideVelocity:
      return motion[2];
    case ConjugatePair::kDownVelocity:
      return motion[3];
    case ConjugatePair::kNormalVelocity:
      return across * motion[2] - along * motion[3];
    case ConjugatePair::kTangentialVelocity:
      return along * motion[2] + across * motion[3];
    case ConjugatePair::kSpeed:
      return std::hypot(motion[2], motion[3]);
    case ConjugatePair::kAngle:
      return motion[4];
    case ConjugatePair::kAngularVelocity:
      return motion[5];
  }
  return 0;
}

VectorXd PlaceLaw::basis(double variable) const {
  const double u = (variable - middle_) / half_;
  VectorXd terms(this->terms());
  if (dissipative()) {
    terms << u / std::hypot(u, kSignWidth), u, std::abs(u) * u, u * u * u;
  } else {
    double power = 1;
    for (int j = 0; j <= kHighestPower; ++j, power *= u) terms[j] = power;
  }
  return terms;
}

MatrixXd PlaceLaw::force(const PlaceMotion& motion) const {
  const double s = variable(motion);
  const double across = std::cos(motion[4]), along = std::sin(motion[4]);
  const Eigen::RowVectorXd terms = basis(s).transpose();
  Vector2d direction(1, 0);
  switch (pair_) {
    case ConjugatePair::kDownPosition:
    case ConjugatePair::kDownVelocity:
      direction = {0, 1};
      break;
    case ConjugatePair::kNormalVelocity:
      direction = {across, -along};
      break;
    case ConjugatePair::kTangentialVelocity:
      direction = {along, across};
      break;
    case ConjugatePair::kSpeed:
      direction = motion.segment<2>(2) / std::max(s, 1e-12 * half_);
      break;
    case ConjugatePair::kAngle:
    case ConjugatePair::kAngularVelocity:
      return terms;
    case ConjugatePair::kSidePosition:
    case ConjugatePair::kSideVelocity:
      break;
  }
  return direction * terms;
}

std::vector<std::vector<int>> PlaceLaw::forms() const {
  if (dissipative()) return {{0}, {1}, {2}, {3}, {0, 1}, {0, 2}, {1, 2}, {1, 3}, {0, 1, 2, 3}};
  return {{0}, {0, 1}, {0, 1, 2}, {0, 1, 2, 3}};
}

bool PlaceLaw::admits(const VectorXd& coefficients) const {
  return (coefficients.array() != 0).all() && (!dissipative() || (coefficients.array() <= 0).all());
}

std::string PlaceLaw::force_name() const { return names_of(pair_).force; }
std::string PlaceLaw::variable_name() const { return names_of(pair_).variable; }

PlaceLaw::Formula PlaceLaw::formula(const std::vector<int>& form, const VectorXd& coefficients,
                                    const MatrixXd& covariance) const {
  const PairNames& names = names_of(pair_);
  Formula formula;
  formula.dissipation = dissipative();
  const auto add = [&](const char* name, int power, double value, double variance) {
    formula.constants.push_back(
        {name, unit_by_power(names, power), value, std::sqrt(std::max(0.0, variance))});
  };
  if (form == std::vector{0, 1} && !dissipative() && coefficients[1] != 0) {
    // c0 + c1 (x - middle) / half = -linear (x - rest)
    const double ratio = coefficients[0] / coefficients[1], by_ratio = half_ / coefficients[1];
    add("linear", 1, -coefficients[1] / half_, covariance(1, 1) / (half_ * half_));
    const double rest_variance =
        (covariance(0, 0) - 2 * ratio * covariance(0, 1) + ratio * ratio * covariance(1, 1)) *
        by_ratio * by_ratio;
    formula.constants.push_back({"rest", names.variable_unit, middle_ - half_ * ratio,
                                 std::sqrt(std::max(0.0, rest_variance)), false});
    formula.text = fmt::format("{} = -linear x ({} - rest)", names.force, names.variable);
    formula.energy = fmt::format("linear*({} - rest)^2/2", names.symbols);
    return formula;
  }
  const bool moved = form.back() > 0 && !dissipative();
  const std::string words =
      moved ? fmt::format("{} {} {:.3g} {}", names.variable, middle_ < 0 ? "+" : "-",
                          std::abs(middle_), names.variable_unit)
            : std::string(names.variable);
  const std::string symbols = dissipative() ? squared_symbols(names)
                              : moved       ? fmt::format("{} - middle", names.symbols)
                                            : std::string(names.symbols);
  std::string terms;
  const auto next = [&](const char* name, const char* in_words, const char* energy) {
    terms += fmt::format("{}{}{}", terms.empty() ? "" : " + ", name,
                         fmt::format(fmt::runtime(in_words), words));
    formula.energy +=
        (formula.energy.empty() ? "" : " + ") + fmt::format(fmt::runtime(energy), symbols);
  };
  for (std::size_t j = 0; j < form.size(); ++j) {
    const auto i = static_cast<Index>(j);
    const auto term = static_cast<std::size_t>(form[j]);
    const double scale = std::pow(half_, form[j]);  // the sign of a velocity has none
    if (dissipative()) {
      const VelocityTerm& of = kVelocityTerms[term];
      next(of.name, pair_ == ConjugatePair::kSpeed ? of.words_of_speed : of.words, of.dissipation);
      add(of.name, form[j], -coefficients[i] / scale, covariance(i, i) / (scale * scale));
    } else {
      const PositionTerm& of = kPositionTerms[term];
      next(of.name, of.words, of.potential);
      add(of.name, form[j], -coefficients[i] / scale, covariance(i, i) / (scale * scale));
    }
  }
  formula.text =
      fmt::format("{} = -{}", names.force, form.size() == 1 ? terms : fmt::format("({})", terms));
  const auto fix = [&](const char* name, double value) {
    if (formula.energy.find(name) != std::string::npos)
      formula.fixed.push_back({name, names.variable_unit, value});
  };
  fix("middle", middle_);
  fix("step", kSignWidth * half_);
  fix("floor", kSpeedFloor);
  return formula;
}

std::vector<PlaceLaw> place_laws(bool torque, const std::vector<PlaceMotion>& visited) {
  std::vector<PlaceLaw> candidates;
  for (const PairNames& names : kPairNames) {
    const bool of_torque =
        names.pair == ConjugatePair::kAngle || names.pair == ConjugatePair::kAngularVelocity;
    if (of_torque == torque) candidates.emplace_back(names.pair, visited);
  }
  return candidates;
}

}  // namespace catena
