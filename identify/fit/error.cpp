// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/error.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "common/special_values.hpp"
#include "identify/fit/loss.hpp"

namespace catena {
namespace {

using Eigen::Index;

bool in_part(const Experiment& experiment, Index frame, Part part) {
  const bool fit = experiment.spec.use == Use::kFit && frame < experiment.recording.fit_frames;
  return fit == (part == Part::kFit);
}

/// Calls visit(experiment, frame, channel, measured, simulated) for every point seen in the part.
template <class Visit>
void for_each_seen(const Problem& problem, const Evaluation& evaluation, Part part, Visit visit) {
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const Experiment& experiment = problem.experiments()[e];
    const Prediction& prediction = evaluation.predictions[e];
    const auto& measured = experiment.recording.measured;
    for (Index k = 0; k < prediction.simulated.cols(); ++k) {
      if (!in_part(experiment, k, part)) continue;
      for (Index c = 0; c < measured.rows(); ++c)
        if (!std::isnan(measured(c, k)))
          visit(static_cast<int>(e), k, static_cast<int>(c),
                prediction.simulated(c, k) - measured(c, k));
    }
  }
}

constexpr double kLeastNoise = 1e-12;  // m or rad: perfect data leave nothing to weigh by

/// Of every residual, its channel's place in a list of the channels of all recordings that have
/// any.
std::vector<std::size_t> channel_places(const Problem& problem, const Residuals& residuals) {
  std::map<std::pair<int, int>, std::size_t> found;  // (recording, channel), in order of appearance
  std::vector<std::size_t> places;
  for (const ResidualIndex& index : residuals.index) {
    const int source = problem.experiments()[static_cast<std::size_t>(index.experiment)].source;
    places.push_back(found.try_emplace({source, index.channel}, found.size()).first->second);
  }
  return places;
}

}  // namespace

Residuals residuals_of(const Problem& problem, const Evaluation& evaluation, Part part) {
  Residuals residuals;
  std::vector<double> values;
  for_each_seen(problem, evaluation, part, [&](int e, Index k, int c, double value) {
    residuals.index.push_back({e, c, k});
    values.push_back(value);
  });
  residuals.value = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Index>(values.size()));
  if (!evaluation.with_jacobian) return residuals;
  const auto unknowns = static_cast<Index>(problem.unknowns().size());
  residuals.jacobian.setZero(residuals.value.size(), unknowns);
  for (std::size_t first = 0, last = 0; first < residuals.index.size(); first = last) {
    const int e = residuals.index[first].experiment;
    while (last < residuals.index.size() && residuals.index[last].experiment == e) ++last;
    const auto& sensitivity = evaluation.predictions[static_cast<std::size_t>(e)].sensitivity;
    for (std::size_t j = 0; j < sensitivity.size(); ++j) {
      if (sensitivity[j].size() == 0) continue;  // of the start of another window
      auto along = residuals.jacobian.col(static_cast<Index>(j));
      for (std::size_t i = first; i < last; ++i)
        along[static_cast<Index>(i)] =
            sensitivity[j](residuals.index[i].channel, residuals.index[i].frame);
    }
  }
  return residuals;
}

Residuals fitted_residuals(const Problem& problem, const Evaluation& evaluation) {
  Residuals residuals = residuals_of(problem, evaluation, Part::kFit);
  const std::vector<Experiment>& experiments = problem.experiments();
  std::vector<bool> kept(residuals.index.size(), true);
  for (std::size_t first = 0, last = 0; first < kept.size(); first = last) {
    const auto e = static_cast<std::size_t>(residuals.index[first].experiment);
    while (last < kept.size() &&
           residuals.index[last].experiment == residuals.index[first].experiment)
      ++last;
    if (!experiments[e].noise) continue;
    const Recording& recording = experiments[e].recording;
    Eigen::MatrixXd matrix =
        Eigen::MatrixXd::Constant(recording.measured.rows(), recording.fit_frames, kNotGiven);
    const auto make_white = [&](auto&& values) {
      for (std::size_t i = first; i < last; ++i)
        matrix(residuals.index[i].channel, residuals.index[i].frame) =
            values[static_cast<Index>(i)];
      const Eigen::MatrixXd white = experiments[e].noise->whitened(matrix);
      for (std::size_t i = first; i < last; ++i)
        values[static_cast<Index>(i)] = white(residuals.index[i].channel, residuals.index[i].frame);
    };
    make_white(residuals.value);
    for (std::size_t i = first; i < last; ++i)
      kept[i] = !std::isnan(residuals.value[static_cast<Index>(i)]);
    const auto& sensitivity = evaluation.predictions[e].sensitivity;
    for (Index j = 0; j < residuals.jacobian.cols(); ++j)
      if (sensitivity[static_cast<std::size_t>(j)].size() > 0)  // else of another window's start
        make_white(residuals.jacobian.col(j));
  }
  if (std::find(kept.begin(), kept.end(), false) == kept.end()) return residuals;
  Residuals seen;
  std::vector<Index> rows;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) {
      rows.push_back(static_cast<Index>(i));
      seen.index.push_back(residuals.index[i]);
    }
  seen.value = residuals.value(rows);
  seen.jacobian =
      residuals.jacobian(residuals.jacobian.rows() > 0 ? rows : std::vector<Index>{}, Eigen::all);
  return seen;
}

