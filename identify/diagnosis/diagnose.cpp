// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/diagnose.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "common/parallel.hpp"
#include "identify/diagnosis/baseline.hpp"
#include "identify/diagnosis/final_model.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/diagnosis/verdict.hpp"

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kFarGap = 4;        // times the noise: the linear score may rank wrongly
constexpr double kCertain = -3;      // log10 of the probability of a false name
constexpr double kWorthwhile = 0.1;  // share of the squared misfit an effect must explain
constexpr double kDetail = 0.01;     // of the squared misfit before the first effect
constexpr double kWrongLaw = 0.005;  // of the same: more than a law slightly wrong leaves of it
constexpr std::size_t kTriedWithMoreLinks = 3, kFirstsOfPairs = 4;
constexpr int kSecondsOfPairs = 3;
constexpr int kRounds = 2, kMostSwaps = 3;

class Physician {
 public:
  Physician(Workshop& workshop, const DiagnosisOptions& options)
      : workshop_(workshop), options_(options) {}

  Diagnosis examine(Case the_case) {
    const auto begin = std::chrono::steady_clock::now();
    if (the_case.experiments.empty()) throw InputError("the case has no experiment to diagnose");
    hold_out(the_case, workshop_, result_.notes);
    workshop_.say("fitting the baseline");
    enter(fit_baseline(for_the_search(the_case), workshop_), {}, "");
    look_ahead_and_back();
    // One after the other two effects may both be missed: neither is worth much alone, or a third
    // imitates both.
    if ((!explained() || one_may_imitate_two()) && add_pair()) look_ahead_and_back();
    conclude(result_, the_case, workshop_);
    result_.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return std::move(result_);
  }

 private:
  Stage& stage() { return result_.stages.back(); }

  /// A new stage; the noise floor follows the best model so far.
  void enter(FittedModel model, std::vector<std::string> effects, const std::string& added,
             const std::string& removed = "") {
    const std::vector<NoiseFloor> noise = noise_floors(model);
    if (result_.floors.empty()) {
      result_.noise = noise;
      for (const NoiseFloor& floor : noise) {
        if (!(floor.sigma > 0))
          throw InputError(
              "too few neighbouring frames to estimate the noise: give `noise` in the "
              "experiment");
        result_.floors.push_back(floor.sigma);
      }
    }
    for (std::size_t e = 0; e < noise.size(); ++e)
      if (noise[e].sigma < result_.floors[e]) {
        result_.noise[e] = noise[e];
        result_.floors[e] = noise[e].sigma;
      }
    Stage next;
    next.effects = std::move(effects);
    next.added = added;
    next.removed = removed;
    next.links = model.problem->the_case().links;
    next.fit = fit_gap(model, result_.floors);
    next.held_out = held_out_gap(model, result_.floors);
    next.model = std::move(model);
    result_.stages.push_back(std::move(next));
  }

  bool far() { return stage().fit.ratio() > kFarGap; }

  bool explained() {
    return !gap_left(stage()) ||
           (stage().fit.ratio() <= kClosed && !only_imitated(result_.stages, stage().fit) &&
            (stage().held_out.count == 0 || stage().held_out.ratio() <= kClosedHeldOut));
  }

  /// One effect closes the gap but leaves more of a trace than a law slightly wrong would.
  bool one_may_imitate_two() {
    return stage().effects.size() == 1 && stage().fit.ratio() > kVisible && trace_left(stage()) &&
           std::pow(stage().fit.misfit, 2) >
               kWrongLaw * std::pow(misfit_without_effects(result_.stages), 2);
  }

  void look_ahead_and_back() {
    // What looking back changed may make room for more, or need more links.
    for (int round = 0; round < kRounds; ++round) {
      look_for_effects();
      if (result_.effects.empty() || !look_back() || !gap_left(stage())) break;
    }
  }

