// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identify/fit/error.hpp"
#include "identify/fit/fit.hpp"
#include "identify/fit/links_study.hpp"
#include "identify/problem/motion.hpp"
#include "identify/results/result.hpp"
#include "identify/uncertainty/profile.hpp"
#include "identify/uncertainty/uncertainty.hpp"

namespace catena {

struct Effect;

/// Everything a result file of `catena identify` says, see docs/file-formats.md.
struct Identification {
  FitResult fit;
  Evaluation before, after;                ///< all frames, at the start and at the best
  std::vector<Motion> motions;             ///< one per experiment, at the best
  std::vector<FitResult> starts;           ///< of a multi-start, in their order
  std::optional<Uncertainty> uncertainty;  ///< nothing where it could not be had
  std::vector<Profile> profiles;
  Eigen::MatrixXd bootstrap;  ///< one row per refit
};

/// The case as its file has it.
results::CaseEntry case_entry(const Case& the_case);
/// What an effect adds to the equations.
std::vector<results::Formula> formula_entries(const Effect& effect);

/// result.json of `catena simulate`: a motion without data.
std::string simulation_result_text(const Problem& problem, const Motion& motion);
/// result.json of `catena simulate` where the case has data: motions and comparison at x.
std::string comparison_result_text(const Problem& problem, const Eigen::VectorXd& x,
                                   const Evaluation& evaluation,
                                   const std::vector<Motion>& motions);
/// result.json of `catena identify`.
std::string identification_result_text(const Problem& problem, const Identification& found);
/// links_study.json of `catena identify --links-study`.
std::string links_study_result_text(const Case& the_case, const std::vector<LinksResult>& studied);

}  // namespace catena
