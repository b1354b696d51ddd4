// SPDX-License-Identifier: BSD-3-Clause
//
// Tension of the links and moments of the joints over time.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "identify/report/report_figures.hpp"

namespace catena::report {
namespace {

struct Quantity {
  const char *name, *unit, *place;  ///< "tension", "N", "link"
  const char* sign;                 ///< what a positive value is
  bool either_sign;                 ///< negative values are as usual as positive ones
};

/// The first, the middle and the last place, as lines.
Figure lines(const Quantity& quantity, const Rows& rows, const Row& time) {
  Figure figure;
  figure.title = fmt::format("{} of three {}s", quantity.name, quantity.place);
  figure.title.front() = static_cast<char>(std::toupper(figure.title.front()));
  figure.caption = quantity.sign;
  figure.x = {"time", "s"};
  figure.y = {quantity.name, quantity.unit};
  std::vector<std::size_t> places = {0, rows.size() / 2, rows.size() - 1};
  places.erase(std::unique(places.begin(), places.end()), places.end());
  int colour = 1;
  for (const std::size_t i : places)
    figure.series.push_back(
        {fmt::format("{} {}", quantity.place, i + 1), time, rows[i], Mark::kLine, colour++});
  return figure;
}

/// All places.
Figure map(const Quantity& quantity, const Rows& rows, const Row& time) {
  Figure figure;
  figure.title = fmt::format("{} along the cable", quantity.name);
  figure.title.front() = static_cast<char>(std::toupper(figure.title.front()));
  figure.caption = quantity.sign;
  figure.x = {"time", "s"};
  HeatMap& heat_map = figure.heat_map.emplace();
  heat_map.x = time;
  heat_map.value = rows;
  for (std::size_t i = 1; i <= rows.size(); ++i)
    heat_map.rows.push_back(fmt::format("{} {}", quantity.place, i));
  heat_map.scale = {quantity.name, quantity.unit};
  heat_map.is_signed = quantity.either_sign;
  return figure;
}

}  // namespace

void add_force_figures(const Experiment& experiment, std::vector<ReportFigure>& figures) {
  if (!experiment.forces) return;
  const Row& time = experiment.trajectory.time;
  const auto add = [&](const Quantity& quantity, const Rows& rows) {
    if (rows.empty()) return;
    const std::string family = quantity.name;
    figures.push_back({lines(quantity, rows, time), "forces", family, experiment.name, "", ""});
    figures.push_back(
        {map(quantity, rows, time), "forces", family + "_map", experiment.name, "", ""});
  };
  add({"tension", "N", "link", "At the upper end of each link. Positive values pull.", false},
      experiment.forces->tension);
  add({"moment", "N m", "joint",
       "On the link below, from the one above. Joint 1 is the support. Positive values turn "
       "towards growing angles.",
       true},
      experiment.forces->moment);
}

}  // namespace catena::report
