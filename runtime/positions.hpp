// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "runtime/model.hpp"
#include "runtime/signals.hpp"

namespace catena {

/// Positions of the chain at one time, m, or their derivatives. Entry 0: the support; entry i: the
/// far end of link i; entry links + 1: the load.
///
///     const Model model = Model::built_in(4);
///     const Eigen::VectorXd parameters = Eigen::VectorXd::Constant(model.parameters(), 0.1);
///     const Eigen::VectorXd angles = Eigen::VectorXd::Constant(4, 0.6);  // rad
///     const Positions at = positions(model, parameters, 0.0, angles);
///     const double load_side = at.side[5], load_down = at.down[5];  // m
///     const CablePoint marker = position_of(at, point_at_arc_length(model, parameters, 0.25));
struct Positions {
  Eigen::VectorXd side;         ///< horizontal
  Eigen::VectorXd down;         ///< along gravity
  Eigen::VectorXd across = {};  ///< horizontal, in space; empty in the plane
};

/// The place of one point (m), or its derivative.
struct CablePoint {
  double side = 0.0;
  double down = 0.0;
  double across = 0.0;  ///< in space; zero in the plane
};

/// Positions by (2.24), (2.25), with the changes that effects make.
///
/// Here and below: `parameters` and `parameters_direction` have one entry per parameter of the
/// model; `q` and `q_direction` one per coordinate (rad for angles); t is in s;
/// `signals` has the channels that the model asks for. Sizes are not checked.
Positions positions(const Model& model, const Eigen::VectorXd& parameters, double t,
                    const Eigen::VectorXd& q, const Signals& signals = {});

/// Derivative of the positions along (parameters_direction, q_direction).
Positions positions_tangent(const Model& model, const Eigen::VectorXd& parameters, double t,
                            const Eigen::VectorXd& q, const Eigen::VectorXd& parameters_direction,
                            const Eigen::VectorXd& q_direction, const Signals& signals = {});

/// A point that moves with the cable: on link `link` (counted from 0), at `fraction` of its length
/// from its upper end (0 to 1).
struct MaterialPoint {
  int link = 0;
  double fraction = 0.0;
};

/// The point at arc length s (m) from the support. Lengths are the nominal ones, length_1 .. of
/// `parameters`. A joint belongs to the link above it. Throws ImpossibleValue unless
/// 0 <= s <= cable length; up to a relative 1e-9 beyond is taken as the end.
MaterialPoint point_at_arc_length(const Model& model, const Eigen::VectorXd& parameters, double s);

/// Derivative of point.fraction when the lengths change along `parameters_direction` and the arc
/// length stays. The link stays too.
double fraction_tangent(const Model& model, const Eigen::VectorXd& parameters,
                        const Eigen::VectorXd& parameters_direction, const MaterialPoint& point);

/// Position of the point (m), between the ends of its link.
CablePoint position_of(const Positions& positions, const MaterialPoint& point);

/// Derivative of position_of, from those of the positions and of the fraction.
CablePoint position_tangent_of(const Positions& positions, const Positions& positions_tangent,
                               const MaterialPoint& point, double fraction_tangent);

}  // namespace catena
