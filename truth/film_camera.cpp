// SPDX-License-Identifier: BSD-3-Clause
#include "truth/film_camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "truth/random.hpp"

namespace truth {

namespace {

constexpr std::uint64_t kPlacesSeed = 0x5eed;  // other numbers than the noise has

/// Where the marks really are.
std::vector<double> marked_places(const Camera& camera, std::vector<double> meant) {
  Random random(camera.seed ^ kPlacesSeed);
  for (std::size_t k = 0; k + 1 < meant.size(); ++k)
    meant[k] = std::clamp(meant[k] + camera.misplaced * random.normal(), 0.0, meant.back());
  return meant;
}

/// As it is when its line of the picture is read: between the beginning and the end of a frame.
Motion as_read(const Motion& twice, double length) {
  Motion motion;
  motion.arc = twice.arc;
  for (std::size_t i = 0; i + 1 < twice.time.size(); i += 2) {
    motion.time.push_back(twice.time[i]);
    std::vector<double> side, down, angle;
    for (std::size_t k = 0; k < twice.arc.size(); ++k) {
      const double u = twice.down[i][k] / length;
      const auto between = [&](const std::vector<std::vector<double>>& x) {
        return (1 - u) * x[i][k] + u * x[i + 1][k];
      };
      side.push_back(between(twice.side));
      down.push_back(between(twice.down));
      angle.push_back(between(twice.angle));
    }
    motion.side.push_back(side);
    motion.down.push_back(down);
    motion.angle.push_back(angle);
  }
  return motion;
}

}  // namespace

Recording film(const Cable& cable, const Hidden& hidden, const std::vector<double>& start_angles,
               const Camera& camera, const Integration& integration) {
  const Moves moves = [&](const std::vector<double>& arc, const std::vector<double>& time) {
    return move(cable, hidden, start_angles, arc, time, integration);
  };
  return film(cable, hidden, moves, camera);
}

Recording film(const Cable& cable, const Hidden& hidden, const Moves& moves, const Camera& camera) {
  const auto frames = static_cast<std::size_t>(std::lround(camera.duration * camera.rate)) + 1;
  const auto markers = static_cast<std::size_t>(camera.markers);
  Recording recording;
  std::vector<double> happened;
  for (std::size_t i = 0; i < frames; ++i) {
    const double t = static_cast<double>(i) / camera.rate;
    recording.time.push_back(t);
    happened.push_back(std::max(0.0, t + hidden.clock_offset));
    if (camera.shutter > 0) happened.push_back(happened.back() + camera.shutter);
  }
  for (std::size_t k = 1; k <= markers; ++k)
    recording.arc.push_back(cable.length * static_cast<double>(k) / static_cast<double>(markers));
  Motion motion = moves(marked_places(camera, recording.arc), happened);
  if (camera.shutter > 0) motion = as_read(motion, cable.length);

  // In this order, so that a seed gives the same recording whatever the kind of the noise.
  Random random(camera.seed);
  NoiseTable noise(frames);
  std::vector<std::vector<bool>> seen(frames);
  std::vector<int> unseen(markers, 0);
  for (std::size_t i = 0; i < frames; ++i)
    for (std::size_t k = 0; k < markers; ++k) {
      const double side = random.normal();
      noise[i].push_back({side, random.normal()});
      const double chance = random.uniform();
      if (chance < camera.lost / 2) unseen[k] = 1;
      if (chance > 1 - camera.lost / 20) unseen[k] = 10;
      seen[i].push_back(unseen[k] == 0);
      if (unseen[k] > 0) --unseen[k];
    }
  noise = noise_of_kind(std::move(noise), camera.kind, camera.seed);

  const double c = std::cos(hidden.camera_tilt), s = std::sin(hidden.camera_tilt);
  const auto pixels = [&](double x) {
    return camera.pixel > 0 ? camera.pixel * std::round(x / camera.pixel) : x;
  };
  constexpr double kNotSeen = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < frames; ++i) {
    std::vector<double> side(markers, kNotSeen), down(markers, kNotSeen);
    const double passed = frames > 1 ? static_cast<double>(i) / static_cast<double>(frames - 1) : 0;
    for (std::size_t k = 0; k < markers; ++k) {
      if (!seen[i][k]) continue;
      const double sine = std::sin(motion.angle[i][k]), cosine = std::cos(motion.angle[i][k]);
      const double slid = static_cast<int>(k) + 1 == camera.slipping ? camera.slip * passed : 0;
      const double x =
          motion.side[i][k] + hidden.marker_across * cosine + (hidden.marker_along + slid) * sine;
      const double y =
          motion.down[i][k] - hidden.marker_across * sine + (hidden.marker_along + slid) * cosine;
      double seen_side =
          hidden.scale * (c * x + s * y) + hidden.origin_side + camera.drift * passed;
      double seen_down = hidden.scale * (c * y - s * x) + hidden.origin_down;
      const double middle = cable.length / 2, from_middle = seen_down - middle;
      const double farther = camera.lens * (seen_side * seen_side + from_middle * from_middle) /
                             (cable.length * cable.length);
      seen_side += farther * seen_side;
      seen_down += farther * from_middle;
      side[k] = pixels(seen_side + camera.noise * noise[i][k][0]);
      down[k] = pixels(seen_down + camera.noise * noise[i][k][1]);
    }
    recording.side.push_back(side);
    recording.down.push_back(down);
  }
  return recording;
}

}  // namespace truth
