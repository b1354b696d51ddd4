// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "common/nearest_name.hpp"
#include "identify/diagnosis/choice.hpp"
#include "identify/diagnosis/explanation.hpp"
#include "identify/diagnosis/links.hpp"
#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/shares.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/diagnosis/verdict.hpp"
#include "identify/forces/law_effect.hpp"
#include "identify/problem/parameter_map.hpp"

namespace catena {
namespace {

constexpr const char* kDiscoveredLaw = "discovered_law";
/// In space, where a link has six numbers at a frame, the work of a missing force grows with the cube of the
/// links: some minutes for so many and 6 s, most of an hour for twice as many.
constexpr int kMostLinksInSpace = 24;
/// A law is sought with so many links where those of the case are too few: with these a missing force is estimated in
/// half a minute.
constexpr int kMostLinksForLaw = 24;

/// "discovered_law", or "discovered_law_2" where a case has one already.
std::string new_id(const DiagnosisContext& context) {
  std::string id = kDiscoveredLaw;
  for (int number = 2; context.knows(id); ++number)
    id = fmt::format("{}_{}", kDiscoveredLaw, number);
  return id;
}

/// The law as an effect of the library, whose parameters begin at the values found.
const Candidate& add_to_library(DiagnosisContext& context, const FittedModel& base,
                                const ForceLaw& law) {
  const double length =
      link_lengths(base.problem->model(), base.problem->model_parameters(base.x, 0)).sum();
  const std::string id = new_id(context);
  Candidate& candidate = context.add_effect(id, effect_of(law, id, length));
  const auto value_of = [&](const std::string& name) {
    for (const CandidateLaw::Constant& constant : law.formula.constants)
      if (name == constant.name) return constant.value;
    return name == kLawOtherPlace ? law.site.other_arc_length : law.site.arc_length;
  };
  for (std::size_t i = 0; i < candidate.parameters.size(); ++i)
    candidate.parameters[i].value = value_of(candidate.effect.parameters[i].name);
  return candidate;
}

/// Begins with the parameters that were estimated beside the force: those of `base` have made up for what it lacks,
/// and a fit from there may end elsewhere.
Explanation refitted_with(const DiagnosisState& state, const FittedModel& base,
                          const MissingForce& force, const std::vector<std::string>& effects,
                          const Candidate& candidate) {
  DiagnosisContext& context = state.context;
  Explanation explanation;
  explanation.id = candidate.id;
  const Case the_case = with_effects(base.problem->the_case(), {candidate}, true);
  const auto problem =
      std::make_shared<const Problem>(the_case, context.model_with(effects, the_case.links));
  Eigen::VectorXd start = transfer(*base.problem, base.x, *problem);
  for (const MissingForce::Parameter& parameter : force.parameters)
    start[unknown_index(*problem, parameter.name)] = parameter.value;
  FittedModel model =
      fit_model(problem, start, state.found.noise, context.least_squares, context.stop);
  explanation.refitted = model.ok;
  if (!model.ok) return explanation;
  explanation.comparison = compare(base, model, state.found.noise);
  explanation.chance = chance_of_any(explanation.comparison, state.found.tried);
  explanation.fit = fit_gap(model, state.found.noise);
  explanation.held_out = held_out_gap(model, state.found.noise);
  explanation.model = std::move(model);
  return explanation;
}

MissingForce force_missing_in(const DiagnosisState& state, const FittedModel& model) {
  state.context.begin("estimating the missing force");
  MissingForce force = missing_force(*model.problem, model.x, levels(state.found.noise),
                                     [&] { return !state.context.stopped(); });
  state.context.stop_if_asked();
  return force;
}

/// A law as an effect, and what is left with it.
struct FittedLaw {
  ForceLaw law;
  Explanation explanation;
};

FittedLaw fitted_law(DiagnosisState& state, const Stage& base, const MissingForce& force) {
  state.context.begin("fitting the law of the missing force");
  const Candidate& candidate = add_to_library(state.context, base.model, *force.law);
  FittedLaw fitted{*force.law, refitted_with(state, base.model, force,
                                             with(base.effects, candidate.id), candidate)};
  fitted.explanation.title = fitted.law.formula.text + site_in_words(fitted.law.site);
  state.context.stop_if_asked();
  return fitted;
}

/// The formulas that the linear equations did not tell from the law, or that they put behind by no more than what the
/// law itself leaves: they may err by so much.
std::vector<FittedLaw> fitted_rivals(DiagnosisState& state, const Stage& base,
                                     const MissingForce& force, const FittedLaw& of) {
  const double error = error_shared(of.explanation.fit);
  std::vector<ForceLaw> laws = of.law.rivals;
  std::copy_if(of.law.behind.begin(), of.law.behind.end(), std::back_inserter(laws),
               [&](const ForceLaw& law) { return law.left_more < error * error; });
  const auto most = static_cast<std::size_t>(kLawThresholds.rivals);
  if (laws.size() > most) laws.erase(laws.begin() + kLawThresholds.rivals, laws.end());
  std::vector<std::string> all = base.effects, ids;
  for (const ForceLaw& law : laws) {
    ids.push_back(add_to_library(state.context, base.model, law).id);
    all.push_back(ids.back());
  }
  std::vector<FittedLaw> fitted;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    state.context.begin("fitting a rival of the law");
    const Candidate candidate = *state.context.find(ids[i]);
    // One model has all rivals: those that the case does not have stay at zero.
    Explanation explanation = refitted_with(state, base.model, force, all, candidate);
    state.context.stop_if_asked();
    if (!explanation.refitted) continue;
    explanation.title = laws[i].formula.text + site_in_words(laws[i].site);
    fitted.push_back({laws[i], std::move(explanation)});
  }
  return fitted;
}

/// Whether exact fits put `rival` in the place of `law`: the data decide for it, or it is a formula and they do not decide
/// for the curve that the law is.
bool takes_place(const FittedLaw& rival, const FittedLaw& law,
                 const std::vector<NoiseModel>& noise) {
  const FittedModel &of_rival = rival.explanation.model, &of_law = law.explanation.model;
  const bool simpler = law.law.formula.curve && !rival.law.formula.curve;
  return sum_of_squares(of_rival, noise) < sum_of_squares(of_law, noise)
             ? simpler || decide(of_rival, of_law, noise).decided
             : simpler && !decide(of_law, of_rival, noise).decided;
}

/// `rival` becomes the law. What was tried, and how well the first law was confirmed, stays.
void exchange(FittedLaw& law, FittedLaw& rival, MissingForce& force) {
  std::swap(law, rival);
  const ForceLaw& first = rival.law;
  law.law.found = true;
  law.law.by_points = first.by_points;
  law.law.candidates = first.candidates;
  law.law.confirmed = first.confirmed;
  law.law.chance = first.chance;
  force.law = law.law;
  force.words.push_back("fitted exactly, another one takes its place: " + law.explanation.title);
}

/// Lists those that the data do not decide against in the sentence.
void sort_rivals(DiagnosisState& state, std::vector<FittedLaw> rivals) {
  Diagnosis& found = state.found;
  std::vector<std::string> undecided;
  for (FittedLaw& rival : rivals) {
    const std::string words = fmt::format("{} ({})", rival.explanation.title, rival.explanation.id);
    if (sort_rival(found, state.last().model, std::move(rival.explanation)))
      undecided.push_back(words);
  }
  found.sentence += undecided.empty() ? " No other formula that was tried does as well."
                                      : fmt::format(" These data do not decide against {} instead.",
                                                    listed(undecided));
}

/// Takes the law of a force that the stage `base` lacks, in place of the effects that `base` has
/// not. False, and nothing changed but the library and the notes, where it does not stand.
bool take_law(DiagnosisState& state, const Stage& base, MissingForce force, const Case& asked) {
  Diagnosis& found = state.found;
  const int most = std::max(state.options.max_effects, state.options.discover ? 1 : 0);
  if (!force.law || !force.law->found || static_cast<int>(base.effects.size()) >= most)
    return false;
  const bool replaces = base.effects.size() < state.last().effects.size();
  const auto stands = [&](const FittedLaw& fitted) {
    return acceptable(state, base.model, fitted.explanation) &&
           (!replaces ||
            predicts_better(fitted.explanation.model, state.last().model, found.noise));
  };
  FittedLaw law = fitted_law(state, base, force);
  const std::string title = state.context.find(law.explanation.id)->title;
  Diagnosis before = found;
  if (stands(law)) {
    std::vector<FittedLaw> rivals = fitted_rivals(state, base, force, law);
    for (FittedLaw& rival : rivals)
      if (stands(rival) && takes_place(rival, law, found.noise)) exchange(law, rival, force);
    found.law = law.explanation.id;
    found.effects = with(base.effects, found.law);
    found.force = std::move(force);
    state.enter(std::move(law.explanation.model), found.effects, found.law,
                replaces ? listed(state.last().effects) : "");
    if (replaces) {
      found.alternatives.clear();
      found.forms.clear();
    }
    conclude(state, asked);
    if (found.verdict == DiagnosisVerdict::kDiscovered) {
      sort_rivals(state, std::move(rivals));
      return true;
    }
  }
  found = std::move(before);
  found.notes.push_back(
      fmt::format("the law of \"{}\" was fitted as an effect, but was not accepted{}", title,
                  replaces ? " against " + listed(found.effects) : ""));
  return false;
}

/// Log odds of the effects of `last`, with the force that is missing beside them, against a force without any
/// of them (`alone`). A force of no known form can do what effects do; what they imitate of it, they
/// only imitate. Unknowns count by the Bayesian information criterion.
double log_odds_against_force_alone(const Stage& last, const MissingForce& beside,
                                    const FittedModel& without, const MissingForce& alone) {
  if (!without.ok) return std::numeric_limits<double>::quiet_NaN();
  const auto unknowns = [](const FittedModel& model) {
    return static_cast<double>(model.problem->unknowns().size());
  };
  const double added = unknowns(last.model) - unknowns(without);
  const double cost = 0.5 * added * std::log(static_cast<double>(last.fit.count));
  return beside.log_probability - alone.log_probability - cost;
}

bool leaves_gap(const Diagnosis& found) {
  return found.verdict == DiagnosisVerdict::kUnexplained ||
         found.verdict == DiagnosisVerdict::kPartly;
}

/// Links of the model whose missing force is sought. Where more links would change the motion by as much as makes a gap, a
/// force makes up for them, too: it follows no law then, or that of another force.
int links_for_law(const DiagnosisState& state) {
  const Stage& bare = last_without_effects(state.found.stages);
  const int links = state.last().links;
  const bool matter = bare.finer.predicted > kThresholds.gap_misfit * bare.fit.noise;
  if (!matter || bare.model.problem->model().in_space()) return links;
  return std::max(links, std::min(state.options.max_links, kMostLinksForLaw));
}

/// As it is where it cannot have so many links.
Stage with_so_many_links(const DiagnosisState& state, Stage stage, int links) {
  if (stage.links == links || !stage.model.ok) return stage;
  state.context.begin("fitting with more links");
  FittedModel model =
      refitted_with_links(stage.model, links, stage.effects, state.found.noise, state.context);
  state.context.stop_if_asked();
  if (!model.ok) return stage;
  stage.model = std::move(model);
  stage.links = links;
  return stage;
}

}  // namespace

