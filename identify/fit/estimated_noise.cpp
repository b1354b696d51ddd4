// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/estimated_noise.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "common/input_error.hpp"
#include "identify/fit/error.hpp"
#include "identify/noise/estimate_noise.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::vector<NoiseModel> estimated_noise(const Problem& problem,
                                        const std::vector<MatrixXd>& predicted) {
  const std::vector<Experiment>& experiments = problem.experiments();
  std::map<int, std::vector<std::size_t>> windows;  // of each recording
  for (std::size_t e = 0; e < experiments.size(); ++e)
    if (predicted[e].size() > 0) windows[experiments[e].source].push_back(e);
  std::vector<NoiseModel> noise(experiments.size());
  for (const auto& [source, members] : windows) {
    std::vector<NoiseWindow> parts;
    for (const std::size_t e : members) {
      const Recording& recording = experiments[e].recording;
      NoiseWindow& window = parts.emplace_back();
      const Index frames = predicted[e].cols();
      window.residual = predicted[e] - recording.measured.leftCols(frames);
      window.predicted = predicted[e];
      window.time.assign(recording.time.begin(), recording.time.begin() + frames);
      window.fitted = experiments[e].fitted() ? recording.fit_frames : 0;
      // A window that is held out whole tells the noise, too: its start is fitted.
      window.shows_noise = window.fitted > 0 ? window.fitted : window.residual.cols();
    }
    const Experiment& experiment = experiments[members.front()];
    // Of several cameras only the first one may shake.
    const std::vector<PointSpec>& points = experiment.recording.points;
    std::vector<int> direction;
    for (const Channel& channel : experiment.recording.channels) {
      const bool first =
          points[static_cast<std::size_t>(channel.point)].camera == points.front().camera;
      direction.push_back(!first                                  ? -1
                          : channel.component == Component::kSide ? 0
                          : channel.component == Component::kDown ? 1
                                                                  : -1);
    }
    std::vector<NoiseModel> found = estimate_noise(parts, direction, experiment.spec.noise);
    for (std::size_t w = 0; w < members.size(); ++w) noise[members[w]] = std::move(found[w]);
  }
  return noise;
}

std::vector<std::string> noise_in_words(const Problem& problem,
                                        const std::vector<NoiseModel>& noise) {
  std::vector<std::string> words;
  std::set<int> told;
  for (std::size_t e = 0; e < noise.size(); ++e) {
    const int source = problem.experiments()[e].source;
    if (!problem.experiments()[e].fitted() || !told.insert(source).second) continue;
    const std::string& name = problem.the_case().experiments[static_cast<std::size_t>(source)].name;
    for (const std::string& each : noise[e].words())
      words.push_back(fmt::format("{}: {}", name, each));
  }
  return words;
}

std::vector<std::string> noise_in_words(const Problem& problem) {
  std::vector<NoiseModel> noise;
  for (const Experiment& experiment : problem.experiments()) {
    if (!experiment.noise) return {};
    noise.push_back(*experiment.noise);
  }
  return noise_in_words(problem, noise);
}

Problem with_noise(const Problem& problem, const std::vector<NoiseModel>& noise) {
  std::vector<Experiment> experiments = problem.experiments();
  for (std::size_t e = 0; e < noise.size(); ++e)
    if (noise[e].level > 0) experiments[e].noise = std::make_shared<const NoiseModel>(noise[e]);
  return Problem(problem.the_case(), problem.model(), std::move(experiments));
}

Problem with_noise_seen_at(const Problem& problem, const VectorXd& x) {
  const Evaluation evaluation = evaluate(problem, x, false, false);
  if (!evaluation.ok) throw std::runtime_error(evaluation.message);
  std::vector<MatrixXd> predicted;
  for (const Prediction& prediction : evaluation.predictions)
    predicted.push_back(prediction.simulated);
  std::vector<NoiseModel> noise = estimated_noise(problem, predicted);
  std::map<int, double> level;  // of the fitted part of each recording
  for (std::size_t e = 0; e < noise.size(); ++e) {
    const Experiment& experiment = problem.experiments()[e];
    if (!experiment.fitted()) continue;
    if (!(noise[e].level > 0))
      throw InputError(fmt::format(
          "{}: {} fitted frames show no noise to estimate; give `noise`, without noise = "
          "\"estimated\" in [error]",
          experiment.spec.where, experiment.recording.fit_frames));
    level[experiment.source] = noise[e].level;
  }
  for (std::size_t e = 0; e < noise.size(); ++e)  // what only validates is counted in its level
    if (const Experiment& experiment = problem.experiments()[e]; !experiment.fitted()) {
      const auto known = level.find(experiment.source);
      noise[e].level = known == level.end() ? level.begin()->second : known->second;
    }
  return with_noise(problem, noise);
}

std::shared_ptr<const Problem> before_noise_is_known(std::shared_ptr<const Problem> problem) {
  if (!problem->the_case().error.noise_estimated) return problem;
  Case the_case = problem->the_case();
  the_case.error.loss = Loss::kNone;
  for (ParameterSpec& parameter : the_case.parameters) parameter.standard_deviation = kNotGiven;
  return std::make_shared<const Problem>(std::move(the_case), problem->model(),
                                         problem->experiments());
}

WeighedFit fit_with_noise(std::shared_ptr<const Problem> problem, FitResult first,
                          const FitOptions& options, const LeastSquares& least_squares) {
  if (!problem->the_case().error.noise_estimated || first.x.size() == 0 ||
      first.status == FitStatus::kFailed)
    return {std::move(problem), std::move(first)};
  const auto weighed = std::make_shared<const Problem>(with_noise_seen_at(*problem, first.x));
  Case the_case = problem->the_case();
  the_case.optimiser.growing_windows.clear();  // the first fit found the way
  FitOptions from_first = options;
  from_first.start = first.x;
  from_first.recall = nullptr;
  from_first.record = nullptr;
  FitResult second = fit(Problem(std::move(the_case), problem->model(), weighed->experiments()),
                         from_first, least_squares);
  if (second.status == FitStatus::kFailed) return {weighed, std::move(second)};
  add_effort(second, first);
  const VectorXd start = options.start.size() ? options.start : problem->start();
  second.start_error = error_of(*weighed, evaluate(*weighed, start, false, false), Part::kFit);
  second.noise_seen_at = std::move(first.x);
  return {weighed, std::move(second)};
}

}  // namespace catena
