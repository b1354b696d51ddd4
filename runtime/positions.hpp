// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "runtime/model.hpp"
#include "runtime/signals.hpp"

namespace catena {

/// Where the chain is at one time (m): entry 0 the support, i the far end of link i, links + 1 the
/// load.
struct Positions {
  Eigen::VectorXd side;  ///< horizontal
  Eigen::VectorXd down;  ///< along gravity
};

/// Side and down of one point (m), or their derivatives.
struct CablePoint {
  double side = 0.0;
  double down = 0.0;
};

/// (2.24), (2.25) and what effects change of them.
Positions positions(const Model& model, const Eigen::VectorXd& parameters, double t,
                    const Eigen::VectorXd& q, const Signals& signals = {});

/// Derivative of positions along the direction (parameters: dp, coordinates: dq).
Positions positions_tangent(const Model& model, const Eigen::VectorXd& parameters, double t,
                            const Eigen::VectorXd& q, const Eigen::VectorXd& parameters_direction,
                            const Eigen::VectorXd& q_direction, const Signals& signals = {});

/// Velocities of the same points (m/s).
Positions velocities(const Model& model, const Eigen::VectorXd& parameters, double t,
                     const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                     const Signals& signals = {});

/// A point of the cable that is fixed to it: on link `link` (counted from 0), the fraction
/// `fraction` of the link from its upper end.
struct MaterialPoint {
  int link = 0;
  double fraction = 0.0;
};

/// The point at arc length s (m) from the support along the cable at its nominal lengths,
/// parameters length_1 ..; a joint belongs to the link above it. Throws std::invalid_argument
/// unless 0 <= s <= cable length (a relative 1e-9 beyond is taken as the end).
MaterialPoint point_at_arc_length(const Model& model, const Eigen::VectorXd& parameters, double s);

/// Derivative of the fraction when the lengths change along `parameters_direction` and the arc
/// length stays; the link is kept.
double fraction_tangent(const Model& model, const Eigen::VectorXd& parameters,
                        const Eigen::VectorXd& parameters_direction, const MaterialPoint& point);

/// Where the point is, between the ends of its link.
CablePoint position_of(const Positions& positions, const MaterialPoint& point);

/// Its derivative, given that of the positions and of the fraction.
CablePoint position_tangent_of(const Positions& positions, const Positions& positions_tangent,
                               const MaterialPoint& point, double fraction_tangent);

}  // namespace catena
