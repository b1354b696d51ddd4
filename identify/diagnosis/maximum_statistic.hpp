// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "identify/diagnosis/score.hpp"

namespace catena {

/// What was tried: for each candidate, by name, the columns of a ScoreTest at each of its shapes.
using TriedColumns = std::map<std::string, std::vector<std::vector<int>>>;

/// Could the best of all that was tried do as well by chance?
///
/// A model that is right but for errors leaves residuals that go with no candidate. Such errors are
/// drawn kRandomSeries times, with the spectrum and the correlations between channels of those that a good
/// explanation leaves, and every candidate at every shape is scored on each: linearised, with no
/// simulation. What a candidate explains of residuals r is v; its statistic is
///
///     (v.r)^2 / (v' S v)  over its mean for the random errors,
///
/// S: the covariance of what it leaves, from the spectrum of that (CosineSpectrum). So smooth errors
/// count for what they can imitate, and many unknowns are no advantage. The largest statistics of
/// the random errors are what chance does.
class MaximumStatistic {
 public:
  /// `left`: white residuals of a good explanation, channels x frames of each recording, NaN where
  /// nothing was seen. `check` is called before each draw; what it throws ends the work. Throws
  /// std::invalid_argument where `left` is not of the size of the test's residual.
  MaximumStatistic(const ScoreTest& test, const TriedColumns& tried,
                   const std::vector<Eigen::MatrixXd>& left, int threads,
                   const std::function<void()>& check);

  /// Probability that the best of all does as well as `which`, which explained `before` down to
  /// `left` (white residuals). At least 1/200.
  double chance(const std::string& which, const std::vector<Eigen::MatrixXd>& before,
                const std::vector<Eigen::MatrixXd>& left) const;

 private:
  std::map<std::string, double> mean_;  // of the statistic of each candidate
  Eigen::VectorXd largest_;             // of each random error
};

}  // namespace catena
