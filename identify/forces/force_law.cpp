// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/force_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "common/normal_quantile.hpp"
#include "identify/forces/compared_forms.hpp"
#include "identify/forces/law_choice.hpp"
#include "identify/forces/law_fit.hpp"
#include "identify/forces/law_response.hpp"
#include "identify/forces/place_kinematics.hpp"
#include "identify/noise/cosine_spectrum.hpp"
#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Times that the motion is linearised anew about the law.
constexpr int kRoundsAboutLaw = 2;
/// Deviation of a coefficient's prior there, in units of its size; of another number, of its step.
constexpr double kWide = 100;
/// Searches with the pairs left out that went astray.
constexpr int kMostSearches = 4;
/// Steps of the integration in one of the estimate of the force. A law has few constants, which all
/// frames determine: with one they are wrong by half their standard error.
constexpr int kFiner = 4;
constexpr std::uint64_t kLawSeed = 18;

/// At most so many joints, evenly along the chain, are tried for friction with its force following the state. None of
/// the others is a tenth of the length away from one of them, which is as well as a place has to be known.
constexpr Index kJointsThatStick = 12;

/// Columns of terms whose responses are made at a time: what is in memory at once.
constexpr Index kColumnsAtOnce = 400;
/// Formulas that are fitted with their force following the state: of the chosen pair, and of all others; and curves of
/// any pair, which take no formula's place. A chosen curve is always fitted.
constexpr std::size_t kFittedOfChosen = 6, kFittedOfOthers = 8, kFittedCurves = 3;

/// What forces look like that follow no law: of the same spectrum as those of a path, with random
/// phases. At every node, turns x random forces.
NodeForces random_forces(const ForcePath& path, const std::vector<ForcePattern>& patterns,
                         const LawChain& chain, std::mt19937_64& random) {
  MatrixXd force(path.force.rows() / 2, path.force.cols());  // without its rates
  for (Index m = 0; m < force.rows(); ++m) force.row(m) = path.force.row(2 * m);
  const MatrixXd spectrum = cosine_spectrum(force);
  std::vector<MatrixXd> drawn;
  for (Index s = 0; s < kRandomSeries; ++s)
    drawn.push_back(random_series(spectrum, force.cols(), random));
  NodeForces forces;
  for (Index k = 0; k < force.cols(); ++k) {
    MatrixXd unit(chain.turns(), static_cast<Index>(patterns.size()));
    for (std::size_t m = 0; m < patterns.size(); ++m)
      unit.col(static_cast<Index>(m)) =
          link_torques(patterns[m], chain.lengths, path.state.col(k).data());
    MatrixXd& at_node = forces.columns.emplace_back(chain.turns(), kRandomSeries);
    for (Index s = 0; s < kRandomSeries; ++s)
      at_node.col(s) = unit * drawn[static_cast<std::size_t>(s)].col(k);
  }
  return forces;
}

/// The force of a path as torques on the links, turns x nodes.
MatrixXd torques_of(const ForcePath& path, const std::vector<ForcePattern>& patterns,
                    const LawChain& chain) {
  MatrixXd torques = MatrixXd::Zero(chain.turns(), path.force.cols());
  for (Index k = 0; k < torques.cols(); ++k)
    for (std::size_t m = 0; m < patterns.size(); ++m)
      torques.col(k) += path.force(static_cast<Index>(2 * m), k) *
                        link_torques(patterns[m], chain.lengths, path.state.col(k).data());
  return torques;
}

/// What a law is chosen and confirmed by: both halves of the frames, or every other point that is seen. A law of the
/// time says nothing of other times.
enum class Split { kFrames, kPoints };

/// The problem where one half of the points is seen.
LinearProblem of_points(const ForcePaths& paths, const LinearProblem& linear, FrameHalf half) {
  LinearProblem out = linear;
  for (std::size_t r = 0; r < out.recordings.size(); ++r) {
    const auto values = paths.seen_values(r);
    for (std::size_t node = 0; node < values.size(); ++node) {
      std::vector<Index> rows;
      for (std::size_t i = 0; i < values[node].size(); ++i) {
        const int point = paths.recording(r).channels[values[node][i].channel].point;
        if ((point % 2 == 1) == (half == FrameHalf::kSecond)) rows.push_back(static_cast<Index>(i));
      }
      LinearRecording::Seen& seen = out.recordings[r].seen[node];
      seen = {seen.value(rows).eval(), seen.by_state(rows, Eigen::all).eval(),
              seen.by_parameter(rows, Eigen::all).eval()};
    }
  }
  return out;
}

