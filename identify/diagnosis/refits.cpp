// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/refits.hpp"

#include <algorithm>
#include <cmath>

#include "common/parallel.hpp"
#include "common/special_values.hpp"
#include "identify/diagnosis/refit_limits.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/variant.hpp"

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kSmallerStart = 0.25;                   // of the amplitudes that the score says
constexpr double kOtherAmplitudes[] = {3.0, 1.0 / 3.0};  // times the amplitudes found

const Candidate& candidate_of(const CandidateSearch& search, const Explanation& explanation) {
  return search.context.library()[static_cast<std::size_t>(explanation.candidate)];
}

/// `x` with the candidate's amplitudes times a factor, all its parameters within their bounds.
VectorXd scaled(const Candidate& candidate, const Problem& problem, VectorXd x, double factor) {
  for (const CandidateParameter& parameter : candidate.parameters) {
    const Index j = unknown_index(problem, parameter.name);
    if (j < 0) continue;
    if (parameter.role == ParameterRole::kAmplitude)
      x[j] = parameter.neutral + factor * (x[j] - parameter.neutral);
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    x[j] = std::clamp(x[j], unknown.least, unknown.most);
  }
  return x;
}

/// What one search and its refits share.
struct Refits {
  const CandidateSearch& search;
  double squares;  ///< that the base leaves
  RefitLimits limits;

  explicit Refits(const CandidateSearch& of)
      : search(of), squares(sum_of_squares(of.base, of.noise)), limits(of.base, of.noise) {}

  LeastSquares least_squares() const { return limits.within(search.context.least_squares); }

  /// What a refit removed beyond what the score promised, in noise levels squared.
  double beyond_promise(const Explanation& explanation) const {
    return squares - sum_of_squares(explanation.model, search.noise) - explanation.score.removed;
  }

  /// Whether a refit removed what the score promised, and no more than twice that: the linearised model is right, so
  /// that no other start is tried.
  bool kept_promise(const Explanation& explanation) const {
    if (!explanation.refitted) return false;
    const double beyond = beyond_promise(explanation);
    return beyond >= 0 && beyond <= explanation.score.removed;
  }

  /// Of some starts the one that leaves least; the first where no simulation succeeds.
  const VectorXd& best(const Problem& problem, const std::vector<VectorXd>& starts) const {
    const VectorXd* best = &starts.front();
    double least = kInfinite;
    for (const VectorXd& start : starts) {
      long steps = 0;
      const double error = error_to_fit(problem, start, search.noise,
                                        [&](double) { return ++steps <= limits.most_steps; });
      if (error >= least) continue;
      least = error;
      best = &start;
    }
    return *best;
  }
};

/// Fits from a start; the explanation keeps the result if it is the best so far.
void fit_from(const Refits& refits, Explanation& explanation,
              const std::shared_ptr<const Problem>& problem, const VectorXd& start) {
  const CandidateSearch& search = refits.search;
  DiagnosisContext& context = search.context;
  if (context.stopped()) return;
  FittedModel model = fit_model(problem, start, search.noise, refits.least_squares(), context.stop);
  if (!model.ok || (explanation.refitted && sum_of_squares(model, search.noise) >=
                                                sum_of_squares(explanation.model, search.noise)))
    return;
  explanation.refitted = true;
  explanation.comparison = compare(search.base, model, search.noise);
  explanation.fit = fit_gap(model, search.noise);
  explanation.held_out = held_out_gap(model, search.noise);
  explanation.model = std::move(model);
}

void refit_start(const Refits& refits, Explanation& explanation) {
  const CandidateSearch& search = refits.search;
  const auto freer = search.with_free_start();
  if (!freer) return;
  const auto problem = std::make_shared<const Problem>(*freer, search.base.problem->model());
  fit_from(refits, explanation, problem, transfer(*search.base.problem, search.base.x, *problem));
}

