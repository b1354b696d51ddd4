// SPDX-License-Identifier: BSD-3-Clause
#include "identify/error.hpp"

#include <cmath>
#include <limits>

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

/// Residuals that belong to one point: side and down of a marker, or one angle.
struct Distance {
  Index first = 0, count = 0;
};

/// Neighbouring residuals of the same marker and frame, together a distance.
std::vector<Distance> distances(const Problem& problem, const Residuals& residuals) {
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
  for (Index i = 0; i < residuals.value.size(); ++i) {
    const ResidualIndex& index = residuals.index[static_cast<std::size_t>(i)];
    const auto& sensitivity =
        evaluation.predictions[static_cast<std::size_t>(index.experiment)].sensitivity;
    for (Index j = 0; j < static_cast<Index>(sensitivity.size()); ++j)
      if (const auto& along = sensitivity[static_cast<std::size_t>(j)]; along.size())
        residuals.jacobian(i, j) = along(index.channel, index.frame);
  }
  return residuals;
}

Eigen::VectorXd noise_of(const Problem& problem, const Residuals& residuals) {
  Eigen::VectorXd noise(residuals.value.size());
  for (std::size_t i = 0; i < residuals.index.size(); ++i) {
    const double given =
        problem.experiments()[static_cast<std::size_t>(residuals.index[i].experiment)].spec.noise;
    noise[static_cast<Index>(i)] = std::isnan(given) ? 1 : given;
  }
  return noise;
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

double error_of(const Problem& problem, const Evaluation& evaluation, Part part) {
  if (!evaluation.ok) return std::numeric_limits<double>::infinity();
  const Residuals residuals = residuals_of(problem, evaluation, part);
  double error = 0;
  switch (problem.study().error.measure) {
    case Measure::kLeastSquares:
      error = std::sqrt(
          residuals.value.cwiseQuotient(noise_of(problem, residuals)).squaredNorm() /
          static_cast<double>(residuals.value.size()));
      break;
    case Measure::kMeanDistance: {
      const std::vector<Distance> points = distances(problem, residuals);
      for (const Distance& point : points)
        error += residuals.value.segment(point.first, point.count).norm();
      error /= static_cast<double>(points.size());
      break;
    }
    case Measure::kMeanAbsolute:
      error = channel_weights(problem, residuals).dot(residuals.value.cwiseAbs());
      break;
  }
  return std::isfinite(error) ? error : std::numeric_limits<double>::infinity();
}

double error_and_gradient(const Problem& problem, const Evaluation& evaluation,
                          Eigen::VectorXd& gradient, double rounding) {
  gradient.setZero(static_cast<Index>(problem.unknowns().size()));
  if (!evaluation.ok) return std::numeric_limits<double>::infinity();
  const Residuals residuals = residuals_of(problem, evaluation, Part::kFit);
  const Eigen::VectorXd& r = residuals.value;
  const auto rounded = [&](double square) { return std::sqrt(square + rounding * rounding); };
  Eigen::VectorXd by_residual(r.size());
  double error = 0;
  switch (problem.study().error.measure) {
    case Measure::kLeastSquares: {
      const Eigen::VectorXd noise = noise_of(problem, residuals);
      const auto count = static_cast<double>(r.size());
      error = std::sqrt(r.cwiseQuotient(noise).squaredNorm() / count);
      by_residual = r.array() / noise.array().square() / (count * error);
      break;
    }
    case Measure::kMeanDistance: {
      const std::vector<Distance> points = distances(problem, residuals);
      const auto count = static_cast<double>(points.size());
      for (const Distance& point : points) {
        const auto part = r.segment(point.first, point.count);
        const double distance = rounded(part.squaredNorm());
        error += distance / count;
        by_residual.segment(point.first, point.count) = part / (distance * count);
      }
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
  gradient = residuals.jacobian.transpose() * by_residual;
  return error;
}

std::vector<Gap> gaps_of(const Problem& problem, const Evaluation& evaluation) {
  std::vector<Gap> gaps;
  for (const Part part : {Part::kFit, Part::kValidation}) {
    const Residuals residuals = residuals_of(problem, evaluation, part);
    const std::vector<Distance> points = distances(problem, residuals);
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
