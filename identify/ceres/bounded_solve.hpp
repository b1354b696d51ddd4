// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/ceres.h>

#include <Eigen/Core>

namespace catena {

/// ceres::Solve for a problem with the one parameter block `y`, whose `lower` and `upper` bounds
/// (infinite: none) the problem has been told. Ceres takes its step as if there were no bounds and
/// cuts it off at them, after which the rest of the step is no good: at a bound it creeps. Here an
/// unknown that has come to a bound, and would go on beyond it, is held there until the others have
/// converged, and let go if it would then turn back.
ceres::Solver::Summary solve_within_bounds(ceres::Solver::Options settings, ceres::Problem& problem,
                                           Eigen::VectorXd& y, const Eigen::VectorXd& lower,
                                           const Eigen::VectorXd& upper);

}  // namespace catena