  void look_for_effects() {
    for (;;) {
      workshop_.stop_if_asked();
      const bool gap = gap_left(stage());
      // A name is given only at a number of links that leaves no trace.
      if (!gap && (stage().effects.empty() || !trace_left(stage()))) break;
      stage().finer = try_finer_chain(stage().model, stage().effects, result_.floors,
                                      options_.max_links, workshop_);
      if (stage().finer.taken) {
        enter(stage().finer.model, stage().effects, kTooFewLinks);
        continue;
      }
      if (!gap || static_cast<int>(stage().effects.size()) >= options_.max_effects) break;
      stage().explanations = look(stage().model, stage().effects);
      const Explanation* best = choose(stage().explanations);
      if (!best && add_with_more_links()) continue;
      if (!best) break;
      std::vector<std::string> effects = stage().effects;
      if (best->candidate >= 0) effects.push_back(best->id);
      result_.freer_start = result_.freer_start || best->candidate < 0;
      enter(trimmed(best->model), effects, best->id);
    }
    result_.effects = stage().effects;
    if (result_.effects.empty()) return;
    if (trace_left(stage())) try_others_on_finer_chain();
    go_back_to_fewer_links();
    result_.effects = stage().effects;
  }

  /// What was added last may have won because the right one needs more links than there are.
  void try_others_on_finer_chain() {
    const Stage& looked = result_.stages[result_.stages.size() - 2];
    const int links = std::min(2 * stage().links, options_.max_links);
    if (links <= stage().links) return;
    std::vector<Explanation> others =
        best_with_links(looked.explanations, looked.effects, links, stage().added);
    const Explanation* best = nullptr;
    for (const Explanation& each : others)
      if (!best || squares(each.model) < squares(best->model)) best = &each;
    if (best && squares(best->model) < squares(stage().model) &&
        decide(best->model, stage().model, result_.floors).decided &&
        generalises(held_out_gap(best->model, result_.floors)))
      enter(best->model, with(looked.effects, best->id), best->id, stage().added);
  }

  /// Neither an effect nor more links may be worth anything alone: a damped pivot holds a whole
  /// link. Enters both if they are.
  bool add_with_more_links() {
    const Stage& looked = stage();
    const int links = std::min(2 * looked.links, options_.max_links);
    if (links <= looked.links) return false;
    std::vector<Explanation> explanations =
        best_with_links(looked.explanations, looked.effects, links, "");
    if (explanations.empty()) return false;
    FittedModel finer = refitted_with_links(looked.model, links, looked.effects, workshop_);
    workshop_.stop_if_asked();
    if (!finer.ok) return false;
    // The finer chain's own fit may be the worse one, where it ends in another minimum.
    const FittedModel& base = squares(finer) < squares(looked.model) ? finer : looked.model;
    for (Explanation& each : explanations) {
      each.comparison = compare(base, each.model, result_.floors);
      each.fit = fit_gap(each.model, result_.floors);
      each.held_out = held_out_gap(each.model, result_.floors);
    }
    enter(std::move(finer), looked.effects, kTooFewLinks);
    stage().explanations = std::move(explanations);
    const Explanation* best = choose(stage().explanations);
    if (!best) {
      result_.stages.pop_back();
      return false;
    }
    enter(trimmed(best->model), with(stage().effects, best->id), best->id);
    return true;
  }

  /// Two effects, and the models on the way to them.
  struct Pair {
    Explanation first, second;
    std::vector<Explanation> beside;  // the first
    FittedModel finer;                // the pair with more links, where that was tried

    const FittedModel& best() const { return finer.ok ? finer : second.model; }
  };

