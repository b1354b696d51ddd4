// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/force_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "identify/forces/law_response.hpp"
#include "identify/noise/cosine_spectrum.hpp"
#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Random forces for the null distribution: a chance of 1 in 200 can be told.
constexpr Index kRandomForces = 199;
constexpr LawThresholds kLawThresholds;
/// Share of the arc length by which the place is moved to see what that changes.
constexpr double kApart = 0.02;
constexpr int kClosedLoops = 3;
/// Times that the motion is linearised anew about the law.
constexpr int kRoundsAboutLaw = 2;
/// Deviation of a coefficient's prior there, in units of its size; of the place, of what it is moved by.
constexpr double kWide = 100;
/// Steps of the integration in one of the estimate of the force. A law has few constants, which all
/// frames determine: with one they are wrong by half their standard error.
constexpr int kFiner = 4;
constexpr std::uint64_t kLawSeed = 18;

/// What forces look like that follow no law: at every node, patterns x random forces.
std::vector<MatrixXd> random_forces(const MatrixXd& path, std::mt19937_64& random) {
  MatrixXd force(path.rows() / 2, path.cols());  // without its rates
  for (Index m = 0; m < force.rows(); ++m) force.row(m) = path.row(2 * m);
  const MatrixXd spectrum = cosine_spectrum(force);
  std::vector<MatrixXd> at_node(static_cast<std::size_t>(force.cols()),
                                MatrixXd(force.rows(), kRandomForces));
  for (Index s = 0; s < kRandomForces; ++s) {
    const MatrixXd drawn = random_series(spectrum, force.cols(), random);
    for (Index k = 0; k < drawn.cols(); ++k)
      at_node[static_cast<std::size_t>(k)].col(s) = drawn.col(k);
  }
  return at_node;
}

/// The recorded part and random ones, without what the unknowns imitate: value first.
struct LawTrials {
  MatrixXd terms, values;
  Index seen = 0;  ///< rows that are measured
};
LawTrials law_trials(const LawPart& part, Index terms, std::mt19937_64& random) {
  MatrixXd all(part.value.size(), terms + 1 + kRandomForces);
  all << part.forces.leftCols(terms), part.value, part.forces.rightCols(kRandomForces);
  for (Index s = 0; s < kRandomForces; ++s)
    for (Index i = 0; i < part.seen; ++i) all(i, terms + 1 + s) += normal_number(random);
  const MatrixXd left = without_nuisance(part, all);
  return {left.leftCols(terms), left.rightCols(1 + kRandomForces), part.seen};
}

/// The candidate and its form that explain most of a column, and what they say.
struct ChosenLaw {
  std::size_t candidate = 0;
  std::vector<int> form;
  double score = 0;  ///< share explained, less what so many free terms explain by chance
  VectorXd coefficients;
};

MatrixXd law_terms(const LawTrials& trials, std::size_t candidate, const std::vector<int>& form) {
  return trials.terms.middleCols(static_cast<Index>(candidate) * PlaceLaw::terms(),
                                 PlaceLaw::terms())(Eigen::all, form);
}

/// The best candidate for each column of the trials.
std::vector<ChosenLaw> choose_law(const std::vector<PlaceLaw>& candidates,
                                  const LawTrials& trials) {
  std::vector<ChosenLaw> best(static_cast<std::size_t>(trials.values.cols()));
  const double count = std::log(static_cast<double>(trials.values.rows()));
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (const std::vector<int>& form : candidates[c].forms()) {
      const MatrixXd terms = law_terms(trials, c, form);
      const MatrixXd coefficients = least_squares(terms, trials.values);
      const MatrixXd left = trials.values - terms * coefficients;
      for (Index t = 0; t < trials.values.cols(); ++t) {
        const double penalty = count * static_cast<double>(form.size());
        const double score =
            1 - (left.col(t).squaredNorm() + penalty) / trials.values.col(t).squaredNorm();
        ChosenLaw& chosen = best[static_cast<std::size_t>(t)];
        if (score > chosen.score && candidates[c].admits(coefficients.col(t)))
          chosen = {c, form, score, coefficients.col(t)};
      }
    }
  return best;
}

