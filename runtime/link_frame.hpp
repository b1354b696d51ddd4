// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace catena {

/// The direction of a link in space and how it changes with its coordinates; components side, down,
/// across. The link leaves the downward vertical by `angle` (rad) in the vertical plane of `azimuth`
/// (rad, from side to across), and that plane by `out_of_plane` (rad) towards growing azimuth. Exact for
/// a link in the plane of side and down: azimuth and out_of_plane zero.
struct LinkFrame {
  /// All in rad.
  LinkFrame(double angle, double out_of_plane, double azimuth)
      : sine(std::sin(out_of_plane)), cosine(std::cos(out_of_plane)) {
    const Eigen::Vector3d towards(std::cos(azimuth), 0.0, std::sin(azimuth));
    const Eigen::Vector3d down = Eigen::Vector3d::UnitY();
    in_plane = std::sin(angle) * towards + std::cos(angle) * down;
    turned_in_plane = std::cos(angle) * towards - std::sin(angle) * down;
    normal = {-towards[2], 0.0, towards[0]};
  }

  /// The unit vector along the link, and its derivatives by two of the angles.
  Eigen::Vector3d direction() const { return cosine * in_plane + sine * normal; }
  Eigen::Vector3d by_angle() const { return cosine * turned_in_plane; }
  Eigen::Vector3d by_out_of_plane() const { return cosine * normal - sine * in_plane; }
  /// How a vector that turns with the azimuth changes.
  static Eigen::Vector3d by_azimuth(const Eigen::Vector3d& vector) {
    return {-vector[2], 0.0, vector[0]};
  }

  double sine, cosine;                                // of out_of_plane
  Eigen::Vector3d in_plane, turned_in_plane, normal;  // of the vertical plane
};

}  // namespace catena
