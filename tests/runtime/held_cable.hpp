// SPDX-License-Identifier: BSD-3-Clause
//
// A cable that is held at its end, at a joint, or at both, for tests.
#pragma once

#include "runtime/held_end.hpp"
#include "tests/runtime/space_cable.hpp"

namespace testing {

/// The link whose far end HELD_JOINT and HELD_TWICE hold.
inline constexpr int kHeldJoint = 6;

/// Between the support and (0.7, 0.2, 0.1), where the end swings; m. What holds a joint is at (0.4, 0.15, -0.1).
inline VectorXd swung(const Model& model) {
  VectorXd p = cable(model, 0.02, 1e-3);
  if (model.held_links().back() == kHeldJoint) {
    set(model, p, "holds_joint.to_side", 0.4);
    set(model, p, "holds_joint.to_down", 0.15);
    set(model, p, "holds_joint.to_across", -0.1);
    set(model, p, "holds_joint.amplitude", 0.07);
    set(model, p, "holds_joint.frequency", 0.9);
  }
  if (model.held_links().front() != model.links()) return p;
  set(model, p, "holds_end.to_side", 0.7);
  set(model, p, "holds_end.to_down", 0.2);
  set(model, p, "holds_end.to_across", 0.1);
  set(model, p, "holds_end.amplitude", 0.15);
  set(model, p, "holds_end.frequency", 1.3);
  return p;
}

inline State closed(const Model& model, const VectorXd& p, const State& open) {
  return closed_end(model, p, open, 0, {});
}

inline VectorXd gap(const Model& model, const VectorXd& p, const VectorXd& q, const VectorXd& v,
                    double t) {
  VectorXd apart(model.constraints()), rate(model.constraints());
  model.gap({t, q.data(), v.data(), nullptr, nullptr, nullptr, p.data()}, apart.data(),
            rate.data());
  return apart;
}

}  // namespace testing
