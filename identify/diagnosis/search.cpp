// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/search.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/parallel.hpp"
#include "identify/diagnosis/variant.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kMoreTerms = 4;             // of the start's shape, tried as a rival
constexpr int kRateTerms = 3;             // of its velocity
constexpr int kLines = 8;                 // frequencies where the residuals are strongest
constexpr int kFrequencies = 24;          // and others, evenly spaced
constexpr double kHighestFrequency = 12;  // Hz
constexpr std::size_t kTriedElsewhere = 3;

double angle_of_frequency(double frequency, double t) {
  return 2 * std::numbers::pi * frequency * t;
}

struct Sampling {
  double duration = 0, rate = 0;  // s, 1/s
  double highest() const { return std::min(rate / 4, kHighestFrequency); }
};

/// Of the longest fitted part.
Sampling longest_sampling(const FittedModel& model) {
  Sampling longest;
  for (std::size_t e = 0; e < model.fit_residual.size(); ++e) {
    const Index frames = model.fit_residual[e].cols();
    if (frames < 8) continue;
    const auto& time = model.problem->experiments()[e].recording.time;
    const double span = time[static_cast<std::size_t>(frames - 1)] - time.front();
    if (span <= longest.duration) continue;
    longest.duration = span;
    longest.rate = static_cast<double>(frames - 1) / span;
  }
  return longest;
}

/// Where a driven motion is looked for: at the strongest lines of the residuals, and, since what a
/// force of one frequency leaves after a fit need not be strongest there, half a resolution apart.
std::vector<double> driving_frequencies(const FittedModel& model,
                                        const std::vector<double>& floors) {
  std::vector<double> frequencies = strongest_frequencies(model, floors, kLines);
  const Sampling sampling = longest_sampling(model);
  if (sampling.duration == 0) return {};
  const double step = std::max(0.5 / sampling.duration, sampling.highest() / kFrequencies);
  for (double f = step; f <= sampling.highest(); f += step) frequencies.push_back(f);
  return frequencies;
}

}  // namespace

std::vector<double> strongest_frequencies(const FittedModel& model,
                                          const std::vector<double>& floors, int count) {
  const Sampling sampling = longest_sampling(model);
  if (sampling.duration == 0) return {};
  // The power of the residuals at a quarter of the resolution.
  const double step = 0.25 / sampling.duration, highest = sampling.highest();
  std::vector<std::pair<double, double>> lines;  // power, frequency
  std::vector<double> power;
  for (double f = 2 * step; f <= highest; f += step) {
    double sum = 0;
    for (std::size_t e = 0; e < model.fit_residual.size(); ++e) {
      const MatrixXd& r = model.fit_residual[e];
      const auto& time = model.problem->experiments()[e].recording.time;
      VectorXd cosine(r.cols()), sine(r.cols());
      for (Index k = 0; k < r.cols(); ++k) {
        const double angle = angle_of_frequency(f, time[static_cast<std::size_t>(k)]);
        cosine[k] = std::cos(angle);
        sine[k] = std::sin(angle);
      }
      for (Index c = 0; c < r.rows(); ++c) {
        double a = 0, b = 0;
        for (Index k = 0; k < r.cols(); ++k) {
          if (std::isnan(r(c, k))) continue;
          a += r(c, k) * cosine[k];
          b += r(c, k) * sine[k];
        }
        sum += (a * a + b * b) / (floors[e] * floors[e]);
      }
    }
    power.push_back(sum);
  }
  for (std::size_t i = 0; i < power.size(); ++i) {
    const bool left = i == 0 || power[i] >= power[i - 1];
    const bool right = i + 1 == power.size() || power[i] >= power[i + 1];
    if (left && right) lines.emplace_back(power[i], (2 + static_cast<double>(i)) * step);
  }
  std::sort(lines.rbegin(), lines.rend());
  std::vector<double> frequencies;
  for (const auto& [strength, frequency] : lines)
    if (static_cast<int>(frequencies.size()) < count) frequencies.push_back(frequency);
  return frequencies;
}

