// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/result_writer.hpp"

#include <algorithm>
#include <cmath>

#include "common/sha256.hpp"
#include "common/whole_file.hpp"
#include "description/description.hpp"
#include "description/formula.hpp"
#include "identify/cases/case_words.hpp"
#include "identify/fit/estimated_noise.hpp"
#include "identify/models/model_provider.hpp"
#include "identify/results/energy_remark.hpp"
#include "identify/results/fit_remarks.hpp"
#include "identify/results/result_file.hpp"
#include "identify/uncertainty/profile.hpp"

namespace catena {
namespace {

template <class Range>
results::Row row_of(const Range& values) {
  return results::Row(values.begin(), values.end());
}

results::Rows rows_of(const Eigen::MatrixXd& matrix) {
  results::Rows rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) rows.push_back(row_of(matrix.row(i)));
  return rows;
}

/// Everything about the case and its model.
results::Result result_for(const Problem& problem, const char* command) {
  const Case& the_case = problem.the_case();
  results::Result result;
  result.command = command;
  result.title = the_case.title;
  result.status = "success";
  result.versions = {{"catena", CATENA_VERSION}};
  result.the_case = case_entry(the_case);
  results::ModelEntry& model = result.model.emplace();
  model.id = problem.model().table().id;
  model.links = problem.model().links();
  model.description_hash = problem.model().table().description_hash;
  model.load_mass = the_case.cable.load_mass;
  try {
    model.derived =
        results::read_derived(derived_equations(the_case.description, problem.model().links()));
  } catch (const std::exception& error) {  // no reason to lose what was computed
    model.not_derived = error.what();
  }
  if (!the_case.description.empty()) {
    model.description = read_whole_file(the_case.description);
    for (const Effect& effect : read_description(the_case.description).effects)
      model.effects.push_back({effect.id, effect.title, "", formula_entries(effect)});
  }
  return result;
}

void put_motion(results::Experiment& experiment, const Problem& problem, const Motion& motion) {
  const Simulation& simulation = motion.simulation;
  const Trajectory& path = simulation.trajectory;
  const Eigen::Index links = problem.model().links();
  experiment.trajectory = {path.time, rows_of(motion.side), rows_of(motion.down),
                           rows_of(path.q.topRows(links))};
  if (problem.model().in_space()) {  // q is directions
    const Eigen::MatrixXd down = path.q.middleRows(links, links);
    experiment.trajectory.angle =
        rows_of(down.cwiseMin(1.0).cwiseMax(-1.0).array().acos().matrix());
    experiment.trajectory.across = rows_of(motion.across);
  }
  if (motion.forces.tension.size())
    experiment.forces = {rows_of(motion.forces.tension), rows_of(motion.forces.moment)};
  if (path.energy.size()) {
    static const char* const kKinds[] = {"stored", "dissipated", "supplied"};
    results::Energy& energy = experiment.energy.emplace();
    energy.time = path.time;
    energy.imbalance = simulation.energy_imbalance;
    if (std::string words = energy_remark(simulation); !words.empty())
      experiment.warnings.push_back(std::move(words));
    for (int i = 0; i < problem.model().energies(); ++i) {
      const auto& item = problem.model().table().energy_item[i];
      energy.items.push_back({item.name, kKinds[item.kind], row_of(path.energy.row(i))});
    }
  }
  const Statistics& statistics = simulation.statistics;
  experiment.statistics = {{"steps", statistics.steps},
                           {"residual_evaluations", statistics.residual_evaluations},
                           {"jacobian_evaluations", statistics.jacobian_evaluations},
                           {"newton_iterations", statistics.newton_iterations},
                           {"error_test_failures", statistics.error_test_failures},
                           {"newton_failures", statistics.newton_failures}};
}

/// Values of a recording's channels: rows for each component, one per point.
void put_values(results::Channels& channels, const Recording& recording,
                const Eigen::MatrixXd& values) {
  results::Rows* const rows[] = {&channels.side, &channels.down, &channels.angle, &channels.across};
  for (std::size_t c = 0; c < recording.channels.size(); ++c)
    rows[static_cast<int>(recording.channels[c].component)]->push_back(
        row_of(values.row(static_cast<Eigen::Index>(c))));
}

double arc_of(const Problem& problem, const PointSpec& point) {
  if (!std::isnan(point.arc_length)) return point.arc_length;
  const Model& model = problem.model();
  const Eigen::VectorXd lengths = problem.model_parameters(problem.start(), -1)
                                      .segment(model.parameter_index("length_1"), model.links());
  return point.joint ? lengths.head(point.joint).sum() : lengths.sum();
}

results::Measured measured_of(const Problem& problem, const Recording& recording,
                              const Eigen::MatrixXd& predicted) {
  const bool angles = recording.channels.front().component == Component::kAngle;
  results::Measured measured;
  const bool pictures = !recording.points.front().camera.empty();
  measured.kind = angles ? "angles" : pictures ? "pictures" : "markers";
  measured.values.time = recording.time;
  for (const PointSpec& point : recording.points)
    measured.points.push_back(
        {point.name, angles ? results::kAbsent : arc_of(problem, point), angles ? point.link : 0});
  put_values(measured.values, recording, recording.measured);
  put_values(measured.predicted, recording, predicted);
  return measured;
}

results::Gap gap_of(const std::vector<Gap>& gaps, int experiment, const char* unit) {
  results::Gap found;
  found.unit = unit;
  for (const Gap& gap : gaps)
    if (gap.experiment == experiment)
      (gap.part == Part::kFit ? found.fit : found.validate) = gap.rms;
  return found;
}

std::vector<results::Experiment> experiments_of(const Problem& problem, const Eigen::VectorXd& x,
                                                const Evaluation* before, const Evaluation& after,
                                                const std::vector<Motion>& motions) {
  const std::vector<Gap> gaps = gaps_of(problem, after);
  const std::vector<Gap> gaps_before = before ? gaps_of(problem, *before) : std::vector<Gap>{};
  std::vector<results::Experiment> all;
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const Experiment& experiment = problem.experiments()[e];
    const Recording& recording = experiment.recording;
    const auto index = static_cast<int>(e);
    const char* unit = experiment.spec.kind == DataKind::kAngles ? "rad" : "m";
    results::Experiment& entry = all.emplace_back();
    entry.name = experiment.spec.name;
    entry.use = experiment.fitted() ? "fit" : "validate";
    const auto fitted = static_cast<std::size_t>(recording.fit_frames);
    if (fitted > 0 && fitted < recording.time.size()) entry.fit_until = recording.time[fitted - 1];
    if (std::isfinite(experiment.spec.sealed_from)) entry.sealed_from = experiment.spec.sealed_from;
    entry.warnings = recording.warnings;
    put_motion(entry, problem, motions[e]);
    if (problem.model().table().observes) {
      const SeenChain seen = seen_chain(problem, x, index);
      entry.seen = {seen.time, rows_of(seen.side), rows_of(seen.down), {}, rows_of(seen.across)};
    }
    entry.measured = measured_of(problem, recording, after.predictions[e].simulated);
    entry.gap = gap_of(gaps, index, unit);
    if (before) entry.gap_before = gap_of(gaps_before, index, unit);
  }
  return all;
}

