// SPDX-License-Identifier: BSD-3-Clause
#include "truth/camera.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "truth/random.hpp"

namespace truth {

Recording film(const Cable& cable, const Hidden& hidden, const std::vector<double>& start_angles,
               const Camera& camera, const Integration& integration) {
  const auto frames = static_cast<std::size_t>(std::lround(camera.duration * camera.rate)) + 1;
  const auto markers = static_cast<std::size_t>(camera.markers);
  Recording recording;
  std::vector<double> happened;
  for (std::size_t i = 0; i < frames; ++i) {
    const double t = static_cast<double>(i) / camera.rate;
    recording.time.push_back(t);
    happened.push_back(std::max(0.0, t + hidden.clock_offset));
  }
  for (std::size_t k = 1; k <= markers; ++k)
    recording.arc.push_back(cable.length * static_cast<double>(k) / static_cast<double>(markers));
  const Motion motion = move(cable, hidden, start_angles, recording.arc, happened, integration);

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
    for (std::size_t k = 0; k < markers; ++k) {
      if (!seen[i][k]) continue;
      const double sine = std::sin(motion.angle[i][k]), cosine = std::cos(motion.angle[i][k]);
      const double x =
          motion.side[i][k] + hidden.marker_across * cosine + hidden.marker_along * sine;
      const double y =
          motion.down[i][k] - hidden.marker_across * sine + hidden.marker_along * cosine;
      const double seen_side = hidden.scale * (c * x + s * y) + hidden.origin_side;
      const double seen_down = hidden.scale * (c * y - s * x) + hidden.origin_down;
      side[k] = pixels(seen_side + camera.noise * noise[i][k][0]);
      down[k] = pixels(seen_down + camera.noise * noise[i][k][1]);
    }
    recording.side.push_back(side);
    recording.down.push_back(down);
  }
  return recording;
}

}  // namespace truth
