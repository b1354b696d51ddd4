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

constexpr double kLength = 0.4;  // m
/// The second is inside of the last link of two links and of three. On the first link nothing moves along
/// it; at a joint the effect is the mean of both links, whose directions differ.
constexpr double kPlaces[] = {0.0, 0.8 * kLength, kLength};

VectorXd lengths_of(int links) { return VectorXd::Constant(links, kLength / links); }

/// Angles about the first one, and rates about the third number.
VectorXd state_of(int links, double first, double step, double rate, double rate_step) {
  VectorXd state(2 * links);
  for (int k = 0; k < links; ++k) {
    state[k] = first + k * step;
    state[links + k] = rate + k * rate_step;
  }
  return state;
}

struct MadeLaw {
  PlaceLaw law;
  std::vector<int> form;
  double arc_length = 0;
  VectorXd coefficients;
  ForceLaw found;
};

/// Every pair at inner places, the support and the load, with all forms of a position and one of a
/// velocity. No coefficient gives energy.
std::vector<MadeLaw> laws_of_all_pairs() {
  std::vector<MadeLaw> laws;
  for (const double s : kPlaces) {
    std::vector<PlaceMotion> visited;
    for (const double at : {-1.0, -0.4, 0.3, 0.9})
      visited.push_back(
          place_kinematics(state_of(2, at, -0.5 * at, 2 * at, -3 * at), 2, lengths_of(2), s)
              .motion);
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

/// The generalised force of a law at a state.
VectorXd force_of(const MadeLaw& made, const VectorXd& state, int links) {
  const VectorXd lengths = lengths_of(links);
  const VectorXd size =
      made.law.force(place_kinematics(state, links, lengths, made.arc_length).motion)(Eigen::all,
                                                                                      made.form) *
      made.coefficients;
  VectorXd force = VectorXd::Zero(links);
  if (made.arc_length == 0) {
    add_generalised_force(torque_pattern(links), lengths, state.data(), size[0], force.data());
  } else {
    for (const ForceDirection direction : {ForceDirection::kSide, ForceDirection::kDown})
      add_generalised_force(point_pattern(direction, made.arc_length, lengths), lengths,
                            state.data(), size[direction == ForceDirection::kDown], force.data());
  }
  return force;
}

}  // namespace

TEST_CASE("one effect of every law does the law's force in chains of two and of three links") {
  const std::vector<MadeLaw> laws = laws_of_all_pairs();
  const testing::TemporaryFolder folder;
  std::string all, inside;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const std::string id = fmt::format("law_{}", i);
    const auto file =
        folder.write(id + ".toml", effect_of(laws[i].found, id, laws[i].arc_length, kLength));
    const std::string name = fmt::format("\"{}.toml\", ", id);
    all += name;
    if (laws[i].arc_length > 0 && laws[i].arc_length < kLength) inside += name;
    if (!laws[i].law.dissipative()) continue;
    for (const EffectParameter& parameter : read_effect(file).parameters)
      CHECK(parameter.lower == 0);
  }
  ProviderOptions options;
  options.derive_program = tests::build_folder() / "bin" / "catena-derive";
  options.cache_directory = folder.path() / "cache";
  options.for_fits = true;
  for (const int links : {2, 3}) {
    CAPTURE(links);
    const auto description =
        folder.write(fmt::format("{}.toml", links),
                     fmt::format("format = 1\nkind = \"model\"\nid = \"laws\"\neffects = [{}]\n",
                                 links == 2 ? all : inside));
    const Model model = provide_model(description, links, options);
    VectorXd plain = model.default_parameters();
    for (Index i = 0; i < plain.size(); ++i)
      if (!std::isfinite(plain[i])) plain[i] = 0.1;
    for (Index k = 0; k < links; ++k)
      plain[model.parameter_index(fmt::format("length_{}", k + 1))] = lengths_of(links)[k];
    const VectorXd state = state_of(links, 0.3, -0.7, 1.1, -1.8), none = VectorXd::Zero(links);
    const auto residual = [&](const VectorXd& parameters) {
      VectorXd r(links);
      model.residual(
          {0, state.data(), state.data() + links, none.data(), nullptr, nullptr, parameters.data()},
          r.data());
      return r;
    };
    for (std::size_t i = 0; i < laws.size(); ++i) {
      const MadeLaw& made = laws[i];
      if (links == 3 && (made.arc_length == 0 || made.arc_length == kLength)) continue;
      CAPTURE(made.found.formula.text);
      CAPTURE(made.arc_length);
      VectorXd with = plain;
      for (const PlaceLaw::Constant& constant : made.found.formula.constants)
        if (constant.amplitude)
          with[model.parameter_index(fmt::format("law_{}.{}", i, constant.name))] = constant.value;
      const VectorXd force = force_of(made, state, links);
      // The residual is what is lacking: a force lowers it.
      const VectorXd change = residual(plain) - residual(with);
      REQUIRE(force.norm() > 1e-6);
      CHECK((change - force).norm() < 1e-8 * force.norm());
    }
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
