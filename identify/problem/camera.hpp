// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/cases/case.hpp"
#include "identify/recordings/recording.hpp"
#include "runtime/model.hpp"

namespace catena {

/// The model of a case. Its parameters are followed by eight of every camera of the case: NAME.side,
/// NAME.down, NAME.across (m), NAME.pan, NAME.tilt, NAME.roll (rad), NAME.focal_length (px) and NAME.lens. No
/// equation reads them. A model that has them is returned as it is. Throws InputError for cameras and a model
/// of the plane, and for a camera with the name of one of the model's effects.
Model with_cameras(const Case& the_case, Model model);

/// A pinhole camera. It stands at (side, down, across). With all angles zero it looks along across; its
/// picture then has side to the right and down downwards. Pan turns its axis from across towards side, then
/// tilt turns it downwards, then roll turns the camera about its axis, from right to down. A lens k1 shows
/// what should be r px from the axis at r (1 + k1 r^2 / focal_length^2).
class Camera {
 public:
  /// `model`: with_cameras().
  Camera(const Model& model, const std::string& name);

  /// Where a point (m; side, down, across) is in the picture: to the right and downwards from where the
  /// axis meets it, px. NaN where the point is not in front of the camera, and where the lens would show what is
  /// closer to the axis, too. `parameters`: the model's array.
  Eigen::Vector2d picture(const Eigen::VectorXd& parameters, const Eigen::Vector3d& point) const;

  /// The derivative of picture() along a change `along` of the parameters and a change of the point.
  Eigen::Vector2d picture_tangent(const Eigen::VectorXd& parameters, const Eigen::VectorXd& along,
                                  const Eigen::Vector3d& point,
                                  const Eigen::Vector3d& change) const;

  /// Where it stands (m; side, down, across).
  Eigen::Vector3d place(const Eigen::VectorXd& parameters) const;
  /// The unit vector from the camera towards what it sees at a place of the picture, px.
  Eigen::Vector3d ray(const Eigen::VectorXd& parameters, const Eigen::Vector2d& picture) const;

 private:
  Eigen::Index first_;  // of its parameters
};

/// Of every point of pictures, the index of its marker: points at one place of the cable are one marker,
/// seen by several cameras. Markers count from 0 in the order of the points.
std::vector<int> markers_of(const std::vector<PointSpec>& points);

/// A recording of pictures as one of positions in space. A marker is put where the squares of its distances
/// to the rays of all cameras that see it have the least sum; that of one camera, where its ray meets the plane of
/// side and down. What no camera sees is NaN. Starts are found from it, and recordings are held against the
/// cable by it.
Recording positions_from_pictures(const Recording& pictures, const Model& model,
                                  const Eigen::VectorXd& parameters, double metres_per_pixel);

}  // namespace catena