  /// Two effects at once: each of those that left least when no effect was there yet, and what is
  /// best beside it. Enters the best such pair if it leaves less than what there is (as the data
  /// decide, where that closes the gap), predicts what no fit has seen as well, and neither of the
  /// two is needless.
  bool add_pair() {
    if (options_.max_effects < 2) return false;
    std::vector<Pair> pairs = pairs_on(without_effects());
    const Pair* best = nullptr;
    for (const Pair& pair : pairs)
      if (!best || squares(pair.best()) < squares(best->best())) best = &pair;
    if (!best || squares(best->best()) >= squares(stage().model)) return false;
    if (explained() && !decide(best->best(), stage().model, result_.floors).decided) return false;
    if (!generalises(held_out_gap(best->best(), result_.floors))) return false;
    enter(best->first.model, {best->first.id}, best->first.id, listed(stage().effects));
    stage().explanations = best->beside;
    enter(trimmed(best->second.model), {best->first.id, best->second.id}, best->second.id);
    if (best->finer.ok) enter(best->finer, stage().effects, kTooFewLinks);
    result_.effects = stage().effects;
    return true;
  }

  /// The last stage without effects; one made for it where more links were taken since. (With too
  /// few links pairs are sought that imitate more of them.)
  Stage without_effects() {
    std::size_t bare = result_.stages.size() - 1;
    while (!result_.stages[bare].effects.empty()) --bare;
    if (result_.stages[bare].links >= stage().links) return result_.stages[bare];
    Stage finer;
    finer.links = stage().links;
    finer.model = refitted_with_links(result_.stages[bare].model, finer.links, {}, workshop_);
    if (!finer.model.ok) return result_.stages[bare];
    finer.explanations = look(finer.model, {});
    return finer;
  }