std::vector<Distance> distances_of(const Problem& problem, const Residuals& residuals) {
  std::vector<Distance> out;
  for (std::size_t i = 0; i < residuals.index.size(); ++i) {
    const ResidualIndex& here = residuals.index[i];
    const auto point_of = [&](const ResidualIndex& index) {
      return problem.experiments()[static_cast<std::size_t>(index.experiment)]
          .recording.channels[static_cast<std::size_t>(index.channel)]
          .point;
    };
    if (i > 0) {
      const ResidualIndex& last = residuals.index[i - 1];
      if (last.experiment == here.experiment && last.frame == here.frame &&
          point_of(last) == point_of(here)) {
        ++out.back().count;
        continue;
      }
    }
    out.push_back({static_cast<Index>(i), 1});
  }
  return out;
}

SoftConstraints shooting_defects_of(const Problem& problem, const Evaluation& evaluation) {
  SoftConstraints defects;
  const Index size = 2 * problem.model().coordinates();
  Index count = 0;
  for (const Experiment& experiment : problem.experiments())
    count += experiment.meets >= 0 ? size : 0;
  defects.value.resize(count);
  defects.weight.resize(count);
  if (evaluation.with_jacobian)
    defects.jacobian.resize(count, static_cast<Index>(problem.unknowns().size()));
  Index row = 0;
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const Experiment& experiment = problem.experiments()[e];
    if (experiment.meets < 0) continue;
    const Prediction& here = evaluation.predictions[e];
    const Prediction& next = evaluation.predictions[static_cast<std::size_t>(experiment.meets)];
    defects.value.segment(row, size) = here.last - next.first;
    defects.weight.segment(row, size).setConstant(experiment.defect_weight /
                                                  experiment.noise_level());
    if (evaluation.with_jacobian)
      defects.jacobian.middleRows(row, size) = here.last_along - next.first_along;
    row += size;
  }
  return defects;
}

std::vector<Prior> priors_of(const Problem& problem) {
  std::vector<Prior> priors;
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    const int parameter = problem.unknowns()[j].parameter;
    if (parameter < 0) continue;
    const ParameterSpec& spec = problem.the_case().parameters[static_cast<std::size_t>(parameter)];
    if (!std::isnan(spec.standard_deviation))
      priors.push_back({static_cast<Index>(j), spec.measured, spec.standard_deviation});
  }
  return priors;
}

SoftConstraints constraints_of(const Problem& problem, const Evaluation& evaluation) {
  SoftConstraints all = shooting_defects_of(problem, evaluation);
  const std::vector<Prior> priors = priors_of(problem);
  all.priors = static_cast<Index>(priors.size());
  const Index defects = all.value.size(), count = defects + all.priors;
  all.value.conservativeResize(count);
  all.weight.conservativeResize(count);
  if (evaluation.with_jacobian) {
    all.jacobian.conservativeResize(count, evaluation.x.size());
    all.jacobian.bottomRows(count - defects).setZero();
  }
  for (std::size_t p = 0; p < priors.size(); ++p) {
    const Index row = defects + static_cast<Index>(p);
    all.value[row] = evaluation.x[priors[p].unknown] - priors[p].measured;
    all.weight[row] = 1 / priors[p].deviation;
    if (evaluation.with_jacobian) all.jacobian(row, priors[p].unknown) = 1;
  }
  return all;
}