void refit_effect(const Refits& refits, Explanation& explanation, bool far) {
  const CandidateSearch& search = refits.search;
  const Candidate& candidate = candidate_of(search, explanation);
  const auto problem = search.problem_with(candidate);
  // The effect with a share of its amplitudes, beside the base as the linearised fit has it then, or as
  // it is: what promises less.
  const auto with_effect = [&](const RefitStart& start, const VectorXd& base, double share) {
    VectorXd x = transfer(*search.base.problem, base, *problem);
    for (const auto& [name, value] : start.of_effect)
      if (const Index j = unknown_index(*problem, name); j >= 0) x[j] = value;
    return scaled(candidate, *problem, x, share);
  };
  const auto fit = [&](const RefitStart& start, double share) {
    const VectorXd& base = search.base.x;
    std::vector<VectorXd> starts = {with_effect(start, base, share), with_effect(start, base, 0)};
    if (start.of_base.size() > 0)
      starts.push_back(with_effect(start, base + share * (start.of_base - base), share));
    fit_from(refits, explanation, problem, refits.best(*problem, starts));
  };
  fit(explanation.start, 1);
  if (!far || refits.kept_promise(explanation)) return;
  if (candidate.own_model) return;  // which is expensive enough once
  fit(explanation.start, kSmallerStart);
  if (explanation.other_start.given()) fit(explanation.other_start, 1);
}

void refit(const Refits& refits, Explanation& explanation, bool far) {
  if (explanation.is_effect())
    refit_effect(refits, explanation, far);
  else
    refit_start(refits, explanation);
  if (!explanation.refitted) explanation.note = "the refit failed";
}

void refit_from_elsewhere(const Refits& refits, Explanation& explanation) {
  const Candidate& candidate = candidate_of(refits.search, explanation);
  const std::shared_ptr<const Problem> problem = explanation.model.problem;
  const VectorXd x = explanation.model.x;
  for (const double factor : kOtherAmplitudes)
    fit_from(refits, explanation, problem, scaled(candidate, *problem, x, factor));
}

void refit_all(const CandidateSearch& search, std::vector<Explanation*> chosen, bool far) {
  DiagnosisContext& context = search.context;
  if (chosen.empty()) return;
  const Refits refits(search);
  context.begin("refitting", chosen.size());
  in_parallel(chosen.size(), context.threads, [&](std::size_t i) {
    context.begin_task("refitting with " + chosen[i]->id);
    refit(refits, *chosen[i], far);
    context.end_task();
  });
  // What holds and slips, or is large, has more than one minimum. Of those that still leave a gap, those are tried
  // from elsewhere of which the linearised model was most wrong.
  std::erase_if(chosen, [&](const Explanation* each) {
    return !each->refitted || !each->is_effect() || !each->fit.present ||
           candidate_of(search, *each).own_model || refits.kept_promise(*each);
  });
  std::stable_sort(chosen.begin(), chosen.end(), [&](const Explanation* a, const Explanation* b) {
    return std::abs(refits.beyond_promise(*a)) > std::abs(refits.beyond_promise(*b));
  });
  chosen.resize(std::min(chosen.size(), kThresholds.tried_elsewhere));
  if (chosen.empty()) return;
  context.begin("refitting from elsewhere", chosen.size());
  in_parallel(chosen.size(), context.threads, [&](std::size_t i) {
    refit_from_elsewhere(refits, *chosen[i]);
    context.end_task();
  });
}

}  // namespace

void refit_best(const CandidateSearch& search, std::vector<Explanation>& explanations, int count,
                bool far) {
  std::vector<Explanation*> chosen;
  double best = 0;
  for (Explanation& explanation : explanations) {
    if (!explanation.score.admissible || explanation.refitted) continue;
    best = std::max(best, explanation.score.removed);
    if (static_cast<int>(chosen.size()) < count &&
        explanation.score.removed > kThresholds.refit_score * best &&
        explanation.log10_p < kThresholds.refit_log10_p)
      chosen.push_back(&explanation);
  }
  refit_all(search, std::move(chosen), far);
}

void refit_rest(const CandidateSearch& search, std::vector<Explanation>& explanations) {
  std::vector<Explanation*> chosen;
  for (Explanation& explanation : explanations)
    if (explanation.score.admissible && !explanation.refitted) chosen.push_back(&explanation);
  refit_all(search, std::move(chosen), false);
}

}  // namespace catena