bool sort_rival(Diagnosis& found, const FittedModel& law, Explanation rival) {
  const bool ahead = sum_of_squares(law, found.noise) <= sum_of_squares(rival.model, found.noise);
  const Decision decision =
      ahead ? decide(law, rival.model, found.noise) : decide(rival.model, law, found.noise);
  const bool against = ahead && decision.decided;
  (against ? found.runners_up : found.alternatives)
      .push_back({found.law, std::move(rival), decision});
  return !against;
}

void discover(DiagnosisState& state, const Case& asked) {
  Diagnosis& found = state.found;
  const bool gap = leaves_gap(found);
  // Where effects close the gap, one cause may have been taken for several of them only.
  if (!gap && found.effects.size() < 2 && !state.options.discover) return;
  Stage last = state.last();
  if (found.final.problem->model().in_space() && last.links > kMostLinksInSpace) {
    if (gap)
      found.notes.push_back(fmt::format(
          "the missing force is not estimated: in space that is done with at most {} links",
          kMostLinksInSpace));
    return;
  }
  if (gap) last = with_so_many_links(state, std::move(last), links_for_law(state));
  if (last.effects.empty()) {
    found.force = force_missing_in(state, last.model);
    // What is too small to be called missing is too small for a law: links are no cable, and their error follows one.
    if (gap) take_law(state, last, *found.force, asked);
    return;
  }
  Stage bare = last_without_effects(found.stages);
  if (bare.links != state.last().links) {
    bare.model = fit_with_effects(state, {});
    bare.links = state.last().links;
  }
  bare = with_so_many_links(state, std::move(bare), last.links);
  const MissingForce alone = bare.model.ok ? force_missing_in(state, bare.model) : MissingForce{};
  if (state.options.discover && !gap)
    for (const std::string& words : alone.words)
      found.notes.push_back(fmt::format("without {}: {}", listed(last.effects), words));
  if ((gap || state.options.discover) && take_law(state, bare, alone, asked)) return;
  const MissingForce beside = force_missing_in(state, last.model);
  if (gap) found.force = beside;
  const double log_odds = log_odds_against_force_alone(last, beside, bare.model, alone);
  const double decided = std::log(kThresholds.odds);
  if (alone.found && log_odds < (gap ? decided : -decided)) {
    if (!gap && !state.options.discover && take_law(state, bare, alone, asked)) return;
    found.force = beside;
    doubt_effects(state, alone.words.front());
    return;
  }
  if (alone.found && log_odds < decided) {
    add_force_as_rival(state, alone.words.front());
  } else if (alone.found && std::isfinite(log_odds)) {
    found.notes.push_back(
        fmt::format("a force of no known form instead of {} is ruled out by log odds of {:.3g}",
                    listed(found.effects), log_odds));
  }
  if (gap) take_law(state, last, beside, asked);
}

}  // namespace catena
