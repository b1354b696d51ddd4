// SPDX-License-Identifier: BSD-3-Clause
#include "truth/camera.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace truth {

double Random::uniform() {
  state_ += 0x9e3779b97f4a7c15ULL;
  std::uint64_t z = state_;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  z ^= z >> 31;
  return (static_cast<double>(z >> 11) + 0.5) * 0x1.0p-53;
}

double Random::normal() {
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return radius * std::cos(2 * std::numbers::pi * uniform());
}

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

  Random random(camera.seed);
  std::vector<int> unseen(markers, 0);
  const double c = std::cos(hidden.camera_tilt), s = std::sin(hidden.camera_tilt);
  const auto pixels = [&](double x) {
    return camera.pixel > 0 ? camera.pixel * std::round(x / camera.pixel) : x;
  };
  for (std::size_t i = 0; i < frames; ++i) {
    std::vector<double> side(markers), down(markers);
    for (std::size_t k = 0; k < markers; ++k) {
      const double sine = std::sin(motion.angle[i][k]), cosine = std::cos(motion.angle[i][k]);
      const double x =
          motion.side[i][k] + hidden.marker_across * cosine + hidden.marker_along * sine;
      const double y =
          motion.down[i][k] - hidden.marker_across * sine + hidden.marker_along * cosine;
      const double seen_side = hidden.scale * (c * x + s * y) + hidden.origin_side;
      const double seen_down = hidden.scale * (c * y - s * x) + hidden.origin_down;
      side[k] = pixels(seen_side + camera.noise * random.normal());
      down[k] = pixels(seen_down + camera.noise * random.normal());
      const double chance = random.uniform();
      if (chance < camera.lost / 2) unseen[k] = 1;
      if (chance > 1 - camera.lost / 20) unseen[k] = 10;
      if (unseen[k] > 0) {
        --unseen[k];
        side[k] = down[k] = std::numeric_limits<double>::quiet_NaN();
      }
    }
    recording.side.push_back(side);
    recording.down.push_back(down);
  }
  return recording;
}

}  // namespace truth
