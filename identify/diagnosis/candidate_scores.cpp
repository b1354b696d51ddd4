// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/candidate_scores.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "common/parallel.hpp"
#include "identify/diagnosis/residual_frequencies.hpp"
#include "identify/diagnosis/same_model.hpp"
#include "identify/diagnosis/stacking.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/fit/error.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kNotNeighbours = 0.2;  // relative distance of two shapes that are not neighbours
constexpr std::size_t kMostBoundedTogether = 8;  // all subsets of so many columns are tried
constexpr double kMovesTheData = 0.33;           // of the noise: a step large enough for a slope

constexpr const char* kOtherWayRound = "would have to act the other way round";

/// One point of a candidate's grid of shapes.
struct ScoredStart {
  Score score;
  std::vector<int> columns;
  RefitStart start;  // of the effect
  VectorXd shape;
  VectorXd moves;  // the residuals, linearised
};

/// The start of the best score, and as another one the best whose shape is not next to that; each with
/// the base `beside` what it moves.
void take_best(Explanation& explanation, std::vector<ScoredStart>& scores,
               const std::function<VectorXd(const VectorXd& moves)>& beside) {
  std::stable_sort(scores.begin(), scores.end(), [](const ScoredStart& a, const ScoredStart& b) {
    return a.score.removed > b.score.removed;
  });
  if (scores.empty()) return;
  const ScoredStart& best = scores.front();
  explanation.score = best.score;
  explanation.start = {best.start.of_effect, beside(best.moves)};
  for (const ScoredStart& other : scores)
    if (!explanation.other_start.given() && other.shape.size() > 0 &&
        (other.shape - best.shape).norm() > kNotNeighbours * best.shape.norm())
      explanation.other_start = {other.start.of_effect, beside(other.moves)};
}

const CandidateParameter& parameter(const Candidate& candidate, int index) {
  return candidate.parameters[static_cast<std::size_t>(index)];
}

/// Calls `visit` with the columns of two amplitudes of which the first does not exceed the second. Amplitudes
/// with phases stand in no order.
template <class Visit>
void for_each_order(const Candidate& candidate, const std::vector<int>& amplitudes,
                    const Visit& visit) {
  if (!candidate.with_role(ParameterRole::kPhase).empty()) return;
  for (std::size_t a = 0; a < amplitudes.size(); ++a)
    for (std::size_t b = 0; b < amplitudes.size(); ++b)
      if (parameter(candidate, amplitudes[a]).at_most == amplitudes[b])
        visit(static_cast<Index>(a), static_cast<Index>(b));
}

/// The score of a candidate at one shape, from its derivatives at phase zero and, if it has phases,
/// at a quarter of a turn. Of two amplitudes of which one does not exceed the other, the greater one counts by
/// how much it is greater: so each has bounds of its own.
ScoredStart scored_at(ScoreTest& test, const Candidate& candidate, MatrixXd at_zero,
                      const MatrixXd* at_quarter, const VectorXd& shape) {
  const std::vector<int> amplitudes = candidate.with_role(ParameterRole::kAmplitude);
  for_each_order(candidate, amplitudes,
                 [&](Index lesser, Index greater) { at_zero.col(lesser) += at_zero.col(greater); });
  ScoredStart scored;
  scored.shape = shape;
  for (std::size_t a = 0; a < amplitudes.size(); ++a) {
    const CandidateParameter& p = parameter(candidate, amplitudes[a]);
    // What has a prior needs no bounds, and there may be many of those.
    constexpr double kInfinite = std::numeric_limits<double>::infinity();
    const bool bounded = std::isnan(p.deviation);
    const double low = bounded ? p.lower - p.neutral : -kInfinite;
    const double high = bounded ? p.upper - p.neutral : kInfinite;
    scored.columns.push_back(test.add({at_zero.col(static_cast<Index>(a)), low, high}));
    if (at_quarter)
      scored.columns.push_back(test.add({at_quarter->col(static_cast<Index>(a)), low, high}));
  }
  scored.score = test.score(scored.columns);
  if (!scored.score.admissible) return scored;
  VectorXd value = scored.score.estimate;  // of each amplitude, less its neutral value
  for_each_order(candidate, amplitudes,
                 [&](Index lesser, Index greater) { value[greater] += value[lesser]; });
  const VectorXd& estimate = scored.score.estimate;
  scored.moves = VectorXd::Zero(at_zero.rows());
  for (std::size_t a = 0; a < amplitudes.size(); ++a) {
    const CandidateParameter& p = parameter(candidate, amplitudes[a]);
    const auto column = static_cast<Index>(a);
    if (!at_quarter) {
      scored.start.of_effect.emplace_back(p.name, p.neutral + value[column]);
      scored.moves += estimate[column] * at_zero.col(column);
      continue;
    }
    // a sin(w t) + b cos(w t) = sqrt(a^2 + b^2) sin(w t + atan2(b, a))
    const double sine = estimate[2 * column];
    const double cosine = estimate[2 * column + 1];
    scored.moves += sine * at_zero.col(column) + cosine * at_quarter->col(column);
    scored.start.of_effect.emplace_back(p.name, p.neutral + std::hypot(sine, cosine));
    for (const int q : candidate.with_role(ParameterRole::kPhase))
      if (parameter(candidate, q).amplitude == amplitudes[a])
        scored.start.of_effect.emplace_back(parameter(candidate, q).name, std::atan2(cosine, sine));
  }
  const std::vector<int> shapes = candidate.with_role(ParameterRole::kShape);
  for (std::size_t s = 0; s < shapes.size(); ++s)
    scored.start.of_effect.emplace_back(parameter(candidate, shapes[s]).name,
                                        shape[static_cast<Index>(s)]);
  return scored;
}

}  // namespace