Eigen::VectorXd noise_of(const Problem& problem, const Residuals& residuals) {
  Eigen::VectorXd noise(residuals.value.size());
  if (problem.the_case().error.measure == Measure::kLikelihood) {
    const std::vector<ChannelNoise> channels = channels_of(problem, residuals);
    const std::vector<std::size_t> places = channel_places(problem, residuals);
    for (std::size_t i = 0; i < places.size(); ++i)
      noise[static_cast<Index>(i)] = std::max(channels[places[i]].deviation, kLeastNoise);
    return noise;
  }
  for (std::size_t i = 0; i < residuals.index.size(); ++i) {
    const Experiment& experiment =
        problem.experiments()[static_cast<std::size_t>(residuals.index[i].experiment)];
    const bool white =
        experiment.noise && in_part(experiment, residuals.index[i].frame, Part::kFit);
    noise[static_cast<Index>(i)] = white ? 1 : experiment.noise_level();
  }
  return noise;
}

std::vector<ChannelNoise> channels_of(const Problem& problem, const Residuals& residuals) {
  const std::vector<std::size_t> places = channel_places(problem, residuals);
  std::vector<ChannelNoise> channels;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (channels.size() <= places[i]) channels.resize(places[i] + 1);
    ChannelNoise& channel = channels[places[i]];
    const Experiment& experiment =
        problem.experiments()[static_cast<std::size_t>(residuals.index[i].experiment)];
    channel.name =
        problem.the_case().experiments[static_cast<std::size_t>(experiment.source)].name + ": " +
        experiment.recording.channels[static_cast<std::size_t>(residuals.index[i].channel)].name;
    ++channel.count;
    channel.deviation +=
        residuals.value[static_cast<Index>(i)] * residuals.value[static_cast<Index>(i)];
  }
  for (ChannelNoise& channel : channels)
    channel.deviation = std::sqrt(channel.deviation / static_cast<double>(channel.count));
  return channels;
}

Eigen::VectorXd channel_weights(const Problem& problem, const Residuals& residuals) {
  std::vector<std::vector<double>> count(problem.experiments().size());
  for (std::size_t e = 0; e < count.size(); ++e)
    count[e].assign(problem.experiments()[e].recording.channels.size(), 0);
  for (const ResidualIndex& index : residuals.index)
    ++count[static_cast<std::size_t>(index.experiment)][static_cast<std::size_t>(index.channel)];
  double channels = 0;
  for (const auto& experiment : count)
    for (const double c : experiment) channels += c > 0;
  Eigen::VectorXd weights(residuals.value.size());
  for (std::size_t i = 0; i < residuals.index.size(); ++i)
    weights[static_cast<Index>(i)] =
        1 / (channels * count[static_cast<std::size_t>(residuals.index[i].experiment)]
                             [static_cast<std::size_t>(residuals.index[i].channel)]);
  return weights;
}

namespace {

/// The sum of rho(r^2) over residuals in units of their noise.
double sum_of_losses(const Problem& problem, const Eigen::VectorXd& r) {
  const ErrorSpec& error = problem.the_case().error;
  if (error.loss == Loss::kNone) return r.squaredNorm();
  double sum = 0;
  for (const double value : r) sum += loss_of(error, value * value).value;
  return sum;
}

/// The case's measure of residuals and constraints.
double error_of(const Problem& problem, const Residuals& residuals,
                const SoftConstraints& constraints) {
  double error = 0;
  switch (problem.the_case().error.measure) {
    case Measure::kLeastSquares:
      error = sum_of_losses(problem, residuals.value.cwiseQuotient(noise_of(problem, residuals))) +
              constraints.value.cwiseProduct(constraints.weight).squaredNorm();
      error = std::sqrt(error / static_cast<double>(residuals.value.size()));
      break;
    case Measure::kMeanDistance: {
      const std::vector<Distance> points = distances_of(problem, residuals);
      for (const Distance& point : points)
        error += residuals.value.segment(point.first, point.count).norm();
      error /= static_cast<double>(points.size());
      break;
    }
    case Measure::kMeanAbsolute:
      error = channel_weights(problem, residuals).dot(residuals.value.cwiseAbs());
      break;
    case Measure::kLikelihood:
      error = std::exp(noise_of(problem, residuals).array().log().mean());
      break;
  }
  return std::isfinite(error) ? error : kInfinite;
}

}  // namespace

double error_of(const Problem& problem, const Evaluation& evaluation, Part part) {
  if (!evaluation.ok) return kInfinite;
  const SoftConstraints constraints =
      part == Part::kFit ? constraints_of(problem, evaluation) : SoftConstraints{};
  return error_of(problem,
                  part == Part::kFit ? fitted_residuals(problem, evaluation)
                                     : residuals_of(problem, evaluation, part),
                  constraints);
}

