// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/space_equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/number_text.hpp"
#include "runtime/held_end.hpp"

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

/// A cable between its ends as a catenary; plumb if the end is free.
State first_guess(const Model& model, const VectorXd& parameters, double t,
                  const Signals& signals) {
  State state = State::zero(model);
  if (!model.held()) return state;
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
  return closed_end(model, parameters, state, t, signals);
}

class Search {
 public:
  Search(const Model& model, const VectorXd& parameters, double t, const Signals& signals)
      : model_(model),
        parameters_(parameters),
        t_(t),
        links_(model.links()),
        u_(static_cast<std::size_t>(3 * model.signals())),
        zero_(VectorXd::Zero(std::max(model.coordinates(), model.states()))),
        a_(VectorXd::Zero(model.coordinates())),
        r_(model.coordinates()),
        work_(static_cast<std::size_t>(model.table().newton_work)),
        state_(first_guess(model, parameters, t, signals)) {
    signals.evaluate(t, u_.data());
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
    const Index links = 3 * links_, constraints = model_.coordinates() - links;
    a_.tail(constraints) = a.tail(constraints);
    model_.residual(at(a_), r_.data());
    const VectorXd offset = r_.tail(constraints);
    const auto evaluate = [&] {
      model_.residual(at(a_), r_.data());
      r_.tail(constraints) -= offset;
      return r_.head(links).norm();
    };
    double size = evaluate();
    // In a plumb chain all forces vanish, in numbers too.
    if (size == 0) return Status::kSuccess;
    double weight = a.head(links).cwiseAbs().maxCoeff() / kFirstStep;
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
      const double longest = step.head(links).cwiseAbs().maxCoeff();
      step *= std::min(1.0, kLongestStep / longest);
      state_.q.head(links) += step.head(links);
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
              number_text(size) + " N m are left";
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
  Index links_;
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
  return Search(model, parameters, t, signals).run();
}

}  // namespace catena
