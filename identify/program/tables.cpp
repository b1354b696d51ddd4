// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identify/error.hpp"

namespace catena {
namespace {

struct Worst {
  std::size_t width = 0;
  void see(const std::string& text) { width = std::max(width, text.size()); }
};

const Gap* find(const std::vector<Gap>& gaps, const Gap& like) {
  for (const Gap& gap : gaps)
    if (gap.experiment == like.experiment && gap.part == like.part) return &gap;
  return nullptr;
}

}  // namespace

namespace {

/// One line for the fit and one for the validation, over all experiments (of one kind).
std::string gap_summary(const Problem& problem, const Evaluation* before, const Evaluation& after) {
  std::string out;
  for (const Part part : {Part::kFit, Part::kValidation}) {
    const auto rms = [&](const Evaluation& evaluation) {
      const Residuals residuals = residuals_of(problem, evaluation, part);
      return 1e3 * residuals.value.norm() / std::sqrt(static_cast<double>(residuals.value.size()));
    };
    const auto count = residuals_of(problem, after, part).value.size();
    if (count == 0) continue;
    const char* unit =
        problem.experiments().front().spec.kind == DataKind::kAngles ? "mrad" : "mm";
    out += fmt::format("{:<8}  {:>8} values  RMS", part == Part::kFit ? "fit" : "validate", count);
    if (before) out += fmt::format("  {:.4g} {} before", rms(*before), unit);
    out += fmt::format("  {:.4g} {}{}\n", rms(after), unit, before ? " after" : "");
  }
  return fmt::format("{} experiments\n", problem.experiments().size()) + out;
}

}  // namespace

std::string simulation_table(const Motion& motion) {
  const Simulation& simulation = motion.simulation;
  const Eigen::Index load = motion.side.rows() - 1, last = motion.side.cols() - 1;
  return fmt::format(
      "simulated {:.6g} s in {} steps\n"
      "load at the end: side {:.4f} m, down {:.4f} m\n"
      "energy balance kept within {:.2g} J\n",
      simulation.trajectory.time.back() - simulation.trajectory.time.front(),
      simulation.statistics.steps, motion.side(load, last), motion.down(load, last),
      simulation.energy_imbalance);
}

std::string gap_table(const Problem& problem, const Evaluation* before, const Evaluation& after) {
  constexpr std::size_t kMostRows = 8;
  if (problem.experiments().size() > kMostRows) return gap_summary(problem, before, after);
  const std::vector<Gap> gaps = gaps_of(problem, after);
  const std::vector<Gap> earlier = before ? gaps_of(problem, *before) : std::vector<Gap>{};
  Worst name;
  name.see("experiment");
  for (const Experiment& experiment : problem.experiments()) name.see(experiment.spec.name);
  std::string out = fmt::format("{:<{}}  {:<8}  {:>8}", "experiment", name.width, "part", "values");
  if (before) out += fmt::format("  {:>12}", "RMS before");
  out += fmt::format("  {:>12}  {:>12}  {:>12}\n", before ? "RMS after" : "RMS", "mean dist.",
                     "largest");
  for (const Gap& gap : gaps) {
    const Experiment& experiment = problem.experiments()[static_cast<std::size_t>(gap.experiment)];
    const bool angles = experiment.spec.kind == DataKind::kAngles;
    const auto cell = [&](double value) {
      return fmt::format("  {:>12}", fmt::format("{:.4g} {}", 1e3 * value, angles ? "mrad" : "mm"));
    };
    out += fmt::format("{:<{}}  {:<8}  {:>8}", experiment.spec.name, name.width,
                       gap.part == Part::kFit ? "fit" : "validate", gap.count);
    if (before) {
      const Gap* earlier_gap = find(earlier, gap);
      out += earlier_gap ? cell(earlier_gap->rms) : fmt::format("  {:>12}", "failed");
    }
    out += cell(gap.rms) + cell(gap.mean_distance) + cell(gap.largest) + "\n";
  }
  return out;
}

std::string measured_error(const Problem& problem, double error) {
  bool noise = false, angles = false;
  for (const Experiment& experiment : problem.experiments()) {
    noise |= !std::isnan(experiment.spec.noise);
    angles |= experiment.spec.kind == DataKind::kAngles;
  }
  if (noise && problem.study().error.measure == Measure::kLeastSquares)
    return fmt::format("{:.4g} times the noise", error);
  return fmt::format("{:.4g} {}", 1e3 * error, angles ? "mrad" : "mm");
}

std::string parameter_table(const Problem& problem, const FitResult& fit) {
  Worst name;
  name.see("parameter");
  for (const Unknown& unknown : problem.unknowns()) name.see(unknown.name);
  std::string out = fmt::format("{:<{}}  {:>13}  {:>13}  unit\n", "parameter", name.width, "start",
                                "identified");
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    const Unknown& unknown = problem.unknowns()[j];
    if (unknown.group == Unknown::Group::kInitial) continue;
    const double value = fit.x[static_cast<Eigen::Index>(j)];
    const bool at_bound = value <= unknown.lower || value >= unknown.upper;
    out += fmt::format("{:<{}}  {:>13.6g}  {:>13.6g}  {}{}\n", unknown.name, name.width,
                       unknown.start, value, unknown.unit, at_bound ? "  (at its bound)" : "");
  }
  return out;
}

}  // namespace catena
