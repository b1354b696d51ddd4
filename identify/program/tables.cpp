// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "identify/fit/error.hpp"
#include "identify/uncertainty/profile.hpp"

namespace catena {
namespace {

struct ColumnWidth {
  std::size_t width = 0;
  void see(const std::string& text) { width = std::max(width, text.size()); }
};

const Gap* find(const std::vector<Gap>& gaps, const Gap& like) {
  for (const Gap& gap : gaps)
    if (gap.experiment == like.experiment && gap.part == like.part) return &gap;
  return nullptr;
}

/// A line for the fit and one for the validation of all experiments with markers, and of all with angles.
std::string gap_summary(const Problem& problem, const std::vector<Gap>& before,
                        const std::vector<Gap>& after) {
  std::string out = fmt::format("{} experiments\n", problem.experiments().size());
  for (const bool angles : {false, true}) {
    for (const Part part : {Part::kFit, Part::kValidation}) {
      const auto total = [&](const std::vector<Gap>& gaps) {
        std::pair<Eigen::Index, double> found;  // residuals, RMS
        for (const Gap& gap : gaps) {
          const auto i = static_cast<std::size_t>(gap.experiment);
          if (gap.part != part ||
              (problem.experiments()[i].spec.kind == DataKind::kAngles) != angles)
            continue;
          found.first += gap.count;
          found.second += static_cast<double>(gap.count) * gap.rms * gap.rms;
        }
        found.second = std::sqrt(found.second / static_cast<double>(found.first));
        return found;
      };
      const auto [count, rms] = total(after);
      if (count == 0) continue;
      const char* unit = angles ? "mrad" : "mm";
      out +=
          fmt::format("{:<8}  {:>8} values  RMS", part == Part::kFit ? "fit" : "validate", count);
      if (!before.empty())
        out += fmt::format("  {:.4g} {} before", 1e3 * total(before).second, unit);
      out += fmt::format("  {:.4g} {}{}\n", 1e3 * rms, unit, before.empty() ? "" : " after");
    }
  }
  return out;
}

}  // namespace

std::string simulation_table(const Motion& motion) {
  const Simulation& simulation = motion.simulation;
  const Eigen::Index load = motion.side.rows() - 1, last = motion.side.cols() - 1;
  const std::string across =
      motion.across.size() ? fmt::format(", across {:.4f} m", motion.across(load, last)) : "";
  return fmt::format(
      "simulated {:.6g} s in {} steps\n"
      "load at the end: side {:.4f} m, down {:.4f} m{}\n"
      "energy balance kept within {:.2g} J\n",
      simulation.trajectory.time.back() - simulation.trajectory.time.front(),
      simulation.statistics.steps, motion.side(load, last), motion.down(load, last), across,
      simulation.energy_imbalance);
}

std::string gap_table(const Problem& problem, const Evaluation* before, const Evaluation& after) {
  constexpr std::size_t kMostRows = 8;
  const std::vector<Gap> gaps = gaps_of(problem, after);
  const std::vector<Gap> earlier = before ? gaps_of(problem, *before) : std::vector<Gap>{};
  if (problem.experiments().size() > kMostRows) return gap_summary(problem, earlier, gaps);
  ColumnWidth name;
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
  const std::string unit = error_unit(problem);
  if (unit == "1") return fmt::format("{:.4g} times the noise", error);
  return fmt::format("{:.4g} m{}", 1e3 * error, unit);
}

std::string parameter_table(const Problem& problem, const FitResult& fit,
                            const std::optional<Uncertainty>& uncertainty) {
  ColumnWidth name;
  name.see("parameter");
  for (const Unknown& unknown : problem.unknowns())
    if (unknown.group != Unknown::Group::kInitial) name.see(unknown.name);
  std::string out = fmt::format("{:<{}}  {:>12}  {:>12}  {:>25}  unit\n", "parameter", name.width,
                                "start", "identified", "95 % interval");
  std::string at_bound;
  std::size_t initial = 0;
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    const Unknown& unknown = problem.unknowns()[j];
    if (unknown.group == Unknown::Group::kInitial) {
      ++initial;
      continue;
    }
    std::string interval, remark;
    if (uncertainty) {
      if (uncertainty->estimates[j].verdict == Verdict::kAtBound)
        at_bound += (at_bound.empty() ? "" : ", ") + unknown.name;
      const Estimate& estimate = uncertainty->estimates[j];
      interval = fmt::format("{:.5g} .. {:.5g}", estimate.lower, estimate.upper);
      if (estimate.verdict != Verdict::kIdentifiable)
        remark = fmt::format("  ({})", name_of(estimate.verdict));
    }
    out += fmt::format("{:<{}}  {:>12.6g}  {:>12.6g}  {:>25}  {}{}\n", unknown.name, name.width,
                       unknown.start, fit.x[static_cast<Eigen::Index>(j)], interval, unknown.unit,
                       remark);
  }
  if (initial > 0) out += fmt::format("and {} numbers of the initial state\n", initial);
  if (!at_bound.empty())
    out += at_bound +
           " ended at a bound: the data want a value beyond it, or the model is wrong; the other "
           "intervals hold only with it there\n";
  return out;
}