namespace {

/// One point of a candidate's grid of shapes.
struct ScoredStart {
  Score score;
  std::vector<int> columns;
  std::vector<std::pair<std::string, double>> start;
  VectorXd shape;
};

/// The start of the best score, and as another one the best whose shape is not next to that.
void take_best(Explanation& explanation, std::vector<ScoredStart>& scores) {
  std::stable_sort(scores.begin(), scores.end(), [](const ScoredStart& a, const ScoredStart& b) {
    return a.score.removed > b.score.removed;
  });
  if (scores.empty()) return;
  const ScoredStart& best = scores.front();
  explanation.score = best.score;
  explanation.start = best.start;
  constexpr double kElsewhere = 0.2;  // relative
  for (const ScoredStart& other : scores)
    if (explanation.other_start.empty() && other.shape.size() > 0 &&
        (other.shape - best.shape).norm() > kElsewhere * best.shape.norm())
      explanation.other_start = other.start;
}

}  // namespace

Search::Search(Workshop& workshop, FittedModel base, std::vector<std::string> effects,
               std::vector<double> floors)
    : workshop_(workshop),
      base_(std::move(base)),
      effects_(std::move(effects)),
      floors_(std::move(floors)) {
  std::vector<Candidate> others;
  for (const Candidate& candidate : workshop_.library())
    if (candidate.unavailable.empty() && !candidate.own_model && !in_base(candidate.id))
      others.push_back(candidate);
  const Case& the_case = base_.problem->the_case();
  const Case freer = with_freer_start(the_case, kMoreTerms, kRateTerms).value_or(the_case);
  all_ = std::make_shared<const Problem>(
      with_effects(freer, others, true),
      workshop_.model_with_all(the_case.links, own_models_in_base()));
  x_ = transfer(*base_.problem, base_.x, *all_);
  frequencies_ = driving_frequencies(base_, floors_);
}

bool Search::in_base(const std::string& id) const {
  return std::find(effects_.begin(), effects_.end(), id) != effects_.end();
}

std::vector<std::string> Search::own_models_in_base() const {
  std::vector<std::string> own;
  for (const std::string& id : effects_)
    if (workshop_.find(id)->own_model) own.push_back(id);
  return own;
}

std::shared_ptr<const Problem> Search::problem_with(const Candidate& candidate) const {
  const Case& the_case = base_.problem->the_case();
  std::vector<std::string> effects = effects_;
  effects.push_back(candidate.id);
  return std::make_shared<const Problem>(with_effects(the_case, {candidate}, true),
                                         workshop_.model_with(effects, the_case.links));
}

MatrixXd Search::columns(const Problem& problem, const VectorXd& x,
                         const std::vector<Index>& unknowns) const {
  std::vector<std::vector<MatrixXd>> derivatives(unknowns.size());
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const int index = static_cast<int>(e);
    if (!problem.experiments()[e].fitted()) {
      for (auto& derivative : derivatives) derivative.emplace_back();
      continue;
    }
    const std::vector<SensitivityDirection> every = problem.directions(x, index);
    std::vector<SensitivityDirection> along;
    for (const Index j : unknowns) along.push_back(every[static_cast<std::size_t>(j)]);
    Prediction prediction = problem.predict(x, index, false, along);
    if (!prediction.ok())
      throw std::runtime_error("the model with every effect cannot be simulated at the fit: " +
                               prediction.message);
    for (std::size_t j = 0; j < unknowns.size(); ++j)
      derivatives[j].push_back(std::move(prediction.sensitivity[j]));
  }
  MatrixXd result;
  for (std::size_t j = 0; j < unknowns.size(); ++j) {
    const VectorXd column = stacked(derivatives[j], base_.fit_residual, floors_);
    if (result.size() == 0) result.resize(column.size(), static_cast<Index>(unknowns.size()));
    result.col(static_cast<Index>(j)) = column;
  }
  return result;
}

