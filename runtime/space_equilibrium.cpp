// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/space_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "common/number_text.hpp"
#include "runtime/held_end.hpp"
#include "runtime/link_vectors.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kMostSteps = 1000;
constexpr double kLongestStep =
    0.3;  // of a vector of length one: farther the linearisation says little
constexpr double kFirstStep = 0.05;  // likewise, of the first, by inertia alone
constexpr double kNear = 1e-8;       // likewise, where Newton's method may take over
constexpr double kDone = 1e-12;      // likewise, of the last
constexpr double kLeastSpan = 0.05;  // of the length of the cable, of a guess
constexpr double kFastest = 10.0;    // by which 1 / tau^2 changes from step to step

/// A cable whose far end is held at `end`, seen from the support, as a catenary that does not hang lower than
/// its lower end: the rest lies there, as on a floor. No state where a catenary does not hang lower, or where there is
/// more cable than can lie straight.
std::optional<State> lying(const Model& model, const VectorXd& lengths, const Vector3d& end) {
  const double whole = lengths.sum(), height = std::abs(end[1]), span = std::hypot(end[0], end[2]);
  // With the parameter a, `hangs` (a) of the cable is above the floor: height^2 + 2 height a = hangs^2.
  const auto hangs = [&](double a) { return std::sqrt(height * (height + 2 * a)); };
  const auto reach = [&](double a) {
    return whole - hangs(a) + (a > 0 ? a * std::asinh(hangs(a) / a) : 0);
  };
  double loose = 0, tight = (whole * whole - height * height) / (2 * height);
  if (!(height > 0) || !(reach(loose) < span) || !(reach(tight) > span)) return std::nullopt;
  for (int halving = 0; halving < 60; ++halving)
    (reach((loose + tight) / 2) < span ? loose : tight) = (loose + tight) / 2;
  State state = State::zero(model);
  double arc = end[1] > 0 ? 0 : whole;  // of the middle of the link, from the upper end
  for (Index i = 0; i < lengths.size(); ++i) {
    const double middle = std::abs(arc - lengths.head(i).sum() - lengths[i] / 2);
    const double rise = std::max(0.0, hangs(tight) - middle) * (end[1] > 0 ? 1 : -1);
    put(state.q, lengths.size(), i,
        Vector3d(tight * end[0] / span, rise, tight * end[2] / span).normalized());
  }
  return state;
}

/// Shapes to begin with: a cable between its ends as a catenary, which may lie on a floor; plumb if it is not held.
std::vector<State> first_guesses(const Model& model, const VectorXd& parameters, double t,
                                 const Signals& signals) {
  State state = State::zero(model);
  if (!model.held()) return {state};
  // Between several places each piece is bent to half a circle that hangs, and closed.
  if (model.held_links() != std::vector{model.links()})
    return {closed_end(model, parameters, state, t, signals)};
  const VectorXd lengths = parameters.head(model.links());
  std::vector<double> u(static_cast<std::size_t>(3 * model.signals()));
  signals.evaluate(t, u.data());
  Vector3d apart, rate;
  model.gap(
      {t, state.q.data(), state.v.data(), nullptr, state.z.data(), u.data(), parameters.data()},
      apart.data(), rate.data());
  const Vector3d end = lengths.sum() * Vector3d::UnitY() - apart;
  // In a catenary between points of one vertical line all links point up or down, and nothing can move.
  const CablePoint held{std::max(std::hypot(end[0], end[2]), kLeastSpan * lengths.sum()), end[1]};
  if (std::hypot(held.side, held.down) < lengths.sum()) {
    const State flat = catenary(model, parameters, held, CatenaryFit::kChords);
    const double azimuth = std::atan2(end[2], end[0]);
    const Index n = model.links();
    state.q.head(n) = std::cos(azimuth) * flat.q.head(n);
    state.q.segment(n, n) = flat.q.segment(n, n);
    state.q.segment(2 * n, n) = std::sin(azimuth) * flat.q.head(n);
  }
  std::vector<State> guesses{closed_end(model, parameters, state, t, signals)};
  if (const auto on_floor = lying(model, lengths, end))
    guesses.push_back(closed_end(model, parameters, *on_floor, t, signals));
  return guesses;
}

class Search {
 public:
  Search(const Model& model, const VectorXd& parameters, double t, const Signals& signals,
         State guess)
      : model_(model),
        parameters_(parameters),
        t_(t),
        links_(model.links()),
        movable_(model.coordinates() - model.constraints()),
        u_(static_cast<std::size_t>(3 * model.signals())),
        zero_(VectorXd::Zero(std::max(model.coordinates(), model.states()))),
        a_(VectorXd::Zero(model.coordinates())),
        r_(model.coordinates()),
        work_(static_cast<std::size_t>(model.table().newton_work)),
        state_(std::move(guess)) {
    signals.evaluate(t, u_.data());
  }