/// The chosen measure of the fitted part, and the mean absolute difference of every channel.
results::Measure measure_of(const Problem& problem, const Evaluation& evaluation) {
  results::Measure result;
  const Residuals residuals = residuals_of(problem, evaluation, Part::kFit);
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const Recording& recording = problem.experiments()[e].recording;
    std::vector<double> sum(recording.channels.size(), 0), count(recording.channels.size(), 0);
    for (std::size_t i = 0; i < residuals.index.size(); ++i) {
      if (residuals.index[i].experiment != static_cast<int>(e)) continue;
      const auto c = static_cast<std::size_t>(residuals.index[i].channel);
      sum[c] += std::abs(residuals.value[static_cast<Eigen::Index>(i)]);
      ++count[c];
    }
    const std::string of =
        problem.experiments().size() > 1 ? problem.experiments()[e].spec.name + ": " : "";
    for (std::size_t c = 0; c < sum.size(); ++c)
      if (count[c] > 0)
        result.parts.push_back({of + recording.channels[c].name, sum[c] / count[c]});
  }
  result.name = kMeasureWords[static_cast<std::size_t>(problem.the_case().error.measure)];
  result.unit = error_unit(problem);
  result.value = error_of(problem, evaluation, Part::kFit);
  if (residuals_of(problem, evaluation, Part::kValidation).value.size())
    result.validation = error_of(problem, evaluation, Part::kValidation);
  return result;
}

