// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_effect.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "description/effect.hpp"
#include "identify/forces/force_pattern.hpp"
#include "identify/forces/place_law.hpp"
#include "identify/models/model_provider.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

const VectorXd kLengths = VectorXd::Constant(2, 0.2);  // m

/// Angles and rates of two links.
VectorXd state_of(double first, double second, double rate, double second_rate) {
  VectorXd state(4);
  state << first, second, rate, second_rate;
  return state;
}

struct MadeLaw {
  PlaceLaw law;
  std::vector<int> form;
  double arc_length = 0;
  VectorXd coefficients;
  ForceLaw found;
};

/// Every pair at an inner place or the support, with all forms of a position and two of a velocity;
/// of the load, too. No coefficient gives energy.
std::vector<MadeLaw> laws_of_all_pairs() {
  std::vector<MadeLaw> laws;
  for (const double s : {0.0, 0.23, kLengths.sum()}) {
    std::vector<PlaceMotion> visited;
    for (const double at : {-1.0, -0.4, 0.3, 0.9})
      visited.push_back(
          place_kinematics(state_of(at, 0.5 * at, 2 * at, -at), 2, kLengths, s).motion);
    for (const PlaceLaw& law : place_laws(s == 0, visited))
      for (const std::vector<int>& form : law.forms()) {
        if (law.dissipative() && form.size() != 4) continue;
        const auto terms = static_cast<Index>(form.size());
        laws.push_back({law, form, s, VectorXd::LinSpaced(terms, -0.3, -0.5), {}});
        MadeLaw& made = laws.back();
        made.found.force = law.force_name();
        made.found.variable = law.variable_name();
        made.found.formula =
            law.formula(form, made.coefficients, 1e-4 * MatrixXd::Identity(terms, terms));
      }
  }
  return laws;
}

}  // namespace

TEST_CASE("the effect of every law does the law's force, and gives no energy where it must not") {
  const std::vector<MadeLaw> laws = laws_of_all_pairs();
  const testing::TemporaryFolder folder;
  std::string names;
  std::vector<LawEffect> effects;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const std::string id = fmt::format("law_{}", i);
    effects.push_back(effect_of(laws[i].found, id, laws[i].arc_length, kLengths));
    const auto file = folder.write(id + ".toml", effects.back().text);
    names += fmt::format("{}\"{}.toml\"", i ? ", " : "", id);
    if (!laws[i].law.dissipative()) continue;
    for (const EffectParameter& parameter : read_effect(file).parameters)
      if (parameter.name != "offset") CHECK(parameter.lower == 0);
  }
  const auto description = folder.write(
      "model.toml",
      fmt::format("format = 1\nkind = \"model\"\nid = \"laws\"\neffects = [{}]\n", names));
  ProviderOptions options;
  options.derive_program = tests::build_folder() / "bin" / "catena-derive";
  options.cache_directory = folder.path() / "cache";
  options.for_fits = true;
  const Model model = provide_model(description, 2, options);
  VectorXd plain = model.default_parameters();
  for (Index i = 0; i < plain.size(); ++i)
    if (!std::isfinite(plain[i])) plain[i] = 0.1;
  for (Index k = 0; k < 2; ++k) plain[model.parameter_index(fmt::format("length_{}", k + 1))] = 0.2;
  const VectorXd state = state_of(0.3, -0.4, 1.1, -0.7), none = VectorXd::Zero(2);
  const auto residual = [&](const VectorXd& parameters) {
    VectorXd r(2);
    model.residual(
        {0, state.data(), state.data() + 2, none.data(), nullptr, nullptr, parameters.data()},
        r.data());
    return r;
  };
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const MadeLaw& made = laws[i];
    CAPTURE(made.found.formula.text);
    CAPTURE(made.arc_length);
    VectorXd with = plain;
    for (const PlaceLaw::Constant& constant : made.found.formula.constants)
      if (constant.amplitude)
        with[model.parameter_index(fmt::format(
            "law_{}.{}{}", i, constant.name,
            effects[i].link ? fmt::format("_{}", effects[i].link) : ""))] = constant.value;
    const VectorXd size =
        made.law.force(place_kinematics(state, 2, kLengths, made.arc_length).motion)(Eigen::all,
                                                                                     made.form) *
        made.coefficients;
    VectorXd force = VectorXd::Zero(2);
    if (made.arc_length == 0) {
      add_generalised_force(torque_pattern(2), kLengths, state.data(), size[0], force.data());
    } else {
      for (const ForceDirection direction : {ForceDirection::kSide, ForceDirection::kDown})
        add_generalised_force(point_pattern(direction, made.arc_length, kLengths), kLengths,
                              state.data(), size[direction == ForceDirection::kDown], force.data());
    }
    // The residual is what is lacking: a force lowers it.
    const VectorXd change = residual(plain) - residual(with);
    REQUIRE(force.norm() > 1e-6);
    CHECK((change - force).norm() < 1e-8 * force.norm());
  }
}

TEST_CASE("a law against a velocity that drives it is refused, term by term") {
  const PlaceMotion slow = PlaceMotion::Constant(0.1), fast = PlaceMotion::Constant(1.0);
  const PlaceLaw drag(ConjugatePair::kSpeed, {slow, fast});
  CHECK(drag.admits(Eigen::Vector2d(-0.3, -0.1)));
  CHECK_FALSE(drag.admits(Eigen::Vector2d(-0.3, 0.1)));
  CHECK_FALSE(drag.admits(Eigen::Vector2d(-0.3, 0)));  // a term that the other one imitates
  CHECK(PlaceLaw(ConjugatePair::kSidePosition, {slow, fast}).admits(Eigen::Vector2d(0.3, 0.1)));
}