/// Of what can be explained of a column, down to the squares `least`: the share that a law does.
double explained_by_law(const LawTrials& trials, Index column, const ChosenLaw& law, double least) {
  if (law.form.empty()) return 0;
  const VectorXd value = trials.values.col(column);
  const VectorXd left = value - law_terms(trials, law.candidate, law.form) * law.coefficients;
  const double before = value.squaredNorm();
  return before > least ? (before - left.squaredNorm()) / (before - least) : 0;
}

/// A formula fitted to all frames, with its force following the state.
struct FittedForm {
  std::size_t candidate = 0;
  std::vector<int> form;
  VectorXd coefficients;
  double shift = 0;  ///< m, of the place
  MatrixXd covariance;
  double place_variance = 0;
  double squares = 0, freedom = 0;
};

/// "side force = -linear x (side position - rest), linear = 0.3 (0.296 to 0.304) N/m, ...": with
/// intervals of 95 %.
std::string with_constants(const PlaceLaw::Formula& formula) {
  std::string words = formula.text;
  for (const PlaceLaw::Constant& constant : formula.constants)
    words += fmt::format(", {} = {:.3g} ({:.3g} to {:.3g}) {}", constant.name, constant.value,
                         constant.value - 1.96 * constant.deviation,
                         constant.value + 1.96 * constant.deviation, constant.unit);
  return words;
}

class LawSearch {
 public:
  /// `found`: (w, dw/dt) of each pattern at the place, one column per node, of each recording.
  /// `linear`: patterns at the place, then the same at a place `apart` m from it, which is 0 for the
  /// torque.
  LawSearch(ForcePaths& paths, const std::vector<MatrixXd>& found, LinearProblem linear,
            const VectorXd& lengths, Index coordinates, double arc_length, double apart)
      : paths_(paths),
        found_(found),
        linear_(std::move(linear)),
        lengths_(lengths),
        coordinates_(coordinates),
        arc_length_(arc_length),
        apart_(apart) {
    see_places();
    std::vector<PlaceMotion> visited;
    for (const std::vector<PlaceKinematics>& places : places_)
      for (const PlaceKinematics& place : places) visited.push_back(place.motion);
    candidates_ = place_laws(apart == 0, visited);
  }

  ForceLaw run() {
    ForceLaw law;
    law.candidates = static_cast<int>(candidates_.size());
    std::mt19937_64 random(kLawSeed);
    const auto terms = static_cast<Index>(candidates_.size()) * PlaceLaw::terms();
    std::vector<NodeForces> forces;
    for (std::size_t r = 0; r < places_.size(); ++r) {
      const std::vector<MatrixXd> drawn = random_forces(found_[r], random);
      NodeForces& of_recording = forces.emplace_back();
      for (std::size_t k = 0; k < drawn.size(); ++k) {
        MatrixXd& at =
            of_recording.columns.emplace_back(MatrixXd::Zero(patterns(), terms + kRandomForces));
        at.topRightCorner(drawn[k].rows(), kRandomForces) = drawn[k];
        for (std::size_t c = 0; c < candidates_.size(); ++c)
          at.block(0, static_cast<Index>(c) * PlaceLaw::terms(), drawn[k].rows(),
                   PlaceLaw::terms()) = candidates_[c].force(places_[r][k].motion);
      }
    }
    const LawTrials first = law_trials(law_part(linear_, forces, FrameHalf::kFirst), terms, random);
    const LawTrials second =
        law_trials(law_part(linear_, forces, FrameHalf::kSecond), terms, random);
    const std::vector<ChosenLaw> chosen = choose_law(candidates_, first);
    if (chosen[0].form.empty()) return law;
    const PlaceLaw& best = candidates_[chosen[0].candidate];
    law.force = best.force_name();
    law.variable = best.variable_name();
    law.confirmed = explained_by_law(second, 0, chosen[0], left_by_force(FrameHalf::kSecond));
    Index as_well = 0;
    for (Index t = 1; t <= kRandomForces; ++t)
      as_well += explained_by_law(second, t, chosen[static_cast<std::size_t>(t)],
                                  static_cast<double>(second.seen)) >= law.confirmed;
    law.chance = (1.0 + static_cast<double>(as_well)) / (1.0 + kRandomForces);
    law.found = law.chance <= kLawThresholds.chance && law.confirmed >= kLawThresholds.confirmed;
    if (law.found) read_formula(chosen[0].candidate, law);
    return law;
  }

