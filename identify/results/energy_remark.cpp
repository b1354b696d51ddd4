// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/energy_remark.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace catena {

std::string energy_remark(const Simulation& simulation) {
  constexpr double kGreatestShare = 0.01;
  constexpr double kRounding = 1e-9;  // of a great energy that hardly changes
  const Eigen::MatrixXd& energy = simulation.trajectory.energy;
  if (energy.size() == 0) return "";
  const double changes = (energy.rowwise().maxCoeff() - energy.rowwise().minCoeff()).maxCoeff();
  const double moved = std::max(changes, kRounding * energy.cwiseAbs().maxCoeff());
  if (!(simulation.energy_imbalance > kGreatestShare * moved)) return "";
  return fmt::format(
      "the energy balance is off by {:.2g} J, {:.0f} % of the {:.2g} J that are converted; "
      "give a smaller relative_tolerance under [simulation]",
      simulation.energy_imbalance, 100 * simulation.energy_imbalance / moved, moved);
}

}  // namespace catena
