// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "identify/fit/fit.hpp"

namespace catena {

/// One physical cable fitted with one number of links.
struct LinksResult {
  int links = 0;
  FitResult fit;
  double validation_error = 0;     ///< in the case's measure; NaN without validation data
  std::vector<std::string> names;  ///< of the unknowns
};

/// The case with another number of links. Throws InputError where the case says things that only
/// hold for its own number: numbers per link, single joints, ranges.
Case case_for_links(const Case& the_case, int links);

/// Fits the case with each number of links.
std::vector<LinksResult> links_study(const Case& the_case, const std::vector<int>& links,
                                     const std::function<Model(const Case&)>& model_of,
                                     const FitOptions& options, const LeastSquares& least_squares);

/// The fewest links whose error is within (1 + budget) of the least error of all; -1 if none
/// succeeded.
int recommended_links(const std::vector<LinksResult>& results, double budget);

/// Whether the most links leave more than (1 + budget) times the least error. Finer chains of a right
/// model leave less.
bool more_links_are_worse(const std::vector<LinksResult>& results, double budget);

}  // namespace catena
