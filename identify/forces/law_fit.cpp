// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Fits in which the force follows the state; more where there are numbers to be found, at most so many of
/// their steps at a time, until they move by less than such a part of one.
constexpr int kClosedLoops = 3, kMostLoops = 16;
constexpr double kMostSteps = 5, kSettledStep = 0.01;

}  // namespace

std::vector<LawMotion> motions_of(const ForcePaths& paths) {
  std::vector<LawMotion> motions;
  for (std::size_t r = 0; r < paths.paths().size(); ++r)
    motions.push_back({paths.paths()[r].state, paths.times(r)});
  return motions;
}

LinearProblem LawFit::with_memory(const CandidateLaw& law) const {
  LinearProblem linear = linear_;
  const std::vector<LawMotion> along = motions_of(paths_);
  for (std::size_t r = 0; r < along.size(); ++r)
    linear.recordings[r] = law.memory().added_to(linear_.recordings[r], along[r], chain_);
  return linear;
}

std::vector<NodeForces> LawFit::forces_of(const CandidateLaw& law, const std::vector<int>& form,
                                          const VectorXd& coefficients) const {
  std::vector<NodeForces> forces;
  const bool known = coefficients.size() > 0;
  const auto terms = static_cast<Index>(form.size());
  // Downwards: a place at the end has nothing beyond it.
  const VectorXd numbers = law.numbers(form), steps = -law.steps(form);
  std::vector<CandidateLaw> beside;
  for (Index i = 0; known && i < numbers.size(); ++i)
    beside.push_back(
        law.with(form, numbers + steps[i] * VectorXd::Unit(numbers.size(), i)).value_or(law));
  for (const LawMotion& motion : motions_of(paths_)) {
    NodeForces& of_recording = forces.emplace_back();
    const MatrixXd states = law.memory().along(motion, chain_);
    std::vector<MatrixXd> states_beside;
    states_beside.reserve(beside.size());
    for (const CandidateLaw& other : beside)
      states_beside.push_back(other.memory().along(motion, chain_));
    for (Index k = 0; k < states.cols(); ++k) {
      VectorXd state = states.col(k);
      MatrixXd& columns = of_recording.columns.emplace_back(
          chain_.turns(), terms + static_cast<Index>(beside.size()));
      columns.leftCols(terms) = law.force(state, form);
      if (!known) continue;
      const VectorXd here = columns.leftCols(terms) * coefficients;
      for (std::size_t i = 0; i < beside.size(); ++i) {
        const auto number = static_cast<Index>(i);
        columns.col(terms + number) =
            (beside[i].force(states_beside[i].col(k), form) * coefficients - here) / steps[number];
      }
      constexpr double kDifference = 1e-7;  // rad, rad/s
      MatrixXd& by_state =
          of_recording.by_state.emplace_back(MatrixXd::Zero(chain_.turns(), state.size()));
      const auto differentiate = [&](Index i) {
        const double value = state[i];
        state[i] += kDifference;
        by_state.col(i) = (law.force(state, form) * coefficients - here) / kDifference;
        state[i] = value;
      };
      // As many coordinates of the links as turns.
      for (Index i = 0; i < chain_.turns(); ++i) differentiate(i);
      if (law.sticks(form))
        by_state.middleCols(chain_.coordinates, chain_.turns()) =
            law.resistance(state, form, coefficients);
      else
        for (Index i = 0; law.follows_rates() && i < chain_.turns(); ++i)
          differentiate(chain_.coordinates + i);
      for (Index i = motion.state.rows(); i < state.size(); ++i) differentiate(i);
    }
  }
  return forces;
}

FittedForm LawFit::fit(const FittedForm& begin, FrameHalf half) const {
  CandidateLaw law = begin.law;
  const std::vector<int>& form = begin.form;
  FittedForm best{.law = law, .form = form};
  const auto terms = static_cast<Index>(form.size());
  const Index numbers = law.numbers(form).size();
  VectorXd coefficients = begin.coefficients;
  for (int loop = 0; loop <= (numbers > 0 ? kMostLoops : kClosedLoops); ++loop) {
    const bool open = coefficients.size() == 0;
    const LawPart part = law_part(with_memory(law), forces_of(law, form, coefficients), half);
    MatrixXd columns(part.value.size(), part.forces.cols() + 1);
    columns << part.forces, part.value;
    const MatrixXd left = without_nuisance(part, std::move(columns));
    const VectorXd value = left.rightCols(1);
    const MatrixXd laws = left.leftCols(part.forces.cols());
    coefficients = least_squares(MatrixXd(laws.leftCols(terms)), value);
    if (!coefficients.allFinite()) break;
    if (open) continue;
    // Those before were not of a force that follows the state as it does with them.
    const double squares = (value - laws.leftCols(terms) * coefficients).squaredNorm();
    if (loop >= kClosedLoops && (squares < best.squares || numbers == 0)) {
      best.law = law;
      best.coefficients = coefficients;
      best.squares = squares;
      best.without = value.squaredNorm();
      best.freedom = static_cast<double>(part.seen - laws.cols());
      best.covariance = inverse(laws.transpose() * laws);
      // What the data do not determine has no error bound.
      if (!best.covariance.allFinite() || best.covariance.diagonal().minCoeff() < 0)
        best.covariance = VectorXd::Constant(laws.cols(), HUGE_VAL).asDiagonal();
    }
    if (numbers == 0) continue;
    const VectorXd all = least_squares(laws, value);
    VectorXd moved = all.tail(numbers);
    const double most = moved.cwiseQuotient(law.steps(form)).cwiseAbs().maxCoeff();
    if (!(most > kSettledStep) && loop >= kClosedLoops) break;
    const double part_of_it = std::min(1.0, kMostSteps / most);
    std::optional<CandidateLaw> next = law.with(form, law.numbers(form) + part_of_it * moved);
    if (!next && loop >= kClosedLoops) break;
    if (!next) continue;  // no law has those numbers: the coefficients alone are fitted
    law = std::move(*next);
    coefficients += part_of_it * (all.head(terms) - coefficients);
  }
  return best;
}

FittedForm LawFit::fit_without_drive(const FittedForm& begin, FrameHalf half) const {
  FittedForm fitted = fit(begin, half);
  while (fitted.law.has_pieces(fitted.form) && fitted.form.size() > 1 &&
         std::isfinite(fitted.squares)) {
    Index most = 0;
    if (!(fitted.coefficients.maxCoeff(&most) > 0)) break;
    std::vector<int> form = fitted.form;
    form.erase(form.begin() + most);
    fitted = fit({.law = fitted.law, .form = form}, half);
  }
  return fitted;
}

}  // namespace catena