class LawSearch {
 public:
  /// `random`: of each recording. `linear`: with a torque on every link as its forces. `searches`: with this one.
  LawSearch(ForcePaths& paths, const std::vector<NodeForces>& random, std::mt19937_64& numbers,
            LinearProblem linear, const LawChain& chain, std::vector<CandidateLaw> candidates,
            Split split, int searches)
      : paths_(paths),
        random_(random),
        numbers_(numbers),
        linear_(std::move(linear)),
        chain_(chain),
        candidates_(std::move(candidates)),
        split_(split),
        searches_(searches),
        fits_(paths_, linear_, chain_) {}

  ForceLaw run() {
    ForceLaw law;
    law.candidates = static_cast<int>(candidates_.size());
    const LawTrials first = trials(FrameHalf::kFirst), second = trials(FrameHalf::kSecond);
    std::vector<ChosenLaw> chosen = choose_law(candidates_, first, LawForms::kFormulas);
    if (split_ == Split::kFrames) choose_what_sticks(first, second, chosen);
    const std::vector<double> confirmed = confirm(first, second, chosen);
    if (chosen[0].form.empty()) return law;
    take_names(candidates_[chosen[0].candidate], law);
    law.confirmed = confirmed[0];
    const auto as_well = std::count_if(confirmed.begin() + 1, confirmed.end(),
                                       [&](double of) { return of >= law.confirmed; });
    law.chance = (1.0 + static_cast<double>(as_well)) / (1.0 + kRandomSeries);
    law.chance *= searches_;
    law.by_points = split_ == Split::kPoints;
    law.found = law.chance <= kLawThresholds.chance && law.confirmed >= kLawThresholds.confirmed;
    if (law.found) read_formula(closest(chosen[0], first, second), law);
    if (law.found && split_ == Split::kPoints) law.found = is_between_ends(law);
    return law;
  }
  /// The law that left too much about its own motion, after run.
  const std::optional<CandidateLaw>& astray() const { return astray_; }

 private:
  static void take_names(const CandidateLaw& candidate, ForceLaw& law) {
    law.force = candidate.force_name();
    law.variable = candidate.variable_name();
    law.site = candidate.site();
  }

  /// What the chosen laws explain of the second part. Where a formula does not explain enough of it a curve is chosen, if
  /// that does better: for the recorded force and for the random ones. Of the time a curve is chosen as a formula is: a
  /// pulse in one direction explains much of any push in another.
  std::vector<double> confirm(const LawTrials& first, const LawTrials& second,
                              std::vector<ChosenLaw>& chosen) const {
    std::vector<ChosenLaw> curves = choose_law(candidates_, first, LawForms::kCurves);
    if (split_ == Split::kFrames) choose_following_curves(first, second, curves);
    std::vector<double> confirmed;
    for (std::size_t t = 0; t < chosen.size(); ++t) {
      const double least =
          t == 0 ? left_by_force(FrameHalf::kSecond) : static_cast<double>(second.seen);
      const auto column = static_cast<Index>(t);
      if (split_ == Split::kPoints && curves[t].score > chosen[t].score) chosen[t] = curves[t];
      double& explained =
          confirmed.emplace_back(explained_by_law(second, column, chosen[t], least));
      if (explained >= kLawThresholds.confirmed || curves[t].form.empty()) continue;
      const double by_curve = explained_by_law(second, column, curves[t], least);
      if (!chosen[t].form.empty() && by_curve <= explained) continue;
      explained = by_curve;
      chosen[t] = curves[t];
    }
    return confirmed;
  }

  /// Whether a push was certainly after the first frame and before the last one. At the first one it is a start that
  /// differs from the one assumed, and no law.
  bool is_between_ends(const ForceLaw& law) const {
    for (const CandidateLaw::Constant& constant : law.formula.constants) {
      if (constant.name != "moment") continue;
      const double error = kNormalQuantile95 * constant.deviation;
      for (const LawMotion& motion : motions_of(paths_))
        if (!(constant.value - error > motion.time.front() &&
              constant.value + error < motion.time.back()))
          return false;
    }
    return true;
  }

