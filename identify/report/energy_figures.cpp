// SPDX-License-Identifier: BSD-3-Clause
//
// Where the energy is and goes, and whether it adds up.
#include <algorithm>
#include <string>

#include "identify/report/report_figures.hpp"

namespace catena::report {
namespace {

std::string readable(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Stored plus dissipated minus supplied, less the same at the start: zero but for the integrator.
Row imbalance(const Energy& energy) {
  Row sum(energy.time.size(), 0.0);
  for (const EnergyItem& item : energy.items) {
    const double sign = item.kind == "supplied" ? -1 : 1;
    for (std::size_t t = 0; t < sum.size(); ++t) sum[t] += sign * item.value[t];
  }
  const double start = sum.empty() ? 0 : sum.front();
  for (double& value : sum) value -= start;
  return sum;
}

}  // namespace

void add_energy_figures(const Experiment& experiment, std::vector<ReportFigure>& figures) {
  if (!experiment.energy) return;
  const Energy& energy = *experiment.energy;
  const auto add = [&](const std::string& family, Figure figure) {
    figures.push_back({std::move(figure), "energy", family, experiment.name, "", ""});
  };
  Figure figure;
  figure.title = "Energy";
  figure.caption =
      "Stored energies less their value at the start; what has left (dissipated) and entered "
      "(supplied) since.";
  figure.x = {"time", "s"};
  figure.y = {"energy", "J"};
  Row stored(energy.time.size(), 0.0);
  int colour = 1;
  for (const EnergyItem& item : energy.items) {
    const bool is_stored = item.kind == "stored";
    Row value = item.value;
    const double start = is_stored && !value.empty() ? value.front() : 0;
    for (std::size_t t = 0; t < value.size(); ++t) {
      value[t] -= start;
      if (is_stored) stored[t] += value[t];
    }
    const bool nothing = std::all_of(value.begin(), value.end(), [](double v) { return v == 0; });
    if (nothing) continue;
    figure.series.push_back({readable(item.name) + (is_stored ? "" : " (" + item.kind + ")"),
                             energy.time, std::move(value), Mark::kLine, colour++});
  }
  figure.series.push_back({"all stored", energy.time, stored, Mark::kLine, 0});
  add("energy", std::move(figure));

  Figure balance;
  balance.title = "Energy balance";
  balance.caption = "Stored plus dissipated minus supplied, less its value at the start.";
  balance.x = {"time", "s"};
  balance.y = {"imbalance", "J"};
  balance.series.push_back({"imbalance", energy.time, imbalance(energy), Mark::kLine, 1});
  add("energy_balance", std::move(balance));
}

}  // namespace catena::report
