// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/maximum_statistic.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "common/parallel.hpp"
#include "identify/diagnosis/stacking.hpp"
#include "identify/noise/cosine_spectrum.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::uint64_t kSeed = 16;
/// Random errors that are projected and scored at once: they stay in the processor's cache.
constexpr Index kTogether = 16;

/// Of every recording.
using Spectra = std::vector<MatrixXd>;
Spectra spectra_of(const std::vector<MatrixXd>& parts) {
  Spectra spectra;
  for (const MatrixXd& part : parts) spectra.push_back(cosine_spectrum(part));
  return spectra;
}

/// What was removed, squared, over its variance for errors like those that are left.
double statistic(double removed, const Spectra& explained, const Spectra& left) {
  double variance = 0;
  for (std::size_t r = 0; r < left.size(); ++r) variance += variance_along(left[r], explained[r]);
  return variance > 0 ? removed * removed / variance : 0;
}

/// A candidate at one shape, as it is scored on random errors.
class TriedShape {
 public:
  TriedShape(const ScoreTest& test, std::vector<int> columns, const std::vector<MatrixXd>& seen)
      : columns_(std::move(columns)), products_(test.products_of(columns_)) {
    for (const int column : columns_)
      spectra_.push_back(spectra_of(unstacked(test.direction(column), seen)));
  }

  /// Of each column of `errors`.
  std::vector<ScoreTest::Step> steps(const ScoreTest& test, const MatrixXd& errors) const {
    MatrixXd directions(errors.rows(), products_.rows());
    for (Index i = 0; i < directions.cols(); ++i)
      directions.col(i) = test.direction(columns_[static_cast<std::size_t>(i)]);
    const MatrixXd along = directions.transpose() * errors;
    std::vector<ScoreTest::Step> steps;
    steps.reserve(static_cast<std::size_t>(errors.cols()));
    for (Index s = 0; s < errors.cols(); ++s)
      steps.push_back(test.best_step(columns_, products_, along.col(s)));
    return steps;
  }

  double statistic_of(const ScoreTest::Step& step, const Spectra& errors) const {
    Spectra explained, left = errors;
    for (std::size_t r = 0; r < errors.size(); ++r) {
      MatrixXd& of_recording =
          explained.emplace_back(MatrixXd::Zero(errors[r].rows(), errors[r].cols()));
      for (std::size_t i = 0; i < columns_.size(); ++i)
        of_recording += step.along[static_cast<Index>(i)] * spectra_[i][r];
      left[r] += of_recording;
    }
    return statistic(step.removed, explained, left);
  }

 private:
  std::vector<int> columns_;
  MatrixXd products_;
  std::vector<Spectra> spectra_;  // of the directions
};

/// The statistics of a candidate for random errors, the columns of `errors`, each at the shape that removes most.
/// `spectra`: of each.
Eigen::RowVectorXd best_statistics(const ScoreTest& test, const std::vector<TriedShape>& shapes,
                                   const MatrixXd& errors, const std::vector<Spectra>& spectra) {
  std::vector<ScoreTest::Step> best(spectra.size());
  std::vector<const TriedShape*> at(spectra.size(), nullptr);
  for (const TriedShape& shape : shapes) {
    std::vector<ScoreTest::Step> steps = shape.steps(test, errors);
    for (std::size_t s = 0; s < steps.size(); ++s) {
      if (steps[s].removed <= best[s].removed) continue;
      best[s] = std::move(steps[s]);
      at[s] = &shape;
    }
  }
  Eigen::RowVectorXd statistics(errors.cols());
  for (std::size_t s = 0; s < spectra.size(); ++s)
    statistics[static_cast<Index>(s)] = at[s] ? at[s]->statistic_of(best[s], spectra[s]) : 0;
  return statistics;
}

}  // namespace

MaximumStatistic::MaximumStatistic(const ScoreTest& test, const TriedColumns& tried,
                                   const std::vector<MatrixXd>& left, int threads,
                                   const std::function<void()>& check) {
  if (stacked_where_seen(left, left).size() != test.residual().size())
    throw std::invalid_argument("what is left has another size than the residuals");
  std::vector<std::vector<TriedShape>> candidates;
  for (const auto& [name, shapes] : tried) {
    std::vector<TriedShape>& of_candidate = candidates.emplace_back();
    for (const std::vector<int>& columns : shapes) of_candidate.emplace_back(test, columns, left);
  }

  const Spectra spectra = spectra_of(left);
  MatrixXd statistics(static_cast<Index>(candidates.size()), kRandomSeries);
  const auto blocks = static_cast<std::size_t>((kRandomSeries + kTogether - 1) / kTogether);
  in_parallel(blocks, threads, [&](std::size_t block) {
    const Index first = static_cast<Index>(block) * kTogether;
    const Index count = std::min<Index>(kTogether, kRandomSeries - first);
    MatrixXd errors(test.residual().size(), count);
    for (Index s = 0; s < count; ++s) {
      check();
      std::mt19937_64 random(kSeed + static_cast<std::uint64_t>(first + s));
      std::vector<MatrixXd> drawn;
      for (std::size_t r = 0; r < left.size(); ++r)
        drawn.push_back(random_series(spectra[r], left[r].cols(), random));
      errors.col(s) = stacked_where_seen(drawn, left);
    }
    errors = test.project_all(errors);
    std::vector<Spectra> of_errors;
    for (Index s = 0; s < count; ++s)
      of_errors.push_back(spectra_of(unstacked(errors.col(s), left)));
    for (std::size_t c = 0; c < candidates.size(); ++c) {
      check();
      statistics.row(static_cast<Index>(c)).segment(first, count) =
          best_statistics(test, candidates[c], errors, of_errors);
    }
  });

  largest_ = VectorXd::Zero(kRandomSeries);
  Index row = 0;
  for (const auto& [name, shapes] : tried) {
    const VectorXd of_candidate = statistics.row(row++);
    mean_[name] = of_candidate.mean();
    if (mean_[name] > 0) largest_ = largest_.cwiseMax(of_candidate / mean_[name]);
  }
}

double MaximumStatistic::chance(const std::string& which, const std::vector<MatrixXd>& before,
                                const std::vector<MatrixXd>& left) const {
  const auto mean = mean_.find(which);
  if (mean == mean_.end() || !(mean->second > 0)) return 1;
  double removed = 0;
  std::vector<MatrixXd> explained;
  for (std::size_t r = 0; r < left.size(); ++r) {
    const auto squares = [](const MatrixXd& m) {
      return m.array().isNaN().select(0, m).squaredNorm();
    };
    removed += squares(before[r]) - squares(left[r]);
    explained.emplace_back(before[r] - left[r]);
  }
  if (!(removed > 0)) return 1;
  const double observed =
      statistic(removed, spectra_of(explained), spectra_of(left)) / mean->second;
  return (1.0 + static_cast<double>((largest_.array() >= observed).count())) /
         (1.0 + kRandomSeries);
}

}  // namespace catena