  /// With which the first guess would begin to move, 1/s^2; infinite where it cannot.
  double acceleration() const {
    VectorXd a(model_.coordinates());
    if (model_.acceleration(at(a), a.data()) != 0 || !a.allFinite())
      return std::numeric_limits<double>::infinity();
    return a.head(3 * links_).cwiseAbs().maxCoeff();
  }

  Equilibrium run() {
    Equilibrium result;
    result.status = steps(result.message);
    result.state = state_;
    result.state.v.setZero();
    return result;
  }

 private:
  Status steps(std::string& message) {
    VectorXd a(model_.coordinates());
    if (model_.acceleration(at(a), a.data()) != 0 || !a.allFinite()) {
      message = "the mass matrix is not positive definite, or the cable is taut";
      return Status::kSingular;
    }
    // What moves an end by a function of time acts on the constraint at all shapes alike.
    const Index constraints = model_.coordinates() - movable_;
    a_.tail(constraints) = a.tail(constraints);
    model_.residual(at(a_), r_.data());
    const VectorXd offset = r_.tail(constraints);
    const auto evaluate = [&] {
      model_.residual(at(a_), r_.data());
      r_.tail(constraints) -= offset;
      return r_.head(movable_).norm();
    };
    double size = evaluate();
    // In a plumb chain all forces vanish, in numbers too.
    if (size == 0) return Status::kSuccess;
    double weight = a.head(movable_).cwiseAbs().maxCoeff() / kFirstStep;
    const double first = size, slowest = 1e-6 * weight;
    for (int count = 0; count < kMostSteps; ++count) {
      if (model_.newton_factor(at(a_), weight, 0.0, 1.0, work_.data()) != 0) {
        weight *= kFastest;
        continue;
      }
      VectorXd step = -r_;
      model_.newton_solve(work_.data(), step.data());
      if (!step.allFinite()) {
        weight *= kFastest;
        continue;
      }
      const VectorXd before = state_.q;
      const double longest = step.head(movable_).cwiseAbs().maxCoeff();
      step *= std::min(1.0, kLongestStep / longest);
      state_.q.head(movable_) += step.head(movable_);
      a_.tail(constraints) += weight * step.tail(constraints);
      normalise();
      const double moved = (state_.q - before).cwiseAbs().maxCoeff();
      const double next = evaluate();
      if (!std::isfinite(next)) break;
      // A shape that may turn freely about the line between its ends moves on by what rounding leaves.
      if (weight <= slowest && (moved <= kDone || (moved <= kNear && next <= kDone * first)))
        return Status::kSuccess;
      // Near the end the residual is rounding and says nothing.
      const double change = moved < kNear            ? 1 / kFastest
                            : longest > kLongestStep ? kFastest
                                                     : next / size;
      weight = std::max(slowest, weight * std::clamp(change, 1 / kFastest, kFastest));
      size = next;
    }
    message = "no equilibrium was found in " + std::to_string(kMostSteps) + " steps; moments of " +
              number_text(size) + " N m are left" + kWithoutEquilibrium;
    return Status::kNoConvergence;
  }

  catena_point at(const VectorXd& a) const {
    return {t_,           state_.q.data(), zero_.data(),      a.data(),
            zero_.data(), u_.data(),       parameters_.data()};
  }

  void normalise() {
    for (Index i = 0; i < links_; ++i) state_.q(Eigen::seqN(i, 3, links_)).normalize();
  }

  const Model& model_;
  const VectorXd& parameters_;
  double t_;
  Index links_, movable_;  ///< movable: the coordinates of links and load
  std::vector<double> u_;
  VectorXd zero_, a_, r_;
  std::vector<double> work_;
  State state_;
};

}  // namespace

Equilibrium space_equilibrium(const Model& model, const VectorXd& parameters, double t,
                              const Signals& signals) {
  if (model.table().structured == 0)
    return {Status::kNoConvergence,
            "an equilibrium in space needs a model with a structured matrix", State::zero(model)};
  std::vector<Search> searches;
  for (State& guess : first_guesses(model, parameters, t, signals))
    searches.emplace_back(model, parameters, t, signals, std::move(guess));
  const bool second_first =
      searches.size() > 1 && searches[1].acceleration() < searches[0].acceleration();
  Equilibrium found = searches[second_first ? 1 : 0].run();
  if (found.status != Status::kSuccess && searches.size() > 1)
    found = searches[second_first ? 0 : 1].run();
  return found;
}

}  // namespace catena