double Search::significance(const ScoreTest& test, const std::vector<int>& columns,
                            const Score& score) const {
  const VectorXd rest = test.residual_after(columns, score.estimate);
  // Back into channels x frames, for the correlations of what would be left.
  std::vector<MatrixXd> left;
  Index next = 0;
  for (const MatrixXd& shape : base_.fit_residual) {
    if (shape.cols() == 0) continue;
    MatrixXd part = shape;
    for (Index k = 0; k < part.cols(); ++k)
      for (Index c = 0; c < part.rows(); ++c)
        if (!std::isnan(part(c, k))) part(c, k) = rest[next++];
    left.push_back(std::move(part));
  }
  const double variance =
      std::max(1.0, rest.squaredNorm() / static_cast<double>(std::max<Index>(1, rest.size())));
  return log10_chi_square_tail(score.removed / (variance * colour_factor(left)),
                               static_cast<int>(columns.size()));
}

void Search::score_start(ScoreTest& test, const MatrixXd& derivatives,
                         std::vector<Explanation>& out) const {
  if (derivatives.cols() == 0) return;
  Explanation rival;
  rival.id = kStartShape;
  rival.title = "A start that bends more, or moves";
  std::vector<int> columns;
  for (Index j = 0; j < derivatives.cols(); ++j)
    columns.push_back(test.add({derivatives.col(j), -std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::infinity()}));
  rival.score = test.score(columns);
  if (rival.score.admissible) rival.log10_p = significance(test, columns, rival.score);
  out.push_back(std::move(rival));
}