CandidateScores::CandidateScores(const CandidateSearch& search) : search_(search) {
  DiagnosisContext& context = search.context;
  std::vector<Candidate> others;
  for (const Candidate& candidate : context.library())
    if (candidate.unavailable.empty() && !candidate.own_model && !search.in_base(candidate.id))
      others.push_back(candidate);
  std::vector<std::string> own_models_in_base;
  for (const std::string& id : search.effects)
    if (context.find(id)->own_model) own_models_in_base.push_back(id);
  const Case& the_case = search.base.problem->the_case();
  all_ = std::make_shared<const Problem>(
      with_effects(search.with_free_start().value_or(the_case), others, true),
      context.model_with_all(the_case.links, own_models_in_base));
  x_ = transfer(*search.base.problem, search.base.x, *all_);
  frequencies_ = driving_frequencies(search.base, levels(search.noise));
  same_ = names_of_same_models(context.library(), context.model_with_all(the_case.links));
}

bool CandidateScores::is_asked(const Candidate& candidate, bool own_models) const {
  return !search_.in_base(candidate.id) && candidate.own_model == own_models;
}

CandidateScores::Plan CandidateScores::plan(bool own_models) const {
  // The common run has everything with a slope at the base: what is fitted, a freer start, and the
  // amplitudes of the effects without a shape.
  Plan plan;
  std::vector<Index> fitted, start;
  for (std::size_t j = 0; j < all_->unknowns().size(); ++j) {
    const Unknown& unknown = all_->unknowns()[j];
    if (unknown_index(*search_.base.problem, unknown.name) >= 0)
      fitted.push_back(static_cast<Index>(j));
    else if (unknown.group == Unknown::Group::kInitial && !own_models)
      start.push_back(static_cast<Index>(j));
  }
  plan.fitted = static_cast<Index>(fitted.size());
  plan.start = static_cast<Index>(start.size());
  plan.runs.push_back({all_, x_, fitted, {}, {}});
  std::vector<Index>& common = plan.runs.front().unknowns;
  common.insert(common.end(), start.begin(), start.end());
  const std::vector<Candidate>& library = search_.context.library();
  plan.places.resize(library.size());
  for (std::size_t i = 0; i < library.size(); ++i)
    if (is_asked(library[i], own_models) && library[i].unavailable.empty() &&
        !same_.contains(library[i].id))
      add_runs_of(library[i], plan, plan.places[i]);
  return plan;
}