std::vector<results::Parameter> parameters_of(const Problem& problem, const Eigen::VectorXd& x) {
  static const char* const kGroups[] = {"physics", "initial", "sensor"};
  const Case& the_case = problem.the_case();
  std::vector<results::Parameter> all;
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    const Unknown& unknown = problem.unknowns()[j];
    results::Parameter& entry = all.emplace_back();
    entry.name = unknown.name;
    entry.sets = unknown.parameter >= 0
                     ? the_case.parameters[static_cast<std::size_t>(unknown.parameter)].sets
                     : "initial";
    entry.unit = unknown.unit;
    entry.free = true;
    entry.group = kGroups[static_cast<int>(unknown.group)];
    entry.scale = kScaleWords[static_cast<std::size_t>(unknown.scale)];
    entry.value = x[static_cast<Eigen::Index>(j)];
    entry.start = unknown.start;
    entry.lower = unknown.lower;
    entry.upper = unknown.upper;
  }
  for (const ParameterSpec& parameter : the_case.parameters) {
    if (parameter.free) continue;
    results::Parameter& entry = all.emplace_back();
    entry.name = parameter.name;
    entry.sets = parameter.sets;
    entry.unit = parameter.unit;
    entry.value = parameter.value;
    entry.verdict = "fixed";
  }
  return all;
}

void put_uncertainty(results::Result& result, const Problem& problem, const Identification& found) {
  const Uncertainty& uncertainty = *found.uncertainty;
  for (std::size_t j = 0; j < uncertainty.estimates.size(); ++j) {
    const Estimate& estimate = uncertainty.estimates[j];
    results::Parameter& entry = result.parameters[j];
    entry.standard_error = estimate.standard_error;
    entry.interval = {estimate.lower, estimate.upper};
    entry.verdict = name_of(estimate.verdict);
  }
  if (found.bootstrap.rows() > 0)
    for (Eigen::Index j = 0; j < found.bootstrap.cols(); ++j) {
      Eigen::VectorXd column = found.bootstrap.col(j);
      std::sort(column.begin(), column.end());
      const auto at = [&](double share) {
        return column[static_cast<Eigen::Index>(share * static_cast<double>(column.size() - 1) +
                                                0.5)];
      };
      result.parameters[static_cast<std::size_t>(j)].bootstrap_interval = {at(0.025), at(0.975)};
    }
  result.correlation = rows_of(uncertainty.correlation);
  results::ResidualNoise& noise = result.residuals.emplace();
  noise.deviation = uncertainty.noise;
  noise.autocorrelation = uncertainty.autocorrelation;
  noise.autocorrelated = uncertainty.autocorrelated;
  noise.words = noise_in_words(problem);
  noise.singular_values = row_of(uncertainty.singular_values);
  const Residuals residuals = residuals_of(problem, found.after, Part::kFit);
  for (const ChannelNoise& channel : channels_of(problem, residuals)) {
    const Estimate estimate = noise_estimate(channel, uncertainty);
    noise.channels.push_back(
        {channel.name, channel.deviation, results::Interval{estimate.lower, estimate.upper}});
  }
  for (const WeakDirection& weak : uncertainty.weak)
    noise.weak_directions.push_back({weak.deviation, weak.text});
  for (const Profile& profile : found.profiles)
    result.profiles.push_back({problem.unknowns()[static_cast<std::size_t>(profile.unknown)].name,
                               row_of(profile.value), row_of(profile.cost), profile.threshold,
                               name_of(profile.verdict)});
}