std::vector<Explanation> Search::score(bool own_models) {
  // One run with everything that has a slope at the base: what is fitted, a freer start, and the
  // amplitudes of the effects without a shape.
  std::vector<Index> fitted, start, amplitudes;
  for (std::size_t j = 0; j < all_->unknowns().size(); ++j) {
    const Unknown& unknown = all_->unknowns()[j];
    if (unknown_index(*base_.problem, unknown.name) >= 0)
      fitted.push_back(static_cast<Index>(j));
    else if (unknown.group == Unknown::Group::kInitial)
      start.push_back(static_cast<Index>(j));
  }
  struct Run {
    std::shared_ptr<const Problem> problem;
    int candidate = -1;
    VectorXd x;
    std::vector<Index> unknowns;
    VectorXd shape;
    MatrixXd columns;
  };
  std::vector<Run> runs(1);
  runs[0].problem = all_;
  runs[0].x = x_;
  for (const Index j : fitted) runs[0].unknowns.push_back(j);
  if (own_models) start.clear();
  for (const Index j : start) runs[0].unknowns.push_back(j);
  const std::vector<Candidate>& library = workshop_.library();
  for (std::size_t i = 0; i < library.size(); ++i) {
    const Candidate& candidate = library[i];
    if (!candidate.unavailable.empty() || in_base(candidate.id) ||
        candidate.own_model != own_models)
      continue;
    const auto amplitudes_of = candidate.with_role(ParameterRole::kAmplitude);
    if (amplitudes_of.empty()) continue;  // a limit: see score_limit
    const auto problem = candidate.own_model ? problem_with(candidate) : all_;
    const VectorXd x = candidate.own_model ? transfer(*base_.problem, base_.x, *problem) : x_;
    const auto place = [&](int p) {
      return unknown_index(*problem, candidate.parameters[static_cast<std::size_t>(p)].name);
    };
    std::vector<Index> own;
    for (const int p : amplitudes_of) own.push_back(place(p));
    const auto shapes = candidate.with_role(ParameterRole::kShape);
    const auto phases = candidate.with_role(ParameterRole::kPhase);
    if (shapes.empty() && phases.empty() && !candidate.own_model) {
      runs[0].unknowns.insert(runs[0].unknowns.end(), own.begin(), own.end());
      continue;
    }
    for (const VectorXd& shape : shape_grid(candidate, frequencies_))
      for (const double phase : {0.0, std::numbers::pi / 2}) {
        if (phase > 0 && phases.empty()) continue;
        Run run{problem, static_cast<int>(i), x, own, shape, {}};
        for (std::size_t s = 0; s < shapes.size(); ++s)
          run.x[place(shapes[s])] = shape[static_cast<Index>(s)];
        for (const int p : phases) run.x[place(p)] = phase;
        runs.push_back(std::move(run));
      }
  }
  in_parallel(runs.size(), workshop_.threads, [&](std::size_t r) {
    if (workshop_.stopped()) return;
    Run& run = runs[r];
    run.columns = columns(*run.problem, run.x, run.unknowns);
  });
  workshop_.stop_if_asked();  // runs that were left out have no columns

  const auto fitted_count = static_cast<Index>(fitted.size());
  const auto start_count = static_cast<Index>(start.size());
  ScoreTest test(stacked(base_.fit_residual, base_.fit_residual, floors_),
                 runs[0].columns.leftCols(fitted_count));
  std::vector<Explanation> found;
  score_start(test, runs[0].columns.middleCols(fitted_count, start_count), found);

  Index next = fitted_count + start_count;
  std::size_t next_run = 1;
  for (std::size_t i = 0; i < library.size(); ++i) {
    const Candidate& candidate = library[i];
    if (in_base(candidate.id) || candidate.own_model != own_models) continue;
    Explanation explanation;
    explanation.id = candidate.id;
    explanation.title = candidate.title;
    explanation.candidate = static_cast<int>(i);
    explanation.note = candidate.unavailable;
    if (!candidate.unavailable.empty()) {
      found.push_back(std::move(explanation));
      continue;
    }
    if (candidate.with_role(ParameterRole::kAmplitude).empty()) {
      found.push_back(score_limit(test, static_cast<int>(i)));
      continue;
    }
    const auto amplitudes_of = candidate.with_role(ParameterRole::kAmplitude);
    const auto parameter = [&](int p) -> const CandidateParameter& {
      return candidate.parameters[static_cast<std::size_t>(p)];
    };
    const auto phases = candidate.with_role(ParameterRole::kPhase);
    const auto shapes = candidate.with_role(ParameterRole::kShape);
    std::vector<ScoredStart> scores;
    const auto consider = [&](const MatrixXd& at_zero, const MatrixXd* at_quarter,
                              const VectorXd& shape) {
      std::vector<int> columns;
      for (std::size_t a = 0; a < amplitudes_of.size(); ++a) {
        const CandidateParameter& p = parameter(amplitudes_of[a]);
        const double low = p.lower - p.neutral, high = p.upper - p.neutral;
        columns.push_back(test.add({at_zero.col(static_cast<Index>(a)), low, high}));
        if (at_quarter)
          columns.push_back(test.add({at_quarter->col(static_cast<Index>(a)), low, high}));
      }
      const Score score = test.score(columns);
      if (!score.admissible) return;
      std::vector<std::pair<std::string, double>> start;
      for (std::size_t a = 0; a < amplitudes_of.size(); ++a) {
        const CandidateParameter& p = parameter(amplitudes_of[a]);
        if (!at_quarter) {
          start.emplace_back(p.name, p.neutral + score.estimate[static_cast<Index>(a)]);
          continue;
        }
        // a sin(w t) + b cos(w t) = sqrt(a^2 + b^2) sin(w t + atan2(b, a))
        const double sine = score.estimate[static_cast<Index>(2 * a)];
        const double cosine = score.estimate[static_cast<Index>(2 * a + 1)];
        start.emplace_back(p.name, p.neutral + std::hypot(sine, cosine));
        for (const int q : phases)
          if (parameter(q).amplitude == amplitudes_of[a])
            start.emplace_back(parameter(q).name, std::atan2(cosine, sine));
      }
      for (std::size_t s = 0; s < shapes.size(); ++s)
        start.emplace_back(parameter(shapes[s]).name, shape[static_cast<Index>(s)]);
      scores.push_back({score, columns, std::move(start), shape});
    };
    if (shapes.empty() && phases.empty() && !candidate.own_model) {
      consider(runs[0].columns.middleCols(next, static_cast<Index>(amplitudes_of.size())), nullptr,
               {});
      next += static_cast<Index>(amplitudes_of.size());
    } else {
      while (next_run < runs.size() && runs[next_run].candidate == static_cast<int>(i)) {
        const Run& at_zero = runs[next_run];
        const MatrixXd* quarter = phases.empty() ? nullptr : &runs[next_run + 1].columns;
        consider(at_zero.columns, quarter, at_zero.shape);
        next_run += phases.empty() ? 1 : 2;
      }
    }
    take_best(explanation, scores);
    if (explanation.score.admissible)
      explanation.log10_p = significance(test, scores.front().columns, explanation.score);
    if (!explanation.score.admissible) explanation.note = "would have to act the other way round";
    found.push_back(std::move(explanation));
  }
  std::stable_sort(found.begin(), found.end(), [](const Explanation& a, const Explanation& b) {
    return a.score.removed > b.score.removed;
  });
  return found;
}