void CandidateScores::add_runs_of(const Candidate& candidate, Plan& plan, Place& place) const {
  const std::vector<int> amplitudes = candidate.with_role(ParameterRole::kAmplitude);
  if (amplitudes.empty()) return;  // a limit: see score_limit
  const auto problem = candidate.own_model ? search_.problem_with(candidate) : all_;
  const auto unknown_of = [&](int p) {
    return unknown_index(*problem, parameter(candidate, p).name);
  };
  std::vector<Index> own;
  for (const int p : amplitudes) own.push_back(unknown_of(p));
  const std::vector<int> shapes = candidate.with_role(ParameterRole::kShape);
  const std::vector<int> phases = candidate.with_role(ParameterRole::kPhase);
  if (shapes.empty() && phases.empty() && !candidate.own_model) {
    std::vector<Index>& common = plan.runs.front().unknowns;
    place.column = static_cast<Index>(common.size());
    common.insert(common.end(), own.begin(), own.end());
    return;
  }
  const VectorXd x =
      candidate.own_model ? transfer(*search_.base.problem, search_.base.x, *problem) : x_;
  place.run = plan.runs.size();
  for (const VectorXd& shape : shape_grid(candidate, frequencies_))
    for (const double phase : {0.0, std::numbers::pi / 2}) {
      if (phase > 0 && phases.empty()) continue;
      Run run{problem, x, own, shape, {}};
      for (std::size_t s = 0; s < shapes.size(); ++s)
        run.x[unknown_of(shapes[s])] = shape[static_cast<Index>(s)];
      for (const int p : phases) run.x[unknown_of(p)] = phase;
      plan.runs.push_back(std::move(run));
    }
  place.runs = plan.runs.size() - place.run;
}

MatrixXd CandidateScores::columns(const Run& run) const {
  const Problem& problem = *run.problem;
  std::vector<std::vector<MatrixXd>> derivatives(run.unknowns.size());
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const int index = static_cast<int>(e);
    if (!problem.experiments()[e].fitted()) {
      for (auto& derivative : derivatives) derivative.emplace_back();
      continue;
    }
    const std::vector<SensitivityDirection> every = problem.directions(run.x, index);
    std::vector<SensitivityDirection> along;
    for (const Index j : run.unknowns) along.push_back(every[static_cast<std::size_t>(j)]);
    Prediction prediction = problem.predict(run.x, index, false, along);
    if (!prediction.ok())
      throw std::runtime_error("the model with every effect cannot be simulated at the fit: " +
                               prediction.message);
    for (std::size_t j = 0; j < run.unknowns.size(); ++j)
      derivatives[j].push_back(std::move(prediction.sensitivity[j]));
  }
  MatrixXd result;
  for (std::size_t j = 0; j < run.unknowns.size(); ++j) {
    const VectorXd column = stacked(derivatives[j], search_.base.fit_residual, search_.noise);
    if (result.size() == 0) result.resize(column.size(), static_cast<Index>(run.unknowns.size()));
    result.col(static_cast<Index>(j)) = column;
  }
  return result;
}

std::vector<Explanation> CandidateScores::score(bool own_models) {
  DiagnosisContext& context = search_.context;
  context.begin("scoring what may be missing");
  Plan plan = this->plan(own_models);
  context.begin("scoring what may be missing", plan.runs.size());
  in_parallel(plan.runs.size(), context.threads, [&](std::size_t r) {
    if (context.stopped()) return;
    plan.runs[r].columns = columns(plan.runs[r]);
    context.end_task();
  });
  context.stop_if_asked();  // runs that were left out have no columns

  const MatrixXd& common = plan.runs.front().columns;
  if (!test_) begin_test(common.leftCols(plan.fitted));
  std::vector<Explanation> found;
  score_start(common.middleCols(plan.fitted, plan.start), found);
  for (std::size_t i = 0; i < context.library().size(); ++i)
    if (is_asked(context.library()[i], own_models)) found.push_back(score_candidate(plan, i));
  std::stable_sort(found.begin(), found.end(), [](const Explanation& a, const Explanation& b) {
    return a.score.removed > b.score.removed;
  });
  return found;
}

void CandidateScores::begin_test(const MatrixXd& jacobian) {
  const FittedModel& base = search_.base;
  const VectorXd residual = stacked(base.fit_residual, base.fit_residual, search_.noise);
  test_ = std::make_unique<ScoreTest>(residual, jacobian);

  const std::vector<Prior> priors = priors_of(*base.problem);
  const Index seen = residual.size(), rows = seen + static_cast<Index>(priors.size());
  left_ = VectorXd::Zero(rows);
  left_.head(seen) = residual;
  MatrixXd along = MatrixXd::Zero(rows, base.x.size());
  Index column = 0;  // as plan() has them
  for (const Unknown& unknown : all_->unknowns())
    if (const Index j = unknown_index(*base.problem, unknown.name); j >= 0)
      along.col(j).head(seen) = jacobian.col(column++);
  for (std::size_t p = 0; p < priors.size(); ++p) {
    const Prior& prior = priors[p];
    const Index row = seen + static_cast<Index>(p);
    left_[row] = (base.x[prior.unknown] - prior.measured) / prior.deviation;
    along(row, prior.unknown) = 1 / prior.deviation;
  }
  fit_.emplace(*base.problem, base.x, along);
}