std::string identifiability_table(const Problem& problem, const Uncertainty& uncertainty) {
  ColumnWidth name;
  name.see("parameter");
  for (const Unknown& unknown : problem.unknowns()) name.see(unknown.name);
  std::string out = fmt::format("{:<{}}  {:>12}  {:>14}  verdict\n", "parameter", name.width,
                                "value", "expected error");
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    const Unknown& unknown = problem.unknowns()[j];
    const Estimate& estimate = uncertainty.estimates[j];
    out += fmt::format("{:<{}}  {:>12.6g}  {:>14.4g}  {}\n", unknown.name, name.width,
                       unknown.start, estimate.standard_error, name_of(estimate.verdict));
  }
  for (std::size_t i = 0; i < uncertainty.weak.size(); ++i)
    out += fmt::format("not determined ({}): {}\n  {}\n",
                       std::isfinite(uncertainty.weak[i].deviation)
                           ? fmt::format("to {:.2g}", uncertainty.weak[i].deviation)
                           : "at all",
                       uncertainty.weak[i].text, uncertainty.suggestions[i]);
  if (uncertainty.weak.empty())
    out += "every unknown can be determined from this data, if the model is right\n";
  return out;
}

std::string profile_table(const Problem& problem, const std::vector<Profile>& profiles) {
  std::string out;
  for (const Profile& profile : profiles)
    out += fmt::format("profile of {}: {} from {:.6g} to {:.6g}\n",
                       problem.unknowns()[static_cast<std::size_t>(profile.unknown)].name,
                       name_of(profile.verdict), profile.value.front(), profile.value.back());
  return out;
}

std::string links_table(const std::vector<LinksResult>& results) {
  std::string out =
      fmt::format("{:>5}  {:>10}  {:>10}  {:>8}", "links", "error", "held out", "seconds");
  constexpr std::size_t kMostColumns = 6;
  const std::size_t columns = results.empty() ? 0 : std::min(kMostColumns, results[0].names.size());
  for (std::size_t j = 0; j < columns; ++j) out += fmt::format("  {:>14}", results[0].names[j]);
  out += "\n";
  for (const LinksResult& result : results) {
    out += fmt::format("{:>5}  {:>10.4g}  {:>10.4g}  {:>8.1f}", result.links, result.fit.error,
                       result.validation_error, result.fit.seconds);
    for (std::size_t j = 0; j < columns; ++j)
      out += fmt::format("  {:>14.6g}", result.fit.x[static_cast<Eigen::Index>(j)]);
    out += "\n";
  }
  return out;
}

std::string waterfall(const Problem& problem, const std::vector<FitResult>& starts) {
  std::vector<double> errors;
  for (const FitResult& start : starts) errors.push_back(start.error);
  std::sort(errors.begin(), errors.end());
  std::string out = fmt::format("{} starts, best first:", starts.size());
  constexpr std::size_t kShown = 10;  // the result file has them all
  for (std::size_t i = 0; i < std::min(errors.size(), kShown); ++i) {
    out += (i == 0 ? " " : ", ") + measured_error(problem, errors[i]);
  }
  return out + (errors.size() > kShown ? ", ...\n" : "\n");
}

}  // namespace catena
