// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_effect.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
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
#include "identify/forces/law_choice.hpp"
#include "runtime/model.hpp"
#include "tests/support/data.hpp"
#include "tests/support/near.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kLength = 0.4, kGravity = 9.81;  // m, m/s^2
constexpr double kMass = 0.05, kLoad = 0.2;       // kg, of a link and of the load
constexpr double kTime = 0.1;                     // s
constexpr double kStretch = 0.3;                  // of everything that relaxes, m, rad or 1/m
/// Inside of the last link of two links and of three. On the first link nothing moves along it; at a
/// joint the effect is the mean of both links, whose directions differ.
constexpr double kInside = 0.8 * kLength;
constexpr double kAbove = 0.3 * kLength;  // of a pair of places the other one

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

LawChain chain_of(int links, bool in_space) {
  return {{lengths_of(links), in_space},
          in_space ? 3 * links : links,
          kGravity,
          VectorXd::Constant(links, kMass),
          kLoad};
}

/// The same in the plane or, with azimuths, in space.
VectorXd state_on(const LawChain& chain, double first, double step, double rate, double rate_step) {
  const auto links = static_cast<int>(chain.lengths.size());
  VectorXd plane = state_of(links, first, step, rate, rate_step);
  if (!chain.in_space) return plane;
  VectorXd state(6 * links);
  for (int k = 0; k < links; ++k) {
    const double angle = plane[k], turning = plane[links + k];
    const double azimuth = 0.4 + 0.3 * k, winding = 0.6 - 0.2 * k;
    const Eigen::Vector3d outwards(std::cos(azimuth), 0, std::sin(azimuth));
    const Eigen::Vector3d around(-std::sin(azimuth), 0, std::cos(azimuth));
    const Eigen::Vector3d down(0, 1, 0);
    const Eigen::Vector3d along = std::sin(angle) * outwards + std::cos(angle) * down;
    const Eigen::Vector3d faster = turning * (std::cos(angle) * outwards - std::sin(angle) * down) +
                                   winding * std::sin(angle) * around;
    for (int i = 0; i < 3; ++i) {
      state[i * links + k] = along[i];
      state[3 * links + i * links + k] = faster[i];
    }
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
std::vector<MadeLaw> laws_of_all_pairs(bool in_space) {
  const LawChain chain = chain_of(2, in_space);
  LawMotion visited{MatrixXd(2 * chain.coordinates, 4), {0, 0.4, 0.8, 1.2}};
  Index node = 0;
  for (const double at : {-1.0, -0.4, 0.3, 0.9})
    visited.state.col(node++) = state_on(chain, at, -0.5 * at, 2 * at, -3 * at);
  std::vector<MadeLaw> laws;
  std::set<std::vector<std::vector<int>>> grammars;  // by their forms
  for (const LawSite& site :
       {LawSite{SiteKind::kPlace, kInside}, LawSite{SiteKind::kPlace, kLength},
        LawSite{SiteKind::kPair, kAbove, 0, kInside}, LawSite{SiteKind::kPair, kAbove, 0, kLength},
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
        made.of_any_links =
            energies.empty() && (site.arc_length == kInside || site.other_arc_length == kInside ||
                                 site.kind == SiteKind::kJoints);
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
VectorXd force_of(const MadeLaw& made, const VectorXd& at, const LawChain& chain) {
  const auto links = static_cast<int>(chain.lengths.size());
  VectorXd state(at.size() + links);
  using Kind = CandidateLaw::Formula::Kind;
  const Kind kind = made.found.formula.kind;
  VectorXd beside = accelerations_of(links);
  // A torque of an effect goes with the steady tension.
  if (kind != Kind::kMass)
    beside.setConstant(kind == Kind::kForce ? kTime : kind == Kind::kTorque ? 0 : kStretch);
  state << at, beside;
  const CandidateLaw law = links == 2 ? made.law : made.law.on(chain);
  VectorXd torques = law.force(state, made.form) * made.coefficients;
  if (!chain.in_space) return torques;
  VectorXd force(3 * links);
  for (Index k = 0; k < links; ++k) {
    const Eigen::Vector3d along(at[k], at[links + k], at[2 * links + k]);
    const Eigen::Vector3d on_link = torques.segment<3>(3 * k).cross(along);
    for (Index i = 0; i < 3; ++i) force[i * links + k] = on_link[i];
  }
  return force;
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

namespace {

void check_effects_of_all_laws(bool in_space) {
  const std::vector<MadeLaw> laws = laws_of_all_pairs(in_space);
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
    const LawChain chain = chain_of(links, in_space);
    folder.write(fmt::format("{}.toml", links),
                 fmt::format("format = 1\nkind = \"model\"\nid = \"laws\"\n{}effects = [{}]\n",
                             in_space ? "space = \"3d\"\n" : "", links == 2 ? all : inside));
    const Model model = compiled_model(folder.path(), links);
    VectorXd plain = model.default_parameters();
    for (Index i = 0; i < plain.size(); ++i)
      if (!std::isfinite(plain[i])) plain[i] = 0.1;
    for (Index k = 0; k < links; ++k) {
      plain[model.parameter_index(fmt::format("length_{}", k + 1))] = lengths_of(links)[k];
      plain[model.parameter_index(fmt::format("mass_{}", k + 1))] = kMass;
    }
    plain[model.parameter_index("load_mass")] = kLoad;
    // A one-sided spring acts in one of them at least.
    const VectorXd states[] = {state_on(chain, 0.3, -0.7, 1.1, -1.8),
                               state_on(chain, -1, 0.45, 0.7, 0.9)};
    const VectorXd faster = accelerations_of(static_cast<int>(chain.coordinates));
    const VectorXd stretches = VectorXd::Constant(model.states(), kStretch);
    const auto residual = [&](const VectorXd& state, const VectorXd& parameters) {
      VectorXd r(chain.coordinates);
      model.residual({kTime, state.data(), state.data() + chain.coordinates, faster.data(),
                      stretches.data(), nullptr, parameters.data()},
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
        largest = std::max(largest, force_of(made, state, chain).norm());
      REQUIRE(largest > 1e-6);
      // The residual is what is lacking: a force lowers it.
      for (const VectorXd& state : states) {
        const VectorXd change = residual(state, plain) - residual(state, with);
        CHECK((change - force_of(made, state, chain)).norm() < 1e-8 * largest);
      }
    }
  }
}

}  // namespace

TEST_CASE("one effect of every law does the law's force in chains of two and of three links") {
  check_effects_of_all_laws(false);
}

TEST_CASE("one effect of every law does the law's force in chains in space") {
  check_effects_of_all_laws(true);
}

TEST_CASE("what holds a joint makes its force of the rates") {
  const LawChain chain = chain_of(2, false);
  const VectorXd state = state_of(2, 0.3, -0.7, 1.1, -1.8);
  int sticking = 0;
  for (const MadeLaw& made : laws_of_all_pairs(false)) {
    if (!made.law.sticks(made.form)) continue;
    ++sticking;
    CAPTURE(made.found.formula.text);
    const VectorXd force = made.law.force(state, made.form) * made.coefficients;
    const MatrixXd resistance = made.law.resistance(state, made.form, made.coefficients);
    CHECK((resistance * state.tail(2) - force).norm() < 1e-12 * force.norm());
  }
  CHECK(sticking > 3);
}

TEST_CASE("a law against a velocity that drives it is refused, term by term") {
  const LawChain chain = chain_of(2, false);
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

TEST_CASE(
    "no piece of a curve against a velocity makes energy, and beside its knots there is none") {
  LawGrammar grammar;
  add_velocity_curve(grammar, {0.15, 0.3, 1}, true);
  REQUIRE(grammar.forms.size() == 2);
  for (const LawTerm& term : grammar.terms) {
    CAPTURE(static_cast<int>(term.kind));
    CAPTURE(term.shape);
    double least_power = 0;
    for (int k = -1500; k <= 1500; ++k)
      least_power = std::min(least_power, value_of(term, 1e-3 * k) * 1e-3 * k);
    CHECK(least_power > -1e-12);
    const double sign = term.kind == TermKind::kBackwardPiece ? -1 : 1;
    CHECK(sign * value_of(term, sign * term.shape) == catena::near(1, 0.05));
    if (term.below > 0) CHECK(std::abs(value_of(term, sign * term.below)) < 0.05);
    if (std::isfinite(term.above)) CHECK(std::abs(value_of(term, sign * term.above)) < 0.05);
    if (term.kind != TermKind::kPiece) CHECK(std::abs(value_of(term, -sign * 0.15)) < 1e-6);
  }
}

TEST_CASE("a curve is without the pieces that would make energy, and without those of no use") {
  const LawChain chain = chain_of(2, false);
  LawMotion motion{MatrixXd(4, 9), {}};
  for (Index k = 0; k < 9; ++k) {
    const double rate = -2 + 0.5 * static_cast<double>(k);
    motion.state.col(k) = state_of(2, 0.1, 0.05, rate, 0.7 * rate);
    motion.time.push_back(static_cast<double>(k));
  }
  const CandidateLaw law({SiteKind::kJoint, 0.5 * kLength, 1}, LawVariable::kJointRate, chain,
                         {motion}, {});
  const auto odd = std::find_if(law.forms().begin(), law.forms().end(),
                                [&](const auto& form) { return law.has_pieces(form); });
  REQUIRE(odd != law.forms().end());
  REQUIRE(odd->size() > 2);
  // As if every term did something of its own.
  const MatrixXd gram = 100 * MatrixXd::Identity(law.terms(), law.terms());
  LawTrials::OfCandidate of{gram.sparseView(), MatrixXd::Zero(law.terms(), 1)};
  of.cross(odd->at(0), 0) = 50;   // it would drive the rate
  of.cross(odd->at(1), 0) = -50;  // explains 25
  of.cross(odd->at(2), 0) = -5;   // explains 0.25
  const auto fitted = fit_of_column(law, of, *odd, 0, 3);
  REQUIRE(fitted.has_value());
  CHECK(fitted->form == std::vector<int>{odd->at(1)});
  CHECK(fitted->coefficients[0] == doctest::Approx(-0.5));
  CHECK(fitted->explained == doctest::Approx(25));
}
