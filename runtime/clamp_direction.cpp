// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/clamp_direction.hpp"

#include <cmath>
#include <vector>

#include "runtime/state.hpp"

namespace catena {

std::string clamp_without_direction(const Model& model, const Eigen::VectorXd& parameters, double t,
                                    const Signals& signals) {
  // A table for fits has no internal forces that could tell.
  if (!model.in_space() || model.table().internal_forces == nullptr) return "";
  std::vector<double> u(static_cast<std::size_t>(3 * model.signals()));
  signals.evaluate(t, u.data());
  const Eigen::VectorXd a = Eigen::VectorXd::Zero(model.coordinates());
  const Eigen::Index n = model.links();
  // What a joint does is a number for one of three directions of all links at least: it has none only where it is
  // folded back on itself.
  bool support = false, end = !model.held();
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    State state = State::zero(model);
    state.q.head(3 * n).setZero();
    state.q.segment(axis * n, n).setOnes();
    const catena_point at{t,        state.q.data(),   state.v.data(), a.data(), state.z.data(),
                          u.data(), parameters.data()};
    Eigen::VectorXd moment(n), tension(n), curvature(n);
    model.internal_forces(at, moment.data(), tension.data(), curvature.data());
    support = support || std::isfinite(curvature[0]);
    if (!model.held()) continue;
    Eigen::VectorXd force(3 + model.constraints()), moments(3 + model.constraints());
    model.reactions(at, force.data(), moments.data());
    end = end || moments.tail(model.constraints()).allFinite();
  }
  if (!support) return "[support]";
  return end ? "" : "[held_end]";
}

}  // namespace catena
