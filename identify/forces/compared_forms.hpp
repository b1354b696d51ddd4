// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "identify/forces/law_fit.hpp"

namespace catena {

/// Formulas of laws that were fitted to the same linear equations, and which of them the data prefer.
struct ComparedForms {
  std::vector<FittedForm> fits;
  double inflation =
      1;  ///< of the noise's variance: what the closest formula leaves, where that is more than 1
  std::size_t best = 0;

  /// The Bayesian information criterion: less is better.
  double criterion(const FittedForm& fitted) const;
  /// Those that the data do not tell from the best (LawThresholds::undecided), and pushes in other directions.
  std::vector<const FittedForm*> not_told_from_best() const;
  /// Other formulas: most probable first, one of each pair. Of the best one's pair only if that is a curve.
  std::vector<const FittedForm*> behind_best() const;
  /// Of one of these: squared residuals, over the noise, beyond what would leave it undecided, in the mean.
  double left_more(const FittedForm& fitted) const;
};

/// Fits each from where it begins. The best is the simplest that the data do not decide against, less terms that do
/// hardly anything. Nothing where none makes a law.
std::optional<ComparedForms> compared_forms(const LawFit& fits,
                                            const std::vector<FittedForm>& begins);

}  // namespace catena
