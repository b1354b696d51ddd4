// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

#include "identify/problem/camera.hpp"
#include "identify/problem/experiment.hpp"
#include "runtime/positions.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/trajectory.hpp"

namespace catena {

/// Model times of the frames, where each is in the list of distinct, increasing times that is
/// simulated, and whether the cable is still held then.
struct FrameClock {
  std::vector<double> times;         ///< s, to simulate; the first is the start
  std::vector<Eigen::Index> column;  ///< of each frame, in `times`
  std::vector<bool> held;            ///< of each frame: before the start
};

/// Of the first `frames` frames. `parameters`: the model's array.
FrameClock frame_clock(const Model& model, const Experiment& experiment,
                       const Eigen::VectorXd& parameters, Eigen::Index frames);

/// Reads a motion as the sensors of one experiment do.
class Observer {
 public:
  /// `along`: the directions of which derivatives will be asked for; only their parameters are
  /// read. All three references must outlive the observer. Throws ImpossibleValue for markers
  /// beyond the end of the cable.
  Observer(const Model& model, const Experiment& experiment, const Eigen::VectorXd& parameters,
           const std::vector<SensitivityDirection>& along);

  /// Moves on to the frame at time t (s), which is column `column` of the path.
  void move_to(const Trajectory& path, Eigen::Index column, double t);

  /// From there to the derivatives along direction number `direction`, `sensitivity` those of the
  /// path along it.
  void look_along(const Trajectory& sensitivity, std::size_t direction, bool held);

  /// What was seen last, m or rad.
  double operator()(const Channel& channel) const {
    return seen_[static_cast<std::size_t>(channel.point)]
                [static_cast<std::size_t>(channel.component)];
  }

 private:
  /// Where a point is on the chain. Material points keep their place when the cable bends; those
  /// given by arc length also move along a link whose length changes, with the whole length if they are spread over the
  /// cable, and by what a parameter says of them (marker_places.hpp).
  struct Place {
    MaterialPoint point;
    bool at_arc_length = false;
    double share = 0;                      ///< of the length, of those spread over the cable
    std::optional<Eigen::Index> off = {};  ///< that parameter
    bool load = false;
    std::optional<Camera> camera = {};  ///< in whose picture it is seen
  };
  /// What a sensor tells of a point, or its derivative, in the order of Component: side and down (m),
  /// the angle of its link (rad), which has no meaning in space, and across (m). In a picture: side to
  /// its right and down in it, px times the metres per pixel of the experiment.
  using Sight = std::array<double, 4>;

  static Place place_of(const Model& model, const Eigen::VectorXd& parameters,
                        const PointSpec& point);
  /// What the sensors of the model get to see of a point and what they report of it, or the derivatives
  /// (catena_model.h, observe). Cameras take pictures of what is reported.
  using Report = Eigen::Vector3d;
  Report truth(const CablePoint& point, double angle) const;
  Sight sight(const Report& reported) const;
  Sight in_picture(const Eigen::Vector2d& picture) const;
  catena_point point(const Trajectory& path, const Eigen::VectorXd& signals,
                     const Eigen::VectorXd& p) const;

  const Model& model_;
  const Experiment& experiment_;
  const Eigen::VectorXd& parameters_;
  const std::vector<SensitivityDirection>& directions_;
  std::vector<Place> places_;
  std::vector<std::vector<double>> moved_;  // per direction and place: of points at an arc length
  Eigen::VectorXd accelerations_, signals_, no_signals_;  // positions do not ask for a
  Positions here_, rates_, change_;
  std::vector<Report> true_, reported_;  // per place
  std::vector<Sight> seen_;
  const Trajectory* path_ = nullptr;
  Eigen::Index column_ = 0;
  double t_ = 0;
};

}  // namespace catena