results::Start start_of(const FitResult& start) {
  return {start.error,
          name_of(start.status),
          start.history.empty() ? results::Row() : row_of(start.history.front().x),
          start.start_error,
          start.evaluations,
          row_of(start.x)};
}

results::Optimiser optimiser_of(const Problem& problem, const FitResult& fit) {
  const OptimiserSpec& spec = problem.the_case().optimiser;
  results::Optimiser result;
  result.method = kMethodWords[static_cast<std::size_t>(spec.method)];
  result.strategy = strategy_of(problem);
  result.status = name_of(fit.status);
  result.message = fit.message;
  result.evaluations = fit.evaluations;
  result.simulations_worth = fit.work;
  result.failures = fit.failures;
  for (const Failure& failure : fit.failed)
    result.failed.push_back({row_of(failure.x), failure.message});
  result.seed = spec.seed;
  result.start_error = fit.start_error;
  result.error = fit.error;
  result.error_noise = fit.error_noise;
  result.history.parameters.resize(problem.unknowns().size());
  for (std::size_t k = 0; k < fit.history.size(); ++k) {
    result.history.step.push_back(static_cast<double>(k + 1));
    result.history.error.push_back(fit.history[k].error);
    for (std::size_t j = 0; j < result.history.parameters.size(); ++j)
      result.history.parameters[j].push_back(fit.history[k].x[static_cast<Eigen::Index>(j)]);
  }
  return result;
}

}  // namespace

results::CaseEntry case_entry(const Case& the_case) {
  return {the_case.file.filename().string(), the_case.text, sha256_hex(the_case.text)};
}

std::vector<results::Formula> formula_entries(const Effect& effect) {
  std::vector<results::Formula> entries;
  for (const Formula& formula : formulas(effect))
    entries.push_back({formula.what, formula.latex, formula.mathml});
  return entries;
}

std::string simulation_result_text(const Problem& problem, const Motion& motion) {
  results::Result result = result_for(problem, "simulate");
  results::Experiment& experiment = result.experiments.emplace_back();
  experiment.name = "simulation";
  put_motion(experiment, problem, motion);
  result.parameters = parameters_of(problem, problem.start());
  return results::text_of(result);
}

std::string comparison_result_text(const Problem& problem, const Eigen::VectorXd& x,
                                   const Evaluation& evaluation,
                                   const std::vector<Motion>& motions) {
  results::Result result = result_for(problem, "simulate");
  result.experiments = experiments_of(problem, x, nullptr, evaluation, motions);
  result.measure = measure_of(problem, evaluation);
  result.parameters = parameters_of(problem, x);
  return results::text_of(result);
}

std::string links_study_result_text(const Case& the_case, const std::vector<LinksResult>& studied) {
  results::Result result;
  result.command = "identify";
  result.title = the_case.title;
  for (const LinksResult& one : studied) {
    results::Numbers parameters;
    for (std::size_t j = 0; j < one.names.size(); ++j)
      parameters.emplace_back(one.names[j], one.fit.x[static_cast<Eigen::Index>(j)]);
    result.links_study.push_back({one.links, name_of(one.fit.status), one.fit.error,
                                  one.validation_error, one.fit.evaluations, parameters});
  }
  return results::text_of(result);
}

std::string identification_result_text(const Problem& problem, const Identification& found) {
  results::Result result = result_for(problem, "identify");
  if (found.fit.status != FitStatus::kConverged) result.status = name_of(found.fit.status);
  result.message = found.fit.message;
  result.experiments =
      experiments_of(problem, found.fit.x, &found.before, found.after, found.motions);
  for (const FitRemark& remark : remarks_on_fit(problem, found.after))
    result.experiments[remark.experiment].warnings.push_back(remark.words);
  result.measure = measure_of(problem, found.after);
  result.parameters = parameters_of(problem, found.fit.x);
  result.optimiser = optimiser_of(problem, found.fit);
  if (found.starts.size() > 1)
    for (const FitResult& start : found.starts) result.starts.push_back(start_of(start));
  if (found.uncertainty) put_uncertainty(result, problem, found);
  return results::text_of(result);
}

}  // namespace catena
