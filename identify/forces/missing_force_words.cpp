// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/missing_force_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/normal_quantile.hpp"
#include "identify/forces/force_pattern.hpp"
#include "identify/noise/cosine_spectrum.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Share of the prior variance that data must take away from a pattern that they resolve.
constexpr double kResolved = 0.5;

/// Where densities together are strongest: row and time.
struct Strongest {
  Index row = 0, time = 0;
  double size = -1;
};
Strongest strongest_of(const std::vector<MissingForce::OverTime>& densities) {
  Eigen::ArrayXXd squares = densities.front().value.array().square();
  for (std::size_t i = 1; i < densities.size(); ++i) squares += densities[i].value.array().square();
  Strongest at;
  at.size = std::sqrt(squares.maxCoeff(&at.row, &at.time));
  return at;
}

std::string sized(double value, double deviation, const std::string& unit) {
  return fmt::format("{:.3g} {} ({:.3g} to {:.3g})", value, unit,
                     value - kNormalQuantile95 * deviation, value + kNormalQuantile95 * deviation);
}

/// "a side force" and the like, by what most of the mean square is. `squares`: to each direction.
std::string direction_of(const VectorXd& squares) {
  constexpr double kMost = 0.8;
  constexpr const char* kWords[] = {"a side force", "a force up or down", "a force across"};
  for (Index i = 0; i < squares.size(); ++i)
    if (squares[i] > kMost * squares.sum()) return kWords[i];
  return "a force";
}

void describe_place(MissingForce& missing) {
  const MissingForce::Place& best = *missing.best;
  const MissingForce::History* where = &missing.at_best.front();
  Strongest at;
  const std::vector<std::string>& rows = where->rows;
  VectorXd squares = VectorXd::Zero(static_cast<Index>(rows.size()));
  for (const MissingForce::History& history : missing.at_best) {
    squares += history.size.rowwise().squaredNorm();
    Strongest here;
    here.size = history.size.colwise().norm().maxCoeff(&here.time);
    if (here.size > at.size) where = &history, at = here;
  }
  const bool torque = best.joint >= 0;
  squares.maxCoeff(&at.row);
  VectorXd to_directions = VectorXd::Zero(3);
  for (const ForceDirection direction : force_directions(true)) {
    const auto row = std::find(rows.begin(), rows.end(), word_of(direction));
    if (row != rows.end())
      to_directions[static_cast<Index>(direction)] = squares[row - rows.begin()];
  }
  const std::string what = torque ? "a " + best.name
                                  : fmt::format("{} at arc length {:.3g} m",
                                                direction_of(to_directions), best.arc_length);
  missing.words.push_back(
      fmt::format("{}, strongest at {:.3g} s of {}: {}{}", what,
                  where->time[static_cast<std::size_t>(at.time)], where->experiment,
                  rows[static_cast<std::size_t>(at.row)] == "moment"
                      ? ""
                      : rows[static_cast<std::size_t>(at.row)] + " ",
                  sized(where->size(at.row, at.time), where->deviation(at.row, at.time),
                        torque ? "N m" : "N")));
  missing.words.push_back(
      "a force there alone explains the recordings as well as forces everywhere do");
}

void describe_everywhere(MissingForce& missing) {
  const MissingForce::History* where = &missing.everywhere.front();
  Strongest at;
  VectorXd squares = VectorXd::Zero(static_cast<Index>(where->densities.size()));
  for (const MissingForce::History& history : missing.everywhere) {
    for (Index i = 0; i < squares.size(); ++i)
      squares[i] += history.densities[static_cast<std::size_t>(i)].value.squaredNorm();
    const Strongest here = strongest_of(history.densities);
    if (here.size > at.size) where = &history, at = here;
  }
  Index mostly = 0;
  squares.maxCoeff(&mostly);
  const MissingForce::OverTime& strongest = where->densities[static_cast<std::size_t>(mostly)];
  missing.words.push_back(fmt::format(
      "{} along the cable, strongest at arc length {:.3g} m, {:.3g} s of {}: {} {}",
      direction_of(squares), missing.arc_length[static_cast<std::size_t>(at.row)],
      where->time[static_cast<std::size_t>(at.time)], where->experiment,
      word_of(static_cast<ForceDirection>(mostly)),
      sized(strongest.value(at.row, at.time), strongest.deviation(at.row, at.time), "N/m")));
  missing.words.push_back(fmt::format(
      "a force at one place alone explains less: the best one is {}", missing.best->name));
}

/// "side force = -linear x (side position - rest), linear = 0.3 (0.296 to 0.304) N/m, ...": with
/// intervals of 95 %, where the data determine them.
std::string with_constants(const CandidateLaw::Formula& formula) {
  std::string words = formula.text;
  for (const CandidateLaw::Constant& constant : formula.constants) {
    const double half = kNormalQuantile95 * constant.deviation;
    const std::string interval =
        std::isfinite(half)
            ? fmt::format("{:.3g} to {:.3g}", constant.value - half, constant.value + half)
            : "not determined";
    words += fmt::format(", {} = {:.3g} ({}) {}", constant.name, constant.value, interval,
                         constant.unit);
  }
  return words;
}

std::string chance_words(double value) {
  return value <= 1 / (1.0 + kRandomSeries) ? fmt::format("chance below {:.2g}", value)
                                            : fmt::format("chance {:.2g}", value);
}

void describe_law(ForceLaw& law) {
  const std::string tested = fmt::format(
      "chosen of {} in {}, it explains {:.0f} % of what a force can explain in the second ({})",
      law.candidates, law.chosen_in(), 100 * law.share_confirmed(), chance_words(law.chance));
  if (law.found) {
    law.words.push_back("its law: " + with_constants(law.formula) + site_in_words(law.site));
    law.words.push_back(tested);
    if (law.formula.curve)
      law.words.emplace_back("no formula fits: it is a curve of straight pieces between knots");
    for (const ForceLaw& rival : law.rivals)
      law.words.push_back("these data do not tell it from: " + with_constants(rival.formula) +
                          site_in_words(rival.site));
  } else if (law.force.empty()) {
    law.words.push_back("a force in time, no law: none of the candidates explains it");
  } else {
    law.words.push_back(fmt::format("a force in time, no law; the best is {} against {}{}: {}",
                                    law.force, law.variable, site_in_words(law.site), tested));
  }
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
  if (!missing.law) {
    missing.words.emplace_back(
        "its law is not known: the motion cannot be followed in shorter steps");
    return;
  }
  describe_law(*missing.law);
  missing.words.insert(missing.words.end(), missing.law->words.begin(), missing.law->words.end());
}

}  // namespace catena