 private:
  /// The place, and the one beside it, along the motion.
  void see_places() {
    places_.clear();
    beside_.clear();
    for (const ForcePath& path : paths_.paths()) {
      std::vector<PlaceKinematics>& places = places_.emplace_back();
      std::vector<PlaceMotion>& beside = beside_.emplace_back();
      for (Index k = 0; k < path.state.cols(); ++k) {
        const auto at = [&](double s) {
          return place_kinematics(path.state.col(k), coordinates_, lengths_, s);
        };
        places.push_back(at(arc_length_));
        beside.push_back(at(arc_length_ + apart_).motion);
      }
    }
  }

  /// Moves to the motion that the law gives, and fits the law about that: no force that follows noise is
  /// left in the motion. The law stays as it was where the equations cannot be followed.
  void follow(FittedForm& law) {
    const PlaceLaw& candidate = candidates_[law.candidate];
    for (int round = 0; round < kRoundsAboutLaw; ++round) {
      VectorXd wide(law.coefficients.size() + (apart_ != 0 ? 1 : 0));
      wide.head(law.coefficients.size()) = kWide * law.coefficients.cwiseAbs();
      if (apart_ != 0) wide[wide.size() - 1] = std::abs(apart_) * kWide;
      const LinearProblem closed =
          with_law(linear_, forces_of(candidate, law.form, law.coefficients), wide);
      paths_.move(closed, smooth_forces(closed, {}, {}, paths_.prior, true));
      see_places();
      VectorXd sizes(wide.size());
      sizes.head(law.coefficients.size()) = law.coefficients;
      if (apart_ != 0) sizes[wide.size() - 1] = law.shift;
      std::vector<MatrixXd> taken;
      for (const NodeForces& of : forces_of(candidate, law.form, law.coefficients)) {
        MatrixXd& force = taken.emplace_back(patterns(), static_cast<Index>(of.columns.size()));
        for (std::size_t k = 0; k < of.columns.size(); ++k)
          force.col(static_cast<Index>(k)) = of.columns[k] * sizes;
      }
      paths_.take_forces(taken);
      std::optional<LinearProblem> linear = paths_.linearise(kFiner);
      if (!linear) return;
      linear_ = std::move(*linear);
      const FittedForm fitted = fit(law.candidate, law.form, law.coefficients);
      if (!std::isfinite(fitted.squares) || !candidate.admits(fitted.coefficients)) return;
      law = fitted;
    }
  }

  /// Squared residuals that the free force leaves, in standard deviations.
  double left_by_force(FrameHalf half) const {
    double sum = 0;
    for (const LinearRecording& recording : linear_.recordings)
      for (std::size_t k = 0; k < recording.seen.size(); ++k)
        if (half == FrameHalf::kBoth ||
            (half == FrameHalf::kSecond) == (k >= recording.seen.size() / 2))
          sum += recording.seen[k].value.squaredNorm();
    return sum;
  }

  Index patterns() const { return linear_.recordings.front().steps.front().by_force.cols() / 2; }