  /// One part with the terms of a law whose force follows the state, as trials of that law alone; `noise`: in the random
  /// forces.
  LawTrials following_trials(const FittedForm& fitted, FrameHalf half,
                             const MatrixXd& noise) const {
    const auto terms = static_cast<Index>(fitted.form.size());
    std::vector<NodeForces> forces = fits_.forces_of(fitted.law, fitted.form, fitted.coefficients);
    for (std::size_t r = 0; r < forces.size(); ++r)
      for (std::size_t k = 0; k < forces[r].columns.size(); ++k) {
        MatrixXd& columns = forces[r].columns[k];
        columns.conservativeResize(Eigen::NoChange, terms + kRandomSeries);
        columns.rightCols(kRandomSeries) = random_[r].columns[k];
      }
    const LawPart part = law_part(fits_.with_memory(fitted.law), forces, half);
    MatrixXd columns(part.value.size(), terms + 1 + kRandomSeries);
    columns << part.forces.leftCols(terms), part.value, part.forces.rightCols(kRandomSeries);
    columns.topRightCorner(part.seen, kRandomSeries) += noise.topRows(part.seen);
    columns = without_nuisance(part, std::move(columns));
    const auto responses = columns.leftCols(terms);
    const auto values = columns.rightCols(1 + kRandomSeries);
    LawTrials trials;
    trials.squares = values.colwise().squaredNorm().transpose();
    trials.rows = columns.rows();
    trials.seen = part.seen;
    LawTrials::OfCandidate& of = trials.candidates.emplace_back();
    // Numbered as all terms of the law.
    MatrixXd all = MatrixXd::Zero(columns.rows(), fitted.law.terms());
    for (Index j = 0; j < terms; ++j)
      all.col(fitted.form[static_cast<std::size_t>(j)]) = responses.col(j);
    of.gram = products_in_forms(all, {fitted.form});
    of.cross = all.transpose() * values;
    return trials;
  }

  /// Chooses a candidate's form for the columns in which it does better with its force following the state, and confirms it
  /// so. It is fitted to the recorded force.
  void choose_following(std::size_t candidate, const std::vector<int>& form, const LawTrials& first,
                        const LawTrials& second, std::vector<ChosenLaw>& chosen) const {
    const CandidateLaw& law = candidates_[candidate];
    const FittedForm fitted =
        fits_.fit_without_drive({.law = law, .form = form}, FrameHalf::kFirst);
    if (!std::isfinite(fitted.squares) || !law.admits(fitted.coefficients)) return;
    const LawTrials in_first = following_trials(fitted, FrameHalf::kFirst, first.noise);
    const LawTrials in_second = following_trials(fitted, FrameHalf::kSecond, second.noise);
    const double count = std::log(static_cast<double>(first.rows));
    for (std::size_t t = 0; t < chosen.size(); ++t) {
      const auto column = static_cast<Index>(t);
      const auto of_column = fit_of_column(law, in_first.candidates[0], fitted.form, column, count);
      if (!of_column) continue;
      // Shares of what is there without a law along the motion found, as all scores are.
      const double left = in_first.squares[column] - of_column->explained;
      const double score =
          1 - (left + count * law.constants(of_column->form)) / first.squares[column];
      if (score <= chosen[t].score) continue;
      const ChosenLaw alone{0, of_column->form, score, of_column->coefficients};
      const double after = in_second.squares[column] - explained_squares(in_second, column, alone);
      chosen[t] = {candidate, of_column->form, score, of_column->coefficients,
                   second.squares[column] - after};
    }
  }