  /// The best pairs on a model without effects that chance does not explain, without those that
  /// were looked at already.
  std::vector<Pair> pairs_on(const Stage& base) {
    std::vector<Explanation> firsts;
    for (const Explanation& each : base.explanations)
      if (each.refitted && each.candidate >= 0 && each.comparison.misfit_share > kWorthwhile &&
          !looked_beside(each.id, base.links))
        firsts.push_back(each);
    std::stable_sort(firsts.begin(), firsts.end(), [&](const auto& a, const auto& b) {
      return squares(a.model) < squares(b.model);
    });
    firsts.resize(std::min<std::size_t>(firsts.size(), kFirstsOfPairs));
    std::vector<Pair> pairs;
    const double ways = std::pow(std::max(1, result_.tried), 2);
    for (const Explanation& first : firsts) {
      workshop_.say("scoring what may be missing beside " + first.id);
      Search search(workshop_, first.model, {first.id}, result_.floors);
      std::vector<Explanation> beside = search.score(false);
      search.refit_best(beside, kSecondsOfPairs, false);
      workshop_.stop_if_asked();
      for (const Explanation& second : beside) {
        if (!second.refitted || second.candidate < 0 ||
            second.comparison.misfit_share < kWorthwhile ||
            !predicts_as_well(second.held_out, first.held_out))
          continue;
        const Comparison both = compare(base.model, second.model, result_.floors);
        const bool known = std::any_of(pairs.begin(), pairs.end(), [&](const Pair& pair) {
          return pair.first.id == second.id && pair.second.id == first.id;
        });
        if (!known && both.criterion < 0 && both.log10_p + std::log10(ways) < kCertain)
          pairs.push_back({first, second, beside, {}});
      }
    }
    std::stable_sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) {
      return squares(a.second.model) < squares(b.second.model);
    });
    pairs.resize(std::min(pairs.size(), kTriedWithMoreLinks));
    const int links = std::min(2 * base.links, options_.max_links);
    const bool closed = !pairs.empty() && pairs.front().second.fit.ratio() <= kClosed;
    if (closed || links <= base.links) return pairs;
    in_parallel(pairs.size(), workshop_.threads, [&](std::size_t k) {
      Pair& pair = pairs[k];
      pair.finer =
          refitted_with_links(pair.second.model, links, {pair.first.id, pair.second.id}, workshop_);
    });
    workshop_.stop_if_asked();
    for (Pair& pair : pairs)
      if (pair.finer.ok && squares(pair.finer) >= squares(pair.second.model)) pair.finer = {};
    return pairs;
  }

  /// Whether something was sought beside that effect alone.
  bool looked_beside(const std::string& id, int links) {
    return std::any_of(result_.stages.begin(), result_.stages.end(), [&](const Stage& each) {
      return each.effects == std::vector<std::string>{id} && each.links == links &&
             !each.explanations.empty();
    });
  }

  /// The few effects that left least, but `except`, each added to `effects` and refitted with so
  /// many links; without those whose refit failed.
  std::vector<Explanation> best_with_links(const std::vector<Explanation>& explanations,
                                           const std::vector<std::string>& effects, int links,
                                           const std::string& except) {
    std::vector<Explanation> best;
    for (const Explanation& each : explanations)
      if (each.refitted && each.candidate >= 0 && each.id != except) best.push_back(each);
    std::stable_sort(best.begin(), best.end(), [&](const auto& a, const auto& b) {
      return squares(a.model) < squares(b.model);
    });
    best.resize(std::min<std::size_t>(best.size(), kTriedWithMoreLinks));
    in_parallel(best.size(), workshop_.threads, [&](std::size_t k) {
      best[k].model =
          refitted_with_links(best[k].model, links, with(effects, best[k].id), workshop_);
    });
    workshop_.stop_if_asked();
    std::erase_if(best, [](const Explanation& each) { return !each.model.ok; });
    return best;
  }

  static std::vector<std::string> with(std::vector<std::string> effects, const std::string& id) {
    effects.push_back(id);
    return effects;
  }

  double squares(const FittedModel& model) { return sum_of_squares(model, result_.floors); }

  /// More links may have taken what an effect explains better: with the effects in place, the
  /// number of links is the smaller one if that leaves less.
  void go_back_to_fewer_links() {
    for (std::size_t s = result_.stages.size(); s-- > 0;) {
      const int links = result_.stages[s].links;
      if (links >= stage().links) continue;
      FittedModel model = refitted_with_links(stage().model, links, stage().effects, workshop_);
      if (!model.ok || squares(model) >= squares(stage().model)) break;
      enter(std::move(model), stage().effects, "", kTooFewLinks);
    }
  }

  /// `all`: every admissible effect is refitted, not the most promising ones alone.
  std::vector<Explanation> look(const FittedModel& model, const std::vector<std::string>& effects,
                                bool all = false) {
    workshop_.say("scoring what may be missing");
    Search search(workshop_, model, effects, result_.floors);
    const int refits = far() ? options_.refits + 2 : options_.refits;
    std::vector<Explanation> explanations = search.score(false);
    search.refit_best(explanations, refits, far());
    workshop_.stop_if_asked();
    const auto closed = [&] {
      return std::any_of(explanations.begin(), explanations.end(), [](const auto& each) {
        return each.refitted && each.fit.ratio() < kClosed;
      });
    };
    // Far from the truth the score ranks wrongly: the others may be what is missing.
    if (all || (far() && !closed())) search.refit_rest(explanations);
    workshop_.stop_if_asked();
    // Effects that need a model of their own cost more: only if the others leave a gap.
    if (!closed()) {
      std::vector<Explanation> more = search.score(true);
      search.refit_best(more, 2, far());
      explanations.insert(explanations.end(), more.begin(), more.end());
      std::stable_sort(explanations.begin(), explanations.end(), [](const auto& a, const auto& b) {
        return a.score.removed > b.score.removed;
      });
    }
    workshop_.stop_if_asked();
    int tried = 0;
    for (const Explanation& each : explanations)
      tried += each.score.admissible || each.note.empty();
    result_.tried = std::max(result_.tried, tried);
    return explanations;
  }

  /// Beside a large effect, what its law gets slightly wrong leaves a trace that others fit a
  /// little.
  bool more_than_a_detail(const Comparison& comparison) {
    return comparison.misfit_removed >
           kDetail * std::pow(misfit_without_effects(result_.stages), 2);
  }

  /// Whether a model that leaves this predicts what no fit has seen as well as the present one.
  bool generalises(const GapTest& held_out) { return predicts_as_well(held_out, stage().held_out); }

  bool acceptable(const Explanation& explanation) {
    if (!explanation.refitted) return false;
    const Comparison& comparison = explanation.comparison;
    const double log10_p = comparison.log10_p + std::log10(std::max(1, result_.tried));
    return log10_p < kCertain && comparison.criterion < 0 &&
           comparison.misfit_share > kWorthwhile && generalises(explanation.held_out) &&
           more_than_a_detail(comparison);
  }

  /// The explanation to add: the one that leaves least, unless the data do not decide against
  /// something simpler: one of fewer unknowns (a freer start is one of many), or an effect inside
  /// the other.
  const Explanation* choose(const std::vector<Explanation>& explanations) {
    const auto worth = [&](const Explanation& explanation) {
      return sum_of_squares(explanation.model, result_.floors) +
             std::log(static_cast<double>(std::max(2L, explanation.fit.count))) *
                 explanation.comparison.added;
    };
    const Explanation* best = nullptr;
    for (const Explanation& explanation : explanations)
      if (acceptable(explanation) && (!best || worth(explanation) < worth(*best)))
        best = &explanation;
    if (!best) return best;
    const Explanation* simplest = best;
    for (const Explanation& explanation : explanations) {
      if (!acceptable(explanation) || &explanation == best || !simpler(explanation, *best) ||
          decide(best->model, explanation.model, result_.floors).decided)
        continue;
      if (simplest == best || worth(explanation) < worth(*simplest)) simplest = &explanation;
    }
    return simplest;
  }

  bool simpler(const Explanation& a, const Explanation& b) {
    if (a.comparison.added != b.comparison.added) return a.comparison.added < b.comparison.added;
    return a.candidate >= 0 && b.candidate >= 0 &&
           is_special_case(*workshop_.find(a.id), *workshop_.find(b.id),
                           workshop_.model_with_all(stage().links));
  }

  /// Amplitudes that the data do not need are put back to their neutral values.
  FittedModel trimmed(const FittedModel& model) { return trim(model, result_.floors, workshop_); }

  /// With all effects in place: is each still needed, and could another stand in its place?
  /// Whether anything was changed.
  bool look_back() {
    forget_alternatives();
    bool changed = false;
    int swaps = 0;
    for (std::size_t i = 0; i < result_.effects.size();) {
      workshop_.stop_if_asked();
      const std::string id = result_.effects[i];
      std::vector<std::string> others = result_.effects;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      const Stage* looked = stage_before(id, others);
      Stage fresh;
      if (!looked) {
        workshop_.say("looking back at " + id);
        fresh = stage_without(id, others);
        looked = &fresh;
      }
      if (!looked->model.problem) {
        ++i;
        continue;
      }
      if (needless(*looked)) {
        enter(looked->model, others, "", id);
      } else {
        const std::string better = weigh_alternatives(id, *looked);
        if (better.empty()) {
          ++i;
          continue;
        }
        others.push_back(better);
        ++swaps;
      }
      changed = true;
      result_.effects = others;
      forget_alternatives();
      if (swaps > kMostSwaps) break;
      i = 0;
    }
    return changed;
  }

  void forget_alternatives() {
    result_.alternatives.clear();
    result_.forms.clear();
    result_.runners_up.clear();
  }

  /// A stage at which `id` was added to exactly `others`, with the present number of links.
  const Stage* stage_before(const std::string& id, const std::vector<std::string>& others) {
    for (std::size_t s = 0; s + 1 < result_.stages.size(); ++s)
      if (result_.stages[s].effects == others && result_.stages[s + 1].added == id &&
          result_.stages[s].links == stage().links && !result_.stages[s].explanations.empty() &&
          s + 2 == result_.stages.size())
        return &result_.stages[s];
    return nullptr;
  }

  Stage stage_without(const std::string& id, const std::vector<std::string>& others) {
    Stage without;
    const Case the_case = without_effect(stage().model.problem->the_case(), id);
    const auto problem =
        std::make_shared<const Problem>(the_case, workshop_.model_with(others, the_case.links));
    without.model = fit_model(problem, transfer(*stage().model.problem, stage().model.x, *problem),
                              workshop_.least_squares, workshop_.stop);
    if (!without.model.ok) return {};
    without.effects = others;
    without.links = the_case.links;
    without.fit = fit_gap(without.model, result_.floors);
    without.held_out = held_out_gap(without.model, result_.floors);
    // Something that nearly fits may stand in the place of the right one.
    const bool nearly = gap_left(stage()) && stage().fit.ratio() <= kClosed;
    if (!needless(without)) without.explanations = look(without.model, others, nearly);
    return without;
  }

  /// An effect is needless if the model without it leaves no more gap than the model with it, or
  /// predicts better what no fit has seen: with others in place it may fit what is not its own.
  bool needless(const Stage& without) {
    if (!without.fit.present || !predicts_as_well(stage().held_out, without.held_out)) return true;
    const Comparison gain = compare(without.model, stage().model, result_.floors);
    return gain.log10_p + std::log10(std::max(1, result_.tried)) > kCertain ||
           gain.misfit_share < kWorthwhile || !more_than_a_detail(gain);
  }

  /// Sorts the explanations that could stand in the place of `id` into undecided ones and
  /// runners-up. Returns the id of the one that has a better claim to the name, after entering its
  /// model; else nothing.
  std::string weigh_alternatives(const std::string& id, const Stage& without) {
    const Candidate& named = *workshop_.find(id);
    const double squares = sum_of_squares(stage().model, result_.floors);
    const Explanation* successor = nullptr;
    for (const Explanation& explanation : without.explanations) {
      if (!explanation.refitted || explanation.id == id) continue;
      const double its_squares = sum_of_squares(explanation.model, result_.floors);
      const bool better = its_squares < squares;
      const FittedModel& first = better ? explanation.model : stage().model;
      const FittedModel& second = better ? stage().model : explanation.model;
      const Decision decision = decide(first, second, result_.floors);
      const Candidate* effect =
          explanation.candidate < 0 ? nullptr : workshop_.find(explanation.id);
      if (effect && better && decision.decided && generalises(explanation.held_out) &&
          (!successor || its_squares < sum_of_squares(successor->model, result_.floors)))
        successor = &explanation;
      // Of two that explain the same, one inside the other, the smaller has the name; of two laws
      // of one effect, the one that the other is declared a form of.
      const Model all = workshop_.model_with_all(stage().links);
      if (effect && !successor && !decision.decided && acceptable(explanation) &&
          (named.effect.form_of == effect->id || is_special_case(*effect, named, all)))
        successor = &explanation;
      const bool contains = effect && is_special_case(named, *effect, all);
      const bool form = effect && effect->effect.form_of == id;
      (decision.decided || contains ? result_.runners_up
       : form                       ? result_.forms
                                    : result_.alternatives)
          .push_back({id, explanation, decision});
    }
    if (!successor) return {};
    std::vector<std::string> effects = without.effects;
    effects.push_back(successor->id);
    enter(trimmed(successor->model), effects, successor->id, id);
    return result_.stages.back().added;
  }

  Workshop& workshop_;
  const DiagnosisOptions& options_;
  Diagnosis result_;
};

}  // namespace

Diagnosis diagnose(Case the_case, Workshop& workshop, const DiagnosisOptions& options) {
  return Physician(workshop, options).examine(std::move(the_case));
}

}  // namespace catena