  /// The terms of a form about the motion found, and how its force follows the state. With
  /// coefficients also, last, how the law's force changes where its place moves.
  std::vector<NodeForces> forces_of(const PlaceLaw& candidate, const std::vector<int>& form,
                                    const VectorXd& coefficients) const {
    std::vector<NodeForces> forces;
    const auto some = [&](const PlaceMotion& motion) {
      return MatrixXd(candidate.force(motion)(Eigen::all, form));
    };
    const bool known = coefficients.size() > 0;
    const auto terms = static_cast<Index>(form.size());
    for (std::size_t r = 0; r < places_.size(); ++r) {
      NodeForces& of_recording = forces.emplace_back();
      for (std::size_t k = 0; k < places_[r].size(); ++k) {
        const PlaceKinematics& place = places_[r][k];
        const MatrixXd here = some(place.motion);
        MatrixXd& columns = of_recording.columns.emplace_back(
            MatrixXd::Zero(patterns(), terms + (known && apart_ != 0 ? 1 : 0)));
        columns.topLeftCorner(here.rows(), terms) = here;
        if (!known) continue;
        if (apart_ != 0) {
          columns.col(terms).head(here.rows()) = -here * coefficients / apart_;
          columns.col(terms).tail(here.rows()) = some(beside_[r][k]) * coefficients / apart_;
        }
        constexpr double kDifference = 1e-6;  // m, m/s, rad, rad/s
        MatrixXd by_motion = MatrixXd::Zero(patterns(), place.motion.size());
        for (Index i = 0; i < place.motion.size(); ++i) {
          PlaceMotion less = place.motion, more = place.motion;
          less[i] -= kDifference;
          more[i] += kDifference;
          by_motion.col(i).head(here.rows()) =
              (some(more) - some(less)) * coefficients / (2 * kDifference);
        }
        of_recording.by_state.push_back(by_motion * place.by_state);
      }
    }
    return forces;
  }

  /// `first`: coefficients to begin with, or none.
  FittedForm fit(std::size_t number, const std::vector<int>& form,
                 const VectorXd& first = {}) const {
    FittedForm fitted;
    fitted.candidate = number;
    fitted.form = form;
    fitted.coefficients = first;
    const auto terms = static_cast<Index>(form.size());
    for (int loop = 0; loop <= kClosedLoops; ++loop) {
      const LawPart part = law_part(
          linear_, forces_of(candidates_[number], form, fitted.coefficients), FrameHalf::kBoth);
      MatrixXd columns(part.value.size(), part.forces.cols() + 1);
      columns << part.forces, part.value;
      const MatrixXd left = without_nuisance(part, columns);
      const MatrixXd laws = left.leftCols(part.forces.cols());
      const VectorXd all = least_squares(laws, VectorXd(left.rightCols(1)));
      fitted.coefficients = all.head(terms);
      fitted.squares = (left.rightCols(1) - laws * all).squaredNorm();
      fitted.freedom = static_cast<double>(part.seen - laws.cols());
      const MatrixXd covariance = inverse(laws.transpose() * laws);
      fitted.covariance = covariance.topLeftCorner(terms, terms);
      if (covariance.cols() > terms) {
        fitted.place_variance = covariance(terms, terms);
        fitted.shift = all[terms];
      }
    }
    return fitted;
  }