VectorXd CandidateScores::base_beside(const VectorXd& moves) const {
  VectorXd error = -left_;
  error.head(moves.size()) -= moves;
  return search_.base.x + (*fit_)(error);
}

void CandidateScores::score_start(const MatrixXd& derivatives, std::vector<Explanation>& out) {
  if (derivatives.cols() == 0) return;
  Explanation rival;
  rival.id = kStartShape;
  rival.title = "A start that bends more, or moves";
  std::vector<int> columns;
  for (Index j = 0; j < derivatives.cols(); ++j)
    columns.push_back(test_->add({derivatives.col(j), -std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::infinity()}));
  tried_[rival.id].push_back(columns);
  rival.score = test_->score(columns);
  if (rival.score.admissible) rival.log10_p = significance(columns, rival.score);
  out.push_back(std::move(rival));
}

Explanation CandidateScores::score_candidate(const Plan& plan, std::size_t index) {
  const Candidate& candidate = search_.context.library()[index];
  const Place& place = plan.places[index];
  Explanation explanation;
  explanation.id = candidate.id;
  explanation.title = candidate.title;
  explanation.candidate = static_cast<int>(index);
  explanation.note = candidate.unavailable;
  if (const auto same = same_.find(candidate.id); same != same_.end())
    explanation.note = "the same model as " + same->second + " here";
  if (!explanation.note.empty()) return explanation;
  const std::vector<int> amplitudes = candidate.with_role(ParameterRole::kAmplitude);
  if (amplitudes.empty()) {
    score_limit(candidate, explanation);
    return explanation;
  }
  std::vector<ScoredStart> scores;
  const auto consider = [&](const MatrixXd& at_zero, const MatrixXd* at_quarter,
                            const VectorXd& shape) {
    ScoredStart scored = scored_at(*test_, candidate, at_zero, at_quarter, shape);
    tried_[candidate.id].push_back(scored.columns);
    if (scored.score.admissible) scores.push_back(std::move(scored));
  };
  if (place.column >= 0) {
    const auto count = static_cast<Index>(amplitudes.size());
    consider(plan.runs.front().columns.middleCols(place.column, count), nullptr, {});
  } else {
    const bool with_phase = !candidate.with_role(ParameterRole::kPhase).empty();
    for (std::size_t r = place.run; r < place.run + place.runs; r += with_phase ? 2 : 1)
      consider(plan.runs[r].columns, with_phase ? &plan.runs[r + 1].columns : nullptr,
               plan.runs[r].shape);
  }
  take_best(explanation, scores, [&](const VectorXd& moves) { return base_beside(moves); });
  // What would act the other way round alone may be there beside something else.
  best_columns_[candidate.id] =
      scores.empty() ? tried_[candidate.id].front() : scores.front().columns;
  if (explanation.score.admissible)
    explanation.log10_p = significance(scores.front().columns, explanation.score);
  else
    explanation.note = kOtherWayRound;
  return explanation;
}

std::vector<std::string> CandidateScores::best_together() const {
  struct Together {
    double removed;
    std::vector<std::string> effects;
  };
  std::vector<Together> pairs, triples;
  const auto consider = [&](std::vector<Together>& sets, const std::vector<std::string>& effects) {
    std::vector<int> columns;
    for (const std::string& id : effects) {
      const std::vector<int>& of_effect = best_columns_.at(id);
      columns.insert(columns.end(), of_effect.begin(), of_effect.end());
    }
    if (columns.size() <= kMostBoundedTogether)
      sets.push_back({test_->score(columns).removed, effects});
  };
  for (auto a = best_columns_.begin(); a != best_columns_.end(); ++a)
    for (auto b = std::next(a); b != best_columns_.end(); ++b) {
      search_.context.stop_if_asked();
      consider(pairs, {a->first, b->first});
      for (auto c = std::next(b); c != best_columns_.end(); ++c)
        consider(triples, {a->first, b->first, c->first});
    }
  std::vector<std::string> members;
  const auto add_best_of = [&](std::vector<Together>& sets) {
    std::stable_sort(sets.begin(), sets.end(),
                     [](const Together& a, const Together& b) { return a.removed > b.removed; });
    for (std::size_t s = 0; s < std::min(sets.size(), kThresholds.firsts_of_pairs); ++s)
      for (const std::string& id : sets[s].effects)
        if (std::find(members.begin(), members.end(), id) == members.end()) members.push_back(id);
  };
  add_best_of(pairs);
  add_best_of(triples);
  return members;
}