  /// Friction in joints is chosen and confirmed with its force following the state, for the recorded force and the
  /// random ones: what sticks has no rate but noise, so a force along the motion found is wrong there.
  void choose_what_sticks(const LawTrials& first, const LawTrials& second,
                          std::vector<ChosenLaw>& chosen) const {
    const Index every = (chain_.lengths.size() + kJointsThatStick - 1) / kJointsThatStick;
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      const CandidateLaw& law = candidates_[c];
      const std::vector<int>& form = law.forms().front();
      if (form.size() != 1 || !law.sticks(form)) continue;
      if (law.site().kind == SiteKind::kJoint && law.site().joint % every != 0) continue;
      choose_following(c, form, first, second, chosen);
    }
  }

  /// So are the best curves: the motion found is that of a smooth force, so a law that turns on and off has another one.
  void choose_following_curves(const LawTrials& first, const LawTrials& second,
                               std::vector<ChosenLaw>& chosen) const {
    std::vector<Close> curves;
    for (const Close& close : ranked({&first})) {
      if (curves.size() == kFittedCurves) break;
      if (!candidates_[close.candidate].is_curve(close.form) || is_like_one_of(close, curves))
        continue;
      choose_following(close.candidate, close.form, first, second, chosen);
      curves.push_back(close);
    }
  }

  LawTrials trials(FrameHalf half) {
    LawTrials trials;
    const LinearProblem linear =
        split_ == Split::kPoints ? of_points(paths_, linear_, half) : linear_;
    const FrameHalf frames = split_ == Split::kPoints ? FrameHalf::kBoth : half;
    const LawPart part = law_part(linear, random_, frames);
    const MatrixXd basis = orthonormal_basis(part.nuisance, 1e-12);
    const auto project = [&](MatrixXd& columns) {
      const MatrixXd along = basis.transpose() * columns;
      columns.noalias() -= basis * along;
    };
    MatrixXd values(part.value.size(), 1 + kRandomSeries);
    values << part.value, part.forces;
    trials.noise.setZero(values.rows(), kRandomSeries);
    for (Index s = 0; s < kRandomSeries; ++s)
      for (Index i = 0; i < part.seen; ++i) trials.noise(i, s) = normal_number(numbers_);
    values.rightCols(kRandomSeries) += trials.noise;
    project(values);
    trials.squares = values.colwise().squaredNorm().transpose();
    trials.rows = values.rows();
    trials.seen = part.seen;
    for (std::size_t begin = 0, end = 0; begin < candidates_.size(); begin = end) {
      Index columns = 0;
      while (end < candidates_.size() &&
             (end == begin || columns + candidates_[end].terms() <= kColumnsAtOnce))
        columns += candidates_[end++].terms();
      std::vector<NodeForces> forces;
      for (const LawMotion& motion : motions_of(paths_)) {
        const auto nodes = static_cast<std::size_t>(motion.state.cols());
        NodeForces& of_recording = forces.emplace_back();
        of_recording.columns.assign(nodes, MatrixXd(chain_.turns(), columns));
        Index column = 0;
        for (std::size_t c = begin; c < end; ++c, column += candidates_[c - 1].terms()) {
          const MatrixXd states = candidates_[c].memory().along(motion, chain_);
          for (std::size_t k = 0; k < nodes; ++k)
            of_recording.columns[k].middleCols(column, candidates_[c].terms()) =
                candidates_[c].force(states.col(static_cast<Index>(k)));
        }
      }
      MatrixXd responses = law_part(linear, forces, frames).forces;
      project(responses);
      Index column = 0;
      for (std::size_t c = begin; c < end; ++c, column += candidates_[c - 1].terms()) {
        const auto terms = responses.middleCols(column, candidates_[c].terms());
        LawTrials::OfCandidate& of = trials.candidates.emplace_back();
        of.gram = products_in_forms(terms, candidates_[c].forms());
        of.cross = terms.transpose() * values;
      }
    }
    return trials;
  }

  /// A formula that comes closest as long as its force does not follow the state.
  struct Close {
    std::size_t candidate = 0;
    std::vector<int> form;
    double criterion = 0;
  };
  std::vector<Close> ranked(const std::vector<const LawTrials*>& parts) const {
    std::vector<Close> all;
    Index rows = 0;
    for (const LawTrials* part : parts) rows += part->rows;
    const double count = std::log(static_cast<double>(rows));
    for (std::size_t c = 0; c < candidates_.size(); ++c) {
      LawTrials::OfCandidate sum{parts.front()->candidates[c].gram,
                                 parts.front()->candidates[c].cross.leftCols(1)};
      for (std::size_t part = 1; part < parts.size(); ++part) {
        sum.gram += parts[part]->candidates[c].gram;
        sum.cross += parts[part]->candidates[c].cross.leftCols(1);
      }
      for (const std::vector<int>& form : candidates_[c].forms()) {
        const auto fit = fit_of_column(candidates_[c], sum, form, 0, count);
        if (fit)
          all.push_back(
              {c, fit->form, count * candidates_[c].constants(fit->form) - fit->explained});
      }
    }
    std::sort(all.begin(), all.end(),
              [](const Close& a, const Close& b) { return a.criterion < b.criterion; });
    return all;
  }
  /// Whether a fit of one of them finds the same law: one beginning is enough.
  bool is_like_one_of(const Close& close, const std::vector<Close>& some) const {
    return std::any_of(some.begin(), some.end(), [&](const Close& better) {
      return candidates_[close.candidate].differs_by_numbers(
          close.form, candidates_[better.candidate], better.form);
    });
  }
  std::vector<Close> closest(const ChosenLaw& chosen, const LawTrials& first,
                             const LawTrials& second) const {
    const bool chose_curve = candidates_[chosen.candidate].is_curve(chosen.form);
    std::vector<Close> some;
    std::size_t of_chosen = 0, others = 0, curves = 0;
    for (const Close& close : ranked({&first, &second})) {
      if (is_like_one_of(close, some)) continue;
      const bool curve = candidates_[close.candidate].is_curve(close.form);
      const bool of_this = close.candidate == chosen.candidate;
      const bool fitted = curve     ? (of_this && chose_curve) || curves++ < kFittedCurves
                          : of_this ? of_chosen++ < kFittedOfChosen
                                    : others++ < kFittedOfOthers;
      if (fitted) some.push_back(close);
    }
    return some;
  }

  /// Moves to the motion that the law gives, and fits the law about that: no force that follows noise is
  /// left in the motion. The law stays as it was where the equations cannot be followed.
  void follow(FittedForm& fitted) {
    for (int round = 0; round < kRoundsAboutLaw; ++round) {
      const VectorXd steps = fitted.law.steps(fitted.form);
      VectorXd wide(fitted.coefficients.size() + steps.size());
      wide << kWide * fitted.coefficients.cwiseAbs(), kWide * steps;
      const LinearProblem closed =
          with_law(fits_.with_memory(fitted.law),
                   fits_.forces_of(fitted.law, fitted.form, fitted.coefficients), wide);
      paths_.move(closed, smooth_forces(closed, {}, {}, paths_.prior, true));
      std::vector<MatrixXd> taken;
      for (const NodeForces& of : fits_.forces_of(fitted.law, fitted.form, fitted.coefficients)) {
        MatrixXd& force = taken.emplace_back(chain_.turns(), static_cast<Index>(of.columns.size()));
        for (std::size_t k = 0; k < of.columns.size(); ++k)
          force.col(static_cast<Index>(k)) =
              of.columns[k].leftCols(fitted.coefficients.size()) * fitted.coefficients;
      }
      paths_.take_forces(taken);
      std::optional<LinearProblem> linear = paths_.linearise(kFiner);
      if (!linear) return;
      linear_ = std::move(*linear);
      const FittedForm next = fits_.fit(fitted);
      if (!std::isfinite(next.squares) || !next.law.admits(next.coefficients)) return;
      fitted = next;
    }
  }

  /// The same. False, and the law noted, where it leaves too much there.
  bool follows(FittedForm& fitted) {
    const double promised = std::max(1.0, fitted.squares / fitted.freedom);
    follow(fitted);
    if (fitted.squares / fitted.freedom <= kLawThresholds.astray * promised) return true;
    astray_ = fitted.law;
    return false;
  }

  /// Squared residuals that the free force leaves, in standard deviations.
  double left_by_force(FrameHalf half) const {
    double sum = 0;
    const bool points = split_ == Split::kPoints;
    const LinearProblem linear = points ? of_points(paths_, linear_, half) : linear_;
    for (const LinearRecording& recording : linear.recordings)
      for (std::size_t k = 0; k < recording.seen.size(); ++k)
        if (points || (half == FrameHalf::kSecond) == (k >= recording.seen.size() / 2))
          sum += recording.seen[k].value.squaredNorm();
    return sum;
  }

  /// The best formula, and those that the data do not tell from it. The motion found follows the noise, which costs a
  /// formula with an edge more than one with many constants. So laws with a potential are compared again about the
  /// motion of the best, and curves with formulas. There a friction would gain by a second term that mends its smooth
  /// sign.
  void read_formula(const std::vector<Close>& close, ForceLaw& law) {
    std::vector<FittedForm> begins;
    begins.reserve(close.size());
    for (const Close& of : close)
      begins.push_back({.law = candidates_[of.candidate], .form = of.form});
    std::optional<ComparedForms> all = compared_forms(fits_, begins);
    law.found = all.has_value();
    if (!law.found) return;
    FittedForm found = all->fits[all->best];
    law.found = follows(found);
    if (!law.found) return;
    const bool formula = !found.law.is_curve(found.form);
    const std::optional<ComparedForms> again =
        found.law.against() && formula ? std::nullopt : compared_forms(fits_, all->fits);
    if (again) {
      const bool other = again->best != all->best || again->fits.size() != all->fits.size();
      all = again;
      if (other) {
        found = all->fits[all->best];
        law.found = follows(found);
        if (!law.found) return;
      }
    }
    const auto take = [&](const std::vector<const FittedForm*>& some, std::vector<ForceLaw>& as) {
      for (const FittedForm* fitted : some) {
        take_law(*fitted, all->inflation, as.emplace_back());
        as.back().left_more = all->left_more(*fitted);
      }
    };
    take(all->not_told_from_best(), law.rivals);
    take(all->behind_best(), law.behind);
    take_law(found, std::max(1.0, found.squares / found.freedom), law);
  }

  void take_law(const FittedForm& fitted, double inflation, ForceLaw& law) const {
    take_names(fitted.law, law);
    law.formula =
        fitted.law.sharp().formula(fitted.form, fitted.coefficients, inflation * fitted.covariance);
    const auto deviation = [&](Index number) {
      const Index at = fitted.coefficients.size() + number;
      return std::sqrt(inflation * fitted.covariance(at, at));
    };
    if (fitted.law.places() > 0) law.place_deviation = deviation(0);
    if (fitted.law.places() > 1) law.other_place_deviation = deviation(1);
  }

  ForcePaths& paths_;
  const std::vector<NodeForces>& random_;
  std::mt19937_64& numbers_;
  LinearProblem linear_;
  const LawChain& chain_;
  std::vector<CandidateLaw> candidates_;
  Split split_;
  int searches_;
  LawFit fits_;
  std::optional<CandidateLaw> astray_;
};

}  // namespace