  void read_formula(std::size_t number, ForceLaw& law) {
    std::vector<FittedForm> fits;
    double least = HUGE_VAL, inflation = 1;
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      for (const std::vector<int>& form : candidates_[c].forms()) {
        FittedForm fitted = fit(c, form);
        if (!std::isfinite(fitted.squares) || !candidates_[c].admits(fitted.coefficients)) continue;
        if (fitted.squares < least) {
          least = fitted.squares;
          inflation = std::max(1.0, fitted.squares / fitted.freedom);
        }
        fits.push_back(std::move(fitted));
      }
    const auto criterion = [&](const FittedForm& fitted) {
      return fitted.squares / inflation +
             static_cast<double>(fitted.form.size()) * std::log(fitted.freedom);
    };
    // The simplest form that the data do not decide against.
    double lowest = HUGE_VAL;
    for (const FittedForm& fitted : fits)
      if (fitted.candidate == number) lowest = std::min(lowest, criterion(fitted));
    const FittedForm* best = nullptr;
    for (const FittedForm& fitted : fits) {
      if (fitted.candidate != number || criterion(fitted) > lowest + kLawThresholds.undecided)
        continue;
      const auto rank = [&](const FittedForm& f) { return std::pair(f.form.size(), criterion(f)); };
      if (!best || rank(fitted) < rank(*best)) best = &fitted;
    }
    if (!best) {
      law.found = false;
      return;
    }
    const auto formula_of = [&](const FittedForm& fitted) {
      return candidates_[fitted.candidate].formula(fitted.form, fitted.coefficients,
                                                   inflation * fitted.covariance);
    };
    for (const FittedForm& fitted : fits)
      if (&fitted != best && criterion(fitted) < criterion(*best) + kLawThresholds.undecided)
        law.rivals.push_back(with_constants(formula_of(fitted)));
    FittedForm found = *best;
    follow(found);
    inflation = std::max(1.0, found.squares / found.freedom);
    law.formula = formula_of(found);
    law.place = arc_length_;
    if (at_end(arc_length_, lengths_.sum())) return;  // the end is a place of its own
    law.place += found.shift;
    if (!(law.place > 0 &&
          law.place < lengths_.sum())) {  // the law does not hold where it was tried
      law.found = false;
      return;
    }
    law.place_deviation = std::sqrt(inflation * found.place_variance);
  }

  ForcePaths& paths_;
  const std::vector<MatrixXd>& found_;
  LinearProblem linear_;
  const VectorXd& lengths_;
  Index coordinates_;
  double arc_length_, apart_;
  std::vector<std::vector<PlaceKinematics>> places_;
  std::vector<std::vector<PlaceMotion>> beside_;
  std::vector<PlaceLaw> candidates_;
};

std::string chance_words(double value) {
  return value <= 1 / (1.0 + kRandomForces) ? fmt::format("chance below {:.2g}", value)
                                            : fmt::format("chance {:.2g}", value);
}

void describe_law(ForceLaw& law) {
  const std::string tested = fmt::format(
      "chosen of {} in the first part of the frames, it explains {:.0f} % of what a force can "
      "explain in the second ({})",
      law.candidates, 100 * std::max(0.0, law.confirmed), chance_words(law.chance));
  if (law.found) {
    law.words.push_back("its law: " + with_constants(law.formula));
    law.words.push_back(tested);
    for (const std::string& rival : law.rivals)
      law.words.push_back("these data do not tell it from: " + rival);
  } else if (law.force.empty()) {
    law.words.push_back("a force in time, no law: none of the candidates explains it");
  } else {
    law.words.push_back(fmt::format("a force in time, no law; the best is {} against {}: {}",
                                    law.force, law.variable, tested));
  }
}

}  // namespace

std::optional<ForceLaw> law_of_force(ForcePaths& paths, const VectorXd& lengths, Index coordinates,
                                     double arc_length) {
  std::vector<MatrixXd> found;
  for (const ForcePath& path : paths.paths()) found.push_back(path.force);
  std::vector<ForcePattern> patterns = paths.patterns();
  double apart = 0;
  if (arc_length > 0) {
    apart = -kApart * arc_length;
    for (const ForceDirection direction : {ForceDirection::kSide, ForceDirection::kDown})
      patterns.push_back(point_pattern(direction, arc_length + apart, lengths));
  }
  paths.act(std::move(patterns));
  std::optional<LinearProblem> linear = paths.linearise(kFiner);
  if (!linear) return std::nullopt;
  ForceLaw law =
      LawSearch(paths, found, std::move(*linear), lengths, coordinates, arc_length, apart).run();
  describe_law(law);
  return law;
}

}  // namespace catena
