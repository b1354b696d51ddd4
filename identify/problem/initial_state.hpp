// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "identify/cases/case.hpp"
#include "identify/recordings/recording.hpp"

namespace catena {

/// Coefficients of a shape of the angles: 1, links or terms; 0 for catenary and hanging.
int coefficient_count(Shape shape, int links, int terms);

/// The linear map from coefficients to the angle (or rate) of each link: links x coefficients.
/// `lengths`: of the links, m.
Eigen::MatrixXd shape_basis(Shape shape, int links, int terms, const Eigen::VectorXd& lengths);

/// Angles of the links at the start, rad, for the shapes that have coefficients.
Eigen::VectorXd initial_angles(const InitialSpec& initial, const Eigen::VectorXd& lengths);
/// Their rates, rad/s.
Eigen::VectorXd initial_rates(const InitialSpec& initial, const Eigen::VectorXd& lengths);

/// Finds the coefficients that are not given from the first frames of a recording: angles through
/// the first frame (least squares on the positions, with the least bending that explains them),
/// rates from a line through the first few frames. Throws InputError if the recording has nothing
/// there.
void complete_from_data(InitialSpec& initial, const Recording& recording,
                        const Eigen::VectorXd& lengths);

}  // namespace catena
