// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/sensor_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "identify/forces/place_kinematics.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// Knots of what changes in time; it is zero at the first frame and straight between them.
constexpr Index kKnots = 6;
/// Deviations of the priors; three sizes of each are tried. What cameras do:
constexpr double kBending = 0.1;    // 1, of the scale at a cable's length from the middle
constexpr double kReading = 0.01;   // s, from the support to a cable's length below it
constexpr double kDrifting = 0.01;  // m
constexpr double kSlipping = 0.01;  // m
constexpr double kPriorSizes[] = {0.1, 1, 10};

/// A marker at a frame.
struct Sight {
  std::size_t point = 0;
  double time = 0;  ///< from 0 at the first frame to 1 at the last
  PlaceMotion motion;
};

/// What the error adds to a marker's position, by each of its numbers: components x numbers.
using Added = std::function<MatrixXd(const Sight&)>;

double arc_length_of(const PointSpec& point, const VectorXd& lengths) {
  if (point.load) return lengths.sum();
  if (point.joint > 0) return lengths.head(point.joint).sum();
  return point.arc_length;
}

/// Its place among side, down and across; nothing for angles.
std::optional<Index> component_of(const Channel& channel) {
  if (channel.component == Component::kAngle) return std::nullopt;
  return channel.component == Component::kAcross ? 2 : channel.component == Component::kDown;
}

/// At a time, of each knot but the first.
Eigen::RowVectorXd hats(double time) {
  Eigen::RowVectorXd values(kKnots);
  for (Index j = 0; j < kKnots; ++j)
    values[j] = std::max(
        0.0, 1 - std::abs(time * static_cast<double>(kKnots) - static_cast<double>(j + 1)));
  return values;
}

SensorError make_error(const ForcePaths& paths, const LinkChain& chain, std::string name,
                       double deviation, const Added& added) {
  SensorError error{std::move(name), deviation, {}};
  for (std::size_t r = 0; r < paths.paths().size(); ++r) {
    const ForcePath& path = paths.paths()[r];
    const Recording& recording = paths.recording(r);
    const double begin = recording.time.front();
    const double end = recording.time[static_cast<std::size_t>(recording.fit_frames - 1)];
    const double span = end > begin ? end - begin : 1;  // of one frame
    std::vector<MatrixXd>& nodes = error.columns.emplace_back();
    const auto values = paths.seen_values(r);
    for (std::size_t node = 0; node < values.size(); ++node) {
      MatrixXd& columns = nodes.emplace_back();
      for (std::size_t i = 0; i < values[node].size(); ++i) {
        const Channel& channel = recording.channels[values[node][i].channel];
        const auto point = static_cast<std::size_t>(channel.point);
        const Sight sight{
            point, (recording.time[static_cast<std::size_t>(values[node][i].frame)] - begin) / span,
            place_kinematics(path.state.col(static_cast<Index>(node)), paths.coordinates(), chain,
                             arc_length_of(recording.points[point], chain.lengths))
                .motion};
        const MatrixXd all = added(sight) / paths.sigma(r);
        if (columns.size() == 0)
          columns.setZero(static_cast<Index>(values[node].size()), all.cols());
        columns.row(static_cast<Index>(i)) = all.row(*component_of(channel));
      }
    }
  }
  return error;
}

}  // namespace

std::vector<SensorError> sensor_errors(const ForcePaths& paths, const LinkChain& chain) {
  std::vector<std::string> names;  // of the markers, in the order of the recordings' columns
  for (std::size_t r = 0; r < paths.paths().size(); ++r) {
    const std::vector<PointSpec>& points = paths.recording(r).points;
    for (const Channel& channel : paths.recording(r).channels)
      if (!component_of(channel) || !points[static_cast<std::size_t>(channel.point)].camera.empty())
        return {};
    for (std::size_t point = names.size(); point < points.size(); ++point)
      names.push_back(points[point].name);
  }
  const double length = chain.lengths.sum();
  const Index components = chain.in_space ? 3 : 2;
  std::vector<SensorError> errors;
  const auto add = [&](std::string name, double deviation, const Added& added) {
    errors.push_back(make_error(paths, chain, std::move(name), deviation, added));
  };
  if (chain.in_space) {
    // To first order a map of space that keeps lines straight: what cameras give whose calibration is off.
    add("the calibration of the cameras is off", kBending, [&](const Sight& sight) {
      const ChainVector at = sight.motion.position / length;
      MatrixXd by = MatrixXd::Zero(3, 12);
      for (Index i = 0; i < 3; ++i) {
        by.col(i) = at * at[i];
        by.row(i).segment<3>(3 + 3 * i) = at.transpose();
      }
      return MatrixXd(length * by);
    });
  } else {
    add("the lens bends lines, or the camera looks at a slant", kBending, [&](const Sight& sight) {
      const Vector2d at = sight.motion.position / length, from = at - Vector2d(0, 0.5);
      MatrixXd by(2, 3);
      by << at * at[0], at * at[1], from * from.squaredNorm();
      return MatrixXd(length * by);
    });
    add("the picture is read line by line (rolling shutter)", kReading, [&](const Sight& sight) {
      return MatrixXd(sight.motion.velocity * sight.motion.position[1] / length);
    });
  }
  add(chain.in_space ? "the axes drift" : "the camera drifts", kDrifting, [&](const Sight& sight) {
    MatrixXd by = MatrixXd::Zero(components, components * kKnots);
    for (Index i = 0; i < components; ++i) by.row(i).segment(i * kKnots, kKnots) = hats(sight.time);
    return by;
  });
  for (std::size_t point = 0; point < names.size(); ++point)
    add(fmt::format("{} slips along the cable", names[point]), kSlipping, [&](const Sight& sight) {
      if (sight.point != point) return MatrixXd(MatrixXd::Zero(components, kKnots));
      return MatrixXd(sight.motion.along * hats(sight.time));
    });
  return errors;
}

double log_evidence_of(const SensorError& error, const LinearProblem& linear) {
  LinearProblem with = linear;
  Index numbers = 0;
  for (const auto& nodes : error.columns)
    for (const MatrixXd& columns : nodes) numbers = std::max(numbers, columns.cols());
  const auto widen = [&](MatrixXd& by_parameter) {
    by_parameter.conservativeResizeLike(
        MatrixXd::Zero(by_parameter.rows(), by_parameter.cols() + numbers));
  };
  for (std::size_t r = 0; r < with.recordings.size(); ++r) {
    LinearRecording& recording = with.recordings[r];
    const Index own = recording.own_mean.size() + numbers;
    recording.own_mean.conservativeResizeLike(VectorXd::Zero(own));
    recording.own_deviation.conservativeResize(own);
    widen(recording.start_by_parameter);
    for (LinearRecording::Step& step : recording.steps) widen(step.by_parameter);
    for (std::size_t node = 0; node < recording.seen.size(); ++node) {
      widen(recording.seen[node].by_parameter);
      const MatrixXd& columns = error.columns[r][node];
      if (columns.size() > 0) recording.seen[node].by_parameter.rightCols(numbers) = columns;
    }
  }
  double best = -HUGE_VAL;
  for (const double size : kPriorSizes) {
    for (LinearRecording& recording : with.recordings)
      recording.own_deviation.tail(numbers).setConstant(size * error.deviation);
    best = std::max(best, smooth_forces(with, {}, {}, {}, false).log_evidence);
  }
  return best;
}

}  // namespace catena
