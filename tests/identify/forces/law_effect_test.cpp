// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_effect.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "description/effect.hpp"
#include "identify/forces/candidate_law.hpp"
#include "identify/models/model_provider.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kLength = 0.4;  // m
/// Inside of the last link of two links and of three. On the first link nothing moves along it; at a
/// joint the effect is the mean of both links, whose directions differ.
constexpr double kInside = 0.8 * kLength;

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
  CandidateLaw law;
  std::vector<int> form;
  VectorXd coefficients;
  ForceLaw found;
  bool of_any_links = false;  ///< its place is not that of a joint, nor an end
};

/// Every variable of every kind of site with all forms of a position and some of a velocity. No
/// coefficient gives energy.
std::vector<MadeLaw> laws_of_all_pairs() {
  std::vector<VectorXd> visited;
  for (const double at : {-1.0, -0.4, 0.3, 0.9})
    visited.push_back(state_of(2, at, -0.5 * at, 2 * at, -3 * at));
  const LawChain chain{lengths_of(2), 2};
  std::vector<MadeLaw> laws;
  std::set<std::string> seen;

  for (const LawSite& site :
       {LawSite{SiteKind::kPlace, kInside}, LawSite{SiteKind::kPlace, kLength},
        LawSite{SiteKind::kJoint, 0, 0}, LawSite{SiteKind::kJoint, 0.5 * kLength, 1},
        LawSite{SiteKind::kCable}, LawSite{SiteKind::kJoints}}) {
    int distances = 0;
    for (const CandidateLaw& law : candidates_at(site, chain, visited)) {
      if (law.variable_name().starts_with("distance") && distances++ > 0) continue;
      for (const std::vector<int>& form : law.forms()) {
        // Every term once inside, in a joint, in all joints and along the velocity; else all
        // powers together.
        const bool each =
            site.arc_length != kLength &&
            (!law.dissipative() || law.variable_name() == "speed" ||
             law.variable_name().ends_with("rate") || law.variable_name() == "rate of curvature");
        if (each ? form.size() > 2 : form.size() != 4) continue;
        if (each && form.size() == 2 && law.dissipative()) continue;
        const auto terms = static_cast<Index>(form.size());
        laws.push_back({law, form, VectorXd::LinSpaced(terms, -0.3, -0.5), {}});
        MadeLaw& made = laws.back();
        made.found.force = law.force_name();
        made.found.variable = law.variable_name();
        made.found.site = site;
        made.found.place = site.arc_length;
        made.of_any_links = site.kind == SiteKind::kPlace && site.arc_length == kInside;
        made.found.formula =
            law.formula(form, made.coefficients, 1e-4 * MatrixXd::Identity(terms, terms));
        // One shape of each kind of term is enough.
        if (!seen.insert(site_in_words(site) + law.variable_name() + made.found.formula.energy)
                 .second)
          laws.pop_back();
      }
    }
  }
  return laws;
}

/// The generalised force of a law at a state.
VectorXd force_of(const MadeLaw& made, const VectorXd& state, int links) {
  const CandidateLaw law = links == 2 ? made.law : made.law.on({lengths_of(links), links});
  return law.force(state, made.form) * made.coefficients;
}

}  // namespace

TEST_CASE("one effect of every law does the law's force in chains of two and of three links") {
  const std::vector<MadeLaw> laws = laws_of_all_pairs();
  const testing::TemporaryFolder folder;
  std::string all, inside;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const std::string id = fmt::format("law_{}", i);
    const auto file = folder.write(id + ".toml", effect_of(laws[i].found, id, kLength));
    const std::string name = fmt::format("\"{}.toml\", ", id);
    all += name;
    if (laws[i].of_any_links) inside += name;
    if (!laws[i].law.dissipative()) continue;
    for (const EffectParameter& parameter : read_effect(file).parameters)
      CHECK(parameter.lower >= 0);
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
      if (links == 3 && !made.of_any_links) continue;
      CAPTURE(made.found.formula.text);
      CAPTURE(site_in_words(made.found.site));
      VectorXd with = plain;
      for (const CandidateLaw::Constant& constant : made.found.formula.constants)
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
  const LawChain chain{lengths_of(2), 2};
  const std::vector<VectorXd> visited = {state_of(2, 0.1, 0, 0.1, 0), state_of(2, 1, 0, 1, 0)};
  const LawSite place{SiteKind::kPlace, kInside};
  const CandidateLaw drag(place, LawVariable::kSpeed, chain, visited);
  CHECK(drag.admits(Eigen::Vector2d(-0.3, -0.1)));
  CHECK_FALSE(drag.admits(Eigen::Vector2d(-0.3, 0.1)));
  CHECK_FALSE(drag.admits(Eigen::Vector2d(-0.3, 0)));  // a term that the other one imitates
  CHECK(CandidateLaw(place, LawVariable::kSidePosition, chain, visited)
            .admits(Eigen::Vector2d(0.3, 0.1)));
}
