// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/forces/force_path.hpp"

namespace catena {

/// An error of the camera that a recording may have instead of a force on the chain: what it adds
/// to what is seen, linear in numbers of each recording with a normal prior.
struct SensorError {
  std::string name;                                   ///< "marker 3 slips along the cable"
  double deviation = 0;                               ///< of each number, in its unit
  std::vector<std::vector<Eigen::MatrixXd>> columns;  ///< [recording][node]: values x numbers
};

/// The lens and the direction of the camera, a picture that is read line by line, a camera that
/// drifts, and each marker that slips along the cable; about the motion of the paths. Of positions in space: axes that
/// drift, a calibration that maps straight lines to straight lines but no more, and slipping markers. None where a
/// recording has angles, or pictures of cameras in space.
std::vector<SensorError> sensor_errors(const ForcePaths& paths, const LinkChain& chain);

/// The largest log evidence of a problem with the error and without forces, over three sizes of its
/// prior.
double log_evidence_of(const SensorError& error, const LinearProblem& linear);

}  // namespace catena