void CandidateScores::score_limit(const Candidate& candidate, Explanation& explanation) {
  const auto limits = candidate.with_role(ParameterRole::kLimit);
  if (limits.size() != 1) {
    explanation.note = "not one parameter whose limit is the plain model";
    return;
  }
  const FittedModel& base = search_.base;
  const CandidateParameter& limit = parameter(candidate, limits[0]);
  const auto shared = search_.problem_with(candidate);
  const Problem& problem = *shared;
  VectorXd x = transfer(*base.problem, base.x, problem);
  const Index unknown = unknown_index(problem, limit.name);
  // The slope by 1/value, from the first value that moves the trajectory by a third of the noise.
  for (double value = 1e6; value > std::max(limit.lower, 1.0); value /= 10) {
    x[unknown] = value;
    std::vector<MatrixXd> difference(problem.experiments().size());
    bool ok = true;
    for (std::size_t e = 0; e < difference.size(); ++e) {
      if (base.fit_residual[e].cols() == 0) continue;
      const Prediction prediction = problem.predict(x, static_cast<int>(e), false);
      ok = ok && prediction.ok();
      if (ok)
        difference[e] =
            prediction.simulated - base.predicted[e].leftCols(base.fit_residual[e].cols());
    }
    if (!ok) continue;
    VectorXd column = stacked(difference, base.fit_residual, search_.noise);
    if (column.norm() < kMovesTheData * std::sqrt(static_cast<double>(column.size()))) continue;
    column *= value;
    const std::vector<int> columns = {test_->add({column, 0.0, 1 / std::max(limit.lower, 1e-3)})};
    tried_[candidate.id].push_back(columns);
    explanation.score = test_->score(columns);
    if (explanation.score.admissible) {
      explanation.log10_p = significance(columns, explanation.score);
      const double estimate = explanation.score.estimate[0];
      explanation.start = {{{limit.name, 1 / estimate}}, base_beside(estimate * column)};
    }
    break;
  }
  if (!explanation.score.admissible) explanation.note = kOtherWayRound;
}

double CandidateScores::significance(const std::vector<int>& columns, const Score& score) const {
  const VectorXd rest = test_->residual_after(columns, score.estimate);
  // Back into channels x frames, for the correlations of what would be left.
  const std::vector<MatrixXd> left = unstacked(rest, white_residuals(search_.base, search_.noise));
  const double variance =
      std::max(1.0, rest.squaredNorm() / static_cast<double>(std::max<Index>(1, rest.size())));
  return log10_chi_square_tail(score.removed / (variance * autocorrelation_factor(left)),
                               static_cast<int>(columns.size()));
}

void CandidateScores::set_chances(std::vector<Explanation>& explanations) const {
  std::vector<Explanation*> judged;
  for (Explanation& each : explanations)
    if (each.refitted && each.comparison.misfit_share > kThresholds.worthwhile)
      judged.push_back(&each);
  if (judged.empty()) return;
  const auto left = [&](const Explanation* each) {
    return white_residuals(each->model, search_.noise);
  };
  const auto best = std::min_element(
      judged.begin(), judged.end(), [&](const Explanation* a, const Explanation* b) {
        return sum_of_squares(a->model, search_.noise) < sum_of_squares(b->model, search_.noise);
      });
  DiagnosisContext& context = search_.context;
  context.begin("asking what chance would explain");
  const MaximumStatistic statistic(*test_, tried_, left(*best), context.threads,
                                   [&] { context.stop_if_asked(); });
  const std::vector<MatrixXd> before = white_residuals(search_.base, search_.noise);
  for (Explanation* each : judged) each->chance = statistic.chance(each->id, before, left(each));
}

}  // namespace catena