Explanation Search::score_limit(ScoreTest& test, int index) const {
  const Candidate& candidate = workshop_.library()[static_cast<std::size_t>(index)];
  Explanation explanation;
  explanation.id = candidate.id;
  explanation.title = candidate.title;
  explanation.candidate = index;
  const auto limits = candidate.with_role(ParameterRole::kLimit);
  if (limits.size() != 1) {
    explanation.note = "not one parameter whose limit is the plain model";
    return explanation;
  }
  const CandidateParameter& parameter = candidate.parameters[static_cast<std::size_t>(limits[0])];
  const auto shared = problem_with(candidate);
  const Problem& problem = *shared;
  VectorXd x = transfer(*base_.problem, base_.x, problem);
  const Index unknown = unknown_index(problem, parameter.name);
  // The slope by 1/value, from the first value that moves the trajectory by a third of the noise.
  for (double value = 1e6; value > std::max(parameter.lower, 1.0); value /= 10) {
    x[unknown] = value;
    std::vector<MatrixXd> difference(problem.experiments().size());
    bool ok = true;
    for (std::size_t e = 0; e < difference.size(); ++e) {
      if (base_.fit_residual[e].cols() == 0) continue;
      const Prediction prediction = problem.predict(x, static_cast<int>(e), false);
      ok = ok && prediction.ok();
      if (ok)
        difference[e] =
            prediction.simulated - base_.predicted[e].leftCols(base_.fit_residual[e].cols());
    }
    if (!ok) continue;
    VectorXd column = stacked(difference, base_.fit_residual, floors_);
    if (column.norm() < 0.33 * std::sqrt(static_cast<double>(column.size()))) continue;
    column *= value;
    const std::vector<int> columns = {test.add({column, 0.0, 1 / std::max(parameter.lower, 1e-3)})};
    explanation.score = test.score(columns);
    if (explanation.score.admissible) {
      explanation.log10_p = significance(test, columns, explanation.score);
      explanation.start.emplace_back(parameter.name, 1 / explanation.score.estimate[0]);
    }
    break;
  }
  if (!explanation.score.admissible) explanation.note = "would have to act the other way round";
  return explanation;
}

void Search::refit(Explanation& explanation, bool far) const {
  if (explanation.candidate < 0) {
    const auto freer = with_freer_start(base_.problem->the_case(), kMoreTerms, kRateTerms);
    if (!freer) return;
    const auto problem = std::make_shared<const Problem>(*freer, base_.problem->model());
    fit_from(explanation, problem, transfer(*base_.problem, base_.x, *problem));
  } else {
    const Candidate& candidate =
        workshop_.library()[static_cast<std::size_t>(explanation.candidate)];
    const auto problem = problem_with(candidate);
    const auto start = [&](const std::vector<std::pair<std::string, double>>& values) {
      VectorXd x = transfer(*base_.problem, base_.x, *problem);
      for (const auto& [name, value] : values)
        if (const Index j = unknown_index(*problem, name); j >= 0) x[j] = value;
      return x;
    };
    const VectorXd x = start(explanation.start);
    fit_from(explanation, problem, scaled(candidate, *problem, x, 1));
    if (candidate.own_model) far = false;  // dear enough once
    if (far) fit_from(explanation, problem, scaled(candidate, *problem, x, 0.25));
    if (far && !explanation.other_start.empty())
      fit_from(explanation, problem,
               scaled(candidate, *problem, start(explanation.other_start), 1));
  }
  if (!explanation.refitted) explanation.note = "the refit failed";
}

