// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/missing_force_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Share of the prior variance that data must take away from a pattern that they resolve.
constexpr double kResolved = 0.5;

/// Where a history is strongest: row and time.
struct Strongest {
  Index row = 0, time = 0;
};
Strongest strongest_of(const MatrixXd& side, const MatrixXd& down) {
  Strongest at;
  (side.array().square() + down.array().square()).maxCoeff(&at.row, &at.time);
  return at;
}

std::string sized(double value, double deviation, const std::string& unit) {
  return fmt::format("{:.3g} {} ({:.3g} to {:.3g})", value, unit, value - 1.96 * deviation,
                     value + 1.96 * deviation);
}

/// "side", "down" or both, by what most of the mean square is.
std::string direction_of(double side, double down) {
  constexpr double kMost = 0.8;
  if (side > kMost * (side + down)) return "a side force";
  if (down > kMost * (side + down)) return "a force up or down";
  return "a force";
}

void describe_place(MissingForce& missing) {
  const MissingForce::Place& best = *missing.best;
  const MissingForce::History* where = &missing.at_best.front();
  Strongest at;
  const std::vector<std::string>& rows = where->rows;
  VectorXd squares = VectorXd::Zero(static_cast<Index>(rows.size()));
  double most = -1;
  for (const MissingForce::History& history : missing.at_best) {
    squares += history.size.rowwise().squaredNorm();
    Strongest here;
    const double size = history.size.colwise().norm().maxCoeff(&here.time);
    if (size > most) most = size, where = &history, at = here;
  }
  const bool torque = best.joint >= 0;
  squares.maxCoeff(&at.row);
  const auto of = [&](const char* name) {
    const auto row = std::find(rows.begin(), rows.end(), name);
    return row == rows.end() ? 0.0 : squares[row - rows.begin()];
  };
  const std::string what = torque
                               ? "a " + best.name
                               : fmt::format("{} at arc length {:.3g} m",
                                             direction_of(of("side"), of("down")), best.arc_length);
  missing.words.push_back(fmt::format(
      "{}, strongest at {:.3g} s of {}: {}{}", what, where->time[static_cast<std::size_t>(at.time)],
      where->experiment, torque ? "" : rows[static_cast<std::size_t>(at.row)] + " ",
      sized(where->size(at.row, at.time), where->deviation(at.row, at.time),
            torque ? "N m" : "N")));
  missing.words.push_back(
      "a force there alone explains the recordings as well as forces everywhere do");
}

void describe_everywhere(MissingForce& missing) {
  const MissingForce::History* where = &missing.everywhere.front();
  Strongest at;
  double most = -1, side = 0, down = 0;
  for (const MissingForce::History& history : missing.everywhere) {
    side += history.side.squaredNorm();
    down += history.down.squaredNorm();
    const Strongest here = strongest_of(history.side, history.down);
    const double size =
        std::hypot(history.side(here.row, here.time), history.down(here.row, here.time));
    if (size > most) most = size, where = &history, at = here;
  }
  const bool mostly_down = down > side;
  const MatrixXd& value = mostly_down ? where->down : where->side;
  const MatrixXd& deviation = mostly_down ? where->down_deviation : where->side_deviation;
  missing.words.push_back(
      fmt::format("{} along the cable, strongest at arc length {:.3g} m, {:.3g} s of {}: {} {}",
                  direction_of(side, down), missing.arc_length[static_cast<std::size_t>(at.row)],
                  where->time[static_cast<std::size_t>(at.time)], where->experiment,
                  mostly_down ? "down" : "side",
                  sized(value(at.row, at.time), deviation(at.row, at.time), "N/m")));
  missing.words.push_back(fmt::format(
      "a force at one place alone explains less: the best one is {}", missing.best->name));
}

}  // namespace

void describe(MissingForce& missing) {
  if (!missing.found && missing.sensor) {
    missing.words.push_back(fmt::format(
        "no force on the chain: an error of the camera explains the recordings as well: {} "
        "(log evidence {:.4g}, of forces {:.4g})",
        missing.sensor->name, missing.sensor->log_evidence,
        std::max(missing.log_evidence, missing.best->log_evidence)));
    return;
  }
  if (!missing.found) {
    missing.words.push_back(
        fmt::format("no force on the chain: one would explain {:.1f} % of the squared residuals "
                    "(log evidence {:.3g})",
                    100 * missing.share, missing.log_evidence));
    return;
  }
  if (missing.one_place)
    describe_place(missing);
  else
    describe_everywhere(missing);
  std::string others;
  for (const auto* tried : {&missing.places, &missing.joints})
    for (const MissingForce::Place& place : *tried)
      if (place.log_evidence > missing.best->log_evidence - kForceThresholds.told_apart &&
          place.name != missing.best->name)
        others += (others.empty() ? "" : ", ") + place.name;
  if (!others.empty()) missing.words.push_back("these data do not tell it from: " + others);
  const auto resolved = std::count_if(missing.patterns.begin(), missing.patterns.end(),
                                      [](const auto& p) { return p.resolved > kResolved; });
  missing.words.push_back(fmt::format(
      "forces explain {:.0f} % of the squared residuals (log evidence {:.4g}); the data resolve {} "
      "of {} patterns",
      100 * missing.share, missing.log_evidence, resolved, missing.patterns.size()));
  if (missing.law && (missing.one_place || missing.law->found))
    missing.words.insert(missing.words.end(), missing.law->words.begin(), missing.law->words.end());
}

}  // namespace catena
