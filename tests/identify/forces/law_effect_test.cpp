// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_effect.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "description/effect.hpp"
#include "identify/forces/candidate_law.hpp"
#include "runtime/model.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kLength = 0.4, kGravity = 9.81;  // m, m/s^2
constexpr double kTime = 0.05;                    // s
constexpr double kStretch = 0.3;                  // of everything that relaxes, m, rad or 1/m
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
  bool of_any_links = false;  ///< tried with other links, too
};

/// Every variable of every kind of site with a formula of two terms where it has one, and the first
/// variable of each grammar with every kind of term. No coefficient gives energy.
std::vector<MadeLaw> laws_of_all_pairs() {
  LawMotion visited{MatrixXd(4, 4), {0, 0.2, 0.4, 0.6}};
  Index node = 0;
  for (const double at : {-1.0, -0.4, 0.3, 0.9})
    visited.state.col(node++) = state_of(2, at, -0.5 * at, 2 * at, -3 * at);
  const LawChain chain{lengths_of(2), 2, kGravity};
  std::vector<MadeLaw> laws;
  std::set<std::vector<std::vector<int>>> grammars;  // by their forms
  for (const LawSite& site :
       {LawSite{SiteKind::kPlace, kInside}, LawSite{SiteKind::kPlace, kLength},
        LawSite{SiteKind::kJoint, 0, 0}, LawSite{SiteKind::kJoint, 0.5 * kLength, 1},
        LawSite{SiteKind::kCable}, LawSite{SiteKind::kJoints}}) {
    std::set<std::string> variables;
    std::vector<CandidateLaw> candidates = candidates_at(site, chain, {visited});
    for (CandidateLaw& law : candidates_of_time(site, chain, {visited}))
      candidates.push_back(std::move(law));
    for (const CandidateLaw& law : candidates) {
      if (!variables.insert(law.force_name() + law.variable_name()).second)
        continue;  // another fixed point
      const bool every_term = grammars.insert(law.forms()).second;
      const bool has_two = std::any_of(law.forms().begin(), law.forms().end(),
                                       [](const auto& form) { return form.size() == 2; });
      std::set<std::string> energies;  // one shape of each kind of term is enough
      for (const std::vector<int>& form : law.forms()) {
        if (every_term ? form.size() > 1 && form.size() < 4 : form.size() != (has_two ? 2 : 1))
          continue;
        const auto terms = static_cast<Index>(form.size());
        const Index numbers = law.numbers(form).size();
        MadeLaw made{law, form, VectorXd::LinSpaced(terms, -0.3, -0.5), {}};
        made.found.force = law.force_name();
        made.found.variable = law.variable_name();
        made.found.site = site;
        made.found.place = site.arc_length;
        made.of_any_links = energies.empty() && site.arc_length == kInside;
        made.found.formula = law.formula(
            form, made.coefficients, 1e-4 * MatrixXd::Identity(terms + numbers, terms + numbers));
        if (!energies.insert(made.found.formula.energy).second) continue;
        laws.push_back(std::move(made));
        if (!every_term) break;
      }
    }
  }
  return laws;
}

VectorXd accelerations_of(int links) { return VectorXd::LinSpaced(links, 2, -5); }

/// The generalised force of a law at a state.
VectorXd force_of(const MadeLaw& made, const VectorXd& at, int links) {
  VectorXd state(at.size() + links);
  using Kind = CandidateLaw::Formula::Kind;
  const Kind kind = made.found.formula.kind;
  VectorXd beside = accelerations_of(links);
  if (kind != Kind::kMass) beside.setConstant(kind == Kind::kTime ? kTime : kStretch);
  state << at, beside;
  const CandidateLaw law =
      links == 2 ? made.law : made.law.on({lengths_of(links), links, kGravity});
  return law.force(state, made.form) * made.coefficients;
}

/// The model laws of N.toml in the folder. C without optimisation is compiled in a quarter of the time of C++.
Model compiled_model(const std::filesystem::path& folder, int links) {
  const std::string derive = (tests::build_folder() / "bin" / "catena-derive").string();
  const std::string commands = fmt::format(
      "cd '{0}' && '{1}' derive --yes --description {2}.toml --links {2} --format c --output {2} "
      "&& "
      "echo 'const catena_model* catena_model_table(void) {{ return laws_{2}(); }}' >> "
      "{2}/laws_{2}.c && "
      "cc -std=c99 -shared -fPIC {2}/laws_{2}.c -lm -o {2}.so",
      folder.string(), derive, links);
  REQUIRE(std::system(commands.c_str()) == 0);
  return Model::load(folder / fmt::format("{}.so", links));
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
    if (!laws[i].law.against()) continue;
    for (const EffectParameter& parameter : read_effect(file).parameters)
      CHECK(parameter.lower >= 0);
  }
  for (const int links : {2, 3}) {
    CAPTURE(links);
    folder.write(fmt::format("{}.toml", links),
                 fmt::format("format = 1\nkind = \"model\"\nid = \"laws\"\neffects = [{}]\n",
                             links == 2 ? all : inside));
    const Model model = compiled_model(folder.path(), links);
    VectorXd plain = model.default_parameters();
    for (Index i = 0; i < plain.size(); ++i)
      if (!std::isfinite(plain[i])) plain[i] = 0.1;
    for (Index k = 0; k < links; ++k)
      plain[model.parameter_index(fmt::format("length_{}", k + 1))] = lengths_of(links)[k];
    // A one-sided spring acts in one of them at least.
    const VectorXd states[] = {state_of(links, 0.3, -0.7, 1.1, -1.8),
                               state_of(links, -1, 0.45, 0.7, 0.9)};
    const VectorXd faster = accelerations_of(links);
    const VectorXd stretches = VectorXd::Constant(model.states(), kStretch);
    const auto residual = [&](const VectorXd& state, const VectorXd& parameters) {
      VectorXd r(links);
      model.residual({kTime, state.data(), state.data() + links, faster.data(), stretches.data(),
                      nullptr, parameters.data()},
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
      double largest = 0;
      for (const VectorXd& state : states)
        largest = std::max(largest, force_of(made, state, links).norm());
      REQUIRE(largest > 1e-6);
      // The residual is what is lacking: a force lowers it.
      for (const VectorXd& state : states) {
        const VectorXd change = residual(state, plain) - residual(state, with);
        CHECK((change - force_of(made, state, links)).norm() < 1e-8 * largest);
      }
    }
  }
}

TEST_CASE("a law against a velocity that drives it is refused, term by term") {
  const LawChain chain{lengths_of(2), 2, kGravity};
  LawMotion motion{MatrixXd(4, 2), {0, 1}};
  motion.state << state_of(2, 0.1, 0, 0.1, 0), state_of(2, 1, 0, 1, 0);
  const std::vector<LawMotion> visited = {motion};
  const LawSite place{SiteKind::kPlace, kInside};
  const CandidateLaw drag(place, LawVariable::kSpeed, chain, visited, {});
  CHECK(drag.admits(Eigen::Vector2d(-0.3, -0.1)));
  CHECK_FALSE(drag.admits(Eigen::Vector2d(-0.3, 0.1)));
  CHECK_FALSE(drag.admits(Eigen::Vector2d(-0.3, 0)));  // a term that the other one imitates
  CHECK(CandidateLaw(place, LawVariable::kSidePosition, chain, visited, {})
            .admits(Eigen::Vector2d(0.3, 0.1)));
}