void Search::refit_from_elsewhere(Explanation& explanation) const {
  const Candidate& candidate = workshop_.library()[static_cast<std::size_t>(explanation.candidate)];
  const std::shared_ptr<const Problem> problem = explanation.model.problem;
  const VectorXd x = explanation.model.x;
  for (const double factor : {3.0, 1.0 / 3})
    fit_from(explanation, problem, scaled(candidate, *problem, x, factor));
}

VectorXd Search::scaled(const Candidate& candidate, const Problem& problem, VectorXd x,
                        double factor) const {
  for (const CandidateParameter& parameter : candidate.parameters) {
    const Index j = unknown_index(problem, parameter.name);
    if (j < 0) continue;
    if (parameter.role == ParameterRole::kAmplitude)
      x[j] = parameter.neutral + factor * (x[j] - parameter.neutral);
    x[j] = std::clamp(x[j], parameter.lower, parameter.upper);
  }
  return x;
}

void Search::fit_from(Explanation& explanation, const std::shared_ptr<const Problem>& problem,
                      const VectorXd& start) const {
  if (workshop_.stopped()) return;
  FittedModel model = fit_model(problem, start, workshop_.least_squares, workshop_.stop);
  if (!model.ok || (explanation.refitted &&
                    sum_of_squares(model, floors_) >= sum_of_squares(explanation.model, floors_)))
    return;
  explanation.refitted = true;
  explanation.comparison = compare(base_, model, floors_);
  explanation.fit = fit_gap(model, floors_);
  explanation.held_out = held_out_gap(model, floors_);
  explanation.model = std::move(model);
}

void Search::refit_best(std::vector<Explanation>& explanations, int count, bool far) const {
  std::vector<Explanation*> chosen;
  double best = 0;
  for (Explanation& explanation : explanations) {
    if (!explanation.score.admissible || explanation.refitted) continue;
    best = std::max(best, explanation.score.removed);
    if (static_cast<int>(chosen.size()) < count && explanation.score.removed > 0.03 * best &&
        explanation.log10_p < -2)
      chosen.push_back(&explanation);
  }
  refit_all(std::move(chosen), far);
}

void Search::refit_rest(std::vector<Explanation>& explanations) const {
  std::vector<Explanation*> chosen;
  for (Explanation& explanation : explanations)
    if (explanation.score.admissible && !explanation.refitted) chosen.push_back(&explanation);
  refit_all(std::move(chosen), false);
}

void Search::refit_all(std::vector<Explanation*> chosen, bool far) const {
  in_parallel(chosen.size(), workshop_.threads, [&](std::size_t i) {
    Explanation& explanation = *chosen[i];
    workshop_.say("refitting with " + explanation.id);
    refit(explanation, far);
  });
  // What holds and slips, or is large, has more than one minimum: the best of those that still
  // leave a gap are tried from elsewhere.
  std::erase_if(chosen, [&](const Explanation* each) {
    return !each->refitted || each->candidate < 0 || !each->fit.present ||
           workshop_.library()[static_cast<std::size_t>(each->candidate)].own_model;
  });
  std::stable_sort(chosen.begin(), chosen.end(), [&](const Explanation* a, const Explanation* b) {
    return sum_of_squares(a->model, floors_) < sum_of_squares(b->model, floors_);
  });
  chosen.resize(std::min<std::size_t>(chosen.size(), kTriedElsewhere));
  in_parallel(chosen.size(), workshop_.threads,
              [&](std::size_t i) { refit_from_elsewhere(*chosen[i]); });
}

}  // namespace catena
