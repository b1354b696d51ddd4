// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/forces_everywhere.hpp"

#include <fmt/format.h>

#include <utility>

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

std::vector<ForcePattern> forces_everywhere(const ChainMeasures& chain) {
  const Index links = chain.lengths.size();
  const VectorXd middles = link_middles(chain.lengths);
  // The middle of a link or two must be nearer to each of them than the next place is.
  const int places = 2 * links > kForcePlaces ? kForcePlaces : static_cast<int>(links);
  const double apart = chain.length / places;
  std::vector<ForcePattern> patterns;
  const auto add = [&](ForcePattern pattern) {
    pattern.group = static_cast<int>(patterns.size());
    patterns.push_back(std::move(pattern));
  };
  for (const ForceDirection direction : force_directions(chain.in_space)) {
    add(density_pattern(direction, "constant along the cable", VectorXd::Ones(links), chain));
    add(density_pattern(direction, "linear along the cable",
                        (2 / chain.length * middles.array() - 1).matrix(), chain));
    for (int k = 1; k <= places; ++k) {
      const double s = k * apart;
      const VectorXd tent = (1 - (middles.array() - s).abs() / apart).cwiseMax(0.0).matrix();
      add(density_pattern(direction, fmt::format("around arc length {:.3g} m", s), tent, chain));
    }
    add(point_pattern(direction, chain.length, chain));
  }
  for (ForcePattern& pattern : moment_patterns(0, chain)) add(std::move(pattern));
  return patterns;
}

}  // namespace catena
