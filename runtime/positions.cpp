// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/positions.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/impossible_value.hpp"
#include "common/number_text.hpp"

namespace catena {
namespace {

/// A point of the table for functions that read q, u and p; zeros for the rest.
struct Reading {
  Reading(const Model& model, const Signals& signals, double t)
      : u(static_cast<std::size_t>(3 * signals.count())),
        zero(static_cast<std::size_t>(std::max(
            {model.coordinates(), model.states(), 3 * model.signals(), model.parameters()}))) {
    signals.evaluate(t, u.data());
  }

  catena_point at(double t, const Eigen::VectorXd& q, const Eigen::VectorXd& parameters) const {
    return {t, q.data(), zero.data(), zero.data(), zero.data(), u.data(), parameters.data()};
  }

  std::vector<double> u, zero;
};

Positions empty_positions(const Model& model) {
  const Eigen::Index points = model.links() + 2;
  return {Eigen::VectorXd(points), Eigen::VectorXd(points),
          Eigen::VectorXd(model.in_space() ? points : 0)};
}

}  // namespace

Positions positions(const Model& model, const Eigen::VectorXd& parameters, double t,
                    const Eigen::VectorXd& q, const Signals& signals) {
  const Reading reading(model, signals, t);
  const catena_point at = reading.at(t, q, parameters);
  Positions result = empty_positions(model);
  model.positions(at, result.side.data(), result.down.data());
  if (model.in_space()) model.positions_across(at, result.across.data());
  return result;
}

Positions positions_tangent(const Model& model, const Eigen::VectorXd& parameters, double t,
                            const Eigen::VectorXd& q, const Eigen::VectorXd& parameters_direction,
                            const Eigen::VectorXd& q_direction, const Signals& signals) {
  const Reading reading(model, signals, t);
  const catena_point at = reading.at(t, q, parameters);
  const double* zero = reading.zero.data();
  const catena_point along{0.0,  q_direction.data(),         zero, zero, zero,
                           zero, parameters_direction.data()};
  Positions result = empty_positions(model);
  model.positions_tangent(at, along, result.side.data(), result.down.data());
  if (model.in_space()) model.positions_across_tangent(at, along, result.across.data());
  return result;
}

MaterialPoint point_at_arc_length(const Model& model, const Eigen::VectorXd& parameters, double s) {
  const auto lengths = parameters.head(model.links());  // the table begins with length_1 ..
  const double whole = lengths.sum();
  if (!(s >= 0.0) || s > whole * (1.0 + 1e-9))
    throw ImpossibleValue("arc length " + number_text(s) +
                          " m is not on the cable, which reaches from 0 to " + number_text(whole) +
                          " m");
  int link = 0;
  double before = 0.0;
  while (link + 1 < model.links() && s > before + lengths[link]) before += lengths[link++];
  return {link, std::min((s - before) / lengths[link], 1.0)};
}

double fraction_tangent(const Model& model, const Eigen::VectorXd& parameters,
                        const Eigen::VectorXd& parameters_direction, const MaterialPoint& point) {
  // s = sum_{k < i} l_k + fraction l_i stays as it is.
  const auto direction = parameters_direction.head(model.links());
  return -(direction.head(point.link).sum() + point.fraction * direction[point.link]) /
         parameters[point.link];
}

CablePoint position_of(const Positions& at, const MaterialPoint& point) {
  const int i = point.link;
  const auto between = [&](const Eigen::VectorXd& ends) {
    return ends[i] + point.fraction * (ends[i + 1] - ends[i]);
  };
  return {between(at.side), between(at.down), at.across.size() ? between(at.across) : 0.0};
}

CablePoint position_tangent_of(const Positions& at, const Positions& tangent,
                               const MaterialPoint& point, double fraction_tangent) {
  const int i = point.link;
  const CablePoint moved = position_of(tangent, point);
  const auto along_link = [&](const Eigen::VectorXd& ends) {
    return fraction_tangent * (ends[i + 1] - ends[i]);
  };
  return {moved.side + along_link(at.side), moved.down + along_link(at.down),
          moved.across + (at.across.size() ? along_link(at.across) : 0.0)};
}

}  // namespace catena