std::optional<ForceLaw> law_of_force(ForcePaths& paths, const LawChain& chain,
                                     const LawSites& sites) {
  std::mt19937_64 numbers(kLawSeed);
  std::vector<NodeForces> random;
  for (const ForcePath& path : paths.paths())
    random.push_back(random_forces(path, paths.patterns(), chain, numbers));
  std::vector<ForcePattern> torques;
  for (Index k = 0; k < chain.lengths.size(); ++k)
    for (ForcePattern& torque : torque_patterns(k, chain)) torques.push_back(std::move(torque));
  std::vector<MatrixXd> found;
  for (const ForcePath& path : paths.paths())
    found.push_back(torques_of(path, paths.patterns(), chain));
  paths.act(std::move(torques));
  // Linear about the motion with its force: without one the rates go astray within a step.
  paths.take_forces(found);
  const std::optional<LinearProblem> linear = paths.linearise(kFiner);
  if (!linear) return std::nullopt;
  const std::vector<LawMotion> visited = motions_of(paths);
  const auto law_at = [&](const std::vector<LawSite>& of, Split split, int tried) {
    std::vector<CandidateLaw> candidates;
    for (const LawSite& site : of)
      for (CandidateLaw& candidate : split == Split::kPoints
                                         ? candidates_of_time(site, chain, visited)
                                         : candidates_at(site, chain, visited))
        candidates.push_back(std::move(candidate));
    ForceLaw law;
    for (int search = 0; search < kMostSearches && !candidates.empty(); ++search) {
      ForcePaths own = paths;  // which follow the law
      LawSearch of_candidates(own, random, numbers, *linear, chain, candidates, split, tried);
      law = of_candidates.run();
      const std::optional<CandidateLaw>& astray = of_candidates.astray();
      if (!astray) break;
      std::erase_if(candidates, [&](const CandidateLaw& each) { return each.same_pair(*astray); });
    }
    return law;
  };
  ForceLaw law = law_at(sites.first, Split::kFrames, 1);
  if (law.found) return law;
  ForceLaw second = sites.pushed ? law_at({*sites.pushed}, Split::kPoints, 2)
                                 : law_at(sites.pairs, Split::kFrames, 2);
  return second.found ? std::move(second) : std::move(law);
}

}  // namespace catena