const char* error_unit(const Problem& problem) {
  bool noise_known = false, angles = false;
  for (const Experiment& experiment : problem.experiments()) {
    noise_known |= experiment.noise || !std::isnan(experiment.spec.noise);
    angles |= experiment.spec.kind == DataKind::kAngles;
  }
  if (noise_known && problem.the_case().error.measure == Measure::kLeastSquares) return "1";
  return angles ? "rad" : "m";
}

Misfit misfit_of(const Problem& problem, const Evaluation& evaluation) {
  if (!evaluation.ok) return {false, {}, {}, kInfinite};
  Misfit misfit{true, fitted_residuals(problem, evaluation), constraints_of(problem, evaluation),
                0};
  misfit.error = error_of(problem, misfit.residuals, misfit.constraints);
  if (!std::isfinite(misfit.error)) return {false, {}, {}, kInfinite};
  return misfit;
}

double error_and_gradient(const Problem& problem, const Misfit& misfit, Eigen::VectorXd& gradient,
                          double rounding) {
  gradient.setZero(static_cast<Index>(problem.unknowns().size()));
  if (!misfit.ok) return kInfinite;
  const Residuals& residuals = misfit.residuals;
  const SoftConstraints& constraints = misfit.constraints;
  const Eigen::VectorXd& r = residuals.value;
  const auto rounded = [&](double square) { return std::sqrt(square + rounding * rounding); };
  Eigen::VectorXd by_residual(r.size());
  double error = 0;
  switch (problem.the_case().error.measure) {
    case Measure::kLeastSquares: {
      const Eigen::VectorXd noise = noise_of(problem, residuals);
      const auto count = static_cast<double>(r.size());
      const Eigen::VectorXd gaps = constraints.value.cwiseProduct(constraints.weight);
      error =
          std::sqrt((sum_of_losses(problem, r.cwiseQuotient(noise)) + gaps.squaredNorm()) / count);
      by_residual = r.array() / noise.array().square() / (count * error);
      const ErrorSpec& spec = problem.the_case().error;
      if (spec.loss != Loss::kNone)
        for (Index i = 0; i < r.size(); ++i)
          by_residual[i] *= loss_of(spec, std::pow(r[i] / noise[i], 2)).slope;
      gradient = constraints.jacobian.transpose() * gaps.cwiseProduct(constraints.weight) /
                 (count * error);
      break;
    }
    case Measure::kMeanDistance: {
      const std::vector<Distance> points = distances_of(problem, residuals);
      const auto count = static_cast<double>(points.size());
      for (const Distance& point : points) {
        const auto part = r.segment(point.first, point.count);
        const double distance = rounded(part.squaredNorm());
        error += distance / count;
        by_residual.segment(point.first, point.count) = part / (distance * count);
      }
      break;
    }
    case Measure::kLikelihood: {
      const Eigen::VectorXd noise = noise_of(problem, residuals);
      error = std::exp(noise.array().log().mean());
      by_residual = error / static_cast<double>(r.size()) * r.array() / noise.array().square();
      break;
    }
    case Measure::kMeanAbsolute: {
      const Eigen::VectorXd weights = channel_weights(problem, residuals);
      for (Index i = 0; i < r.size(); ++i) {
        const double size = rounded(r[i] * r[i]);
        error += weights[i] * size;
        by_residual[i] = weights[i] * r[i] / size;
      }
      break;
    }
  }
  gradient += residuals.jacobian.transpose() * by_residual;
  return error;
}

std::vector<Gap> gaps_of(const Problem& problem, const Evaluation& evaluation) {
  std::vector<Gap> gaps;
  for (const Part part : {Part::kFit, Part::kValidation}) {
    const Residuals residuals = residuals_of(problem, evaluation, part);
    const std::vector<Distance> points = distances_of(problem, residuals);
    for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
      Gap gap;
      gap.experiment = static_cast<int>(e);
      gap.part = part;
      Index seen = 0;
      for (const Distance& point : points) {
        if (residuals.index[static_cast<std::size_t>(point.first)].experiment != gap.experiment)
          continue;
        const auto r = residuals.value.segment(point.first, point.count);
        gap.count += point.count;
        ++seen;
        gap.rms += r.squaredNorm();
        gap.mean_absolute += r.cwiseAbs().sum();
        gap.mean_distance += r.norm();
        gap.largest = std::max(gap.largest, r.cwiseAbs().maxCoeff());
      }
      if (seen == 0) continue;
      gap.rms = std::sqrt(gap.rms / static_cast<double>(gap.count));
      gap.mean_absolute /= static_cast<double>(gap.count);
      gap.mean_distance /= static_cast<double>(seen);
      gaps.push_back(gap);
    }
  }
  return gaps;
}

}  // namespace catena
