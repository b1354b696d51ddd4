// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identify/diagnosis/bounded_fit.hpp"
#include "identify/diagnosis/candidate_search.hpp"
#include "identify/diagnosis/explanation.hpp"
#include "identify/diagnosis/maximum_statistic.hpp"

namespace catena {

/// Scores of everything that may be missing in a fitted model: one simulation with sensitivities in
/// a model that contains all candidates at their neutral values, and one for every point of the
/// grids of candidates with a shape.
class CandidateScores {
 public:
  /// `search` must outlive this object.
  explicit CandidateScores(const CandidateSearch& search);

  /// The most promising first: of a freer start and of the candidates that share a model, or of
  /// those that need models of their own (`own_models`). What cannot be tried says why. Throws
  /// Interrupted; std::runtime_error where the model cannot be simulated at the fit.
  std::vector<Explanation> score(bool own_models);

  /// The members of the pairs and triples of effects that would remove most together, of those scored
  /// so far, each at its best shape: all of them, linearised, with no simulation. The best ones first.
  std::vector<std::string> best_together() const;

  /// Sets the chance of every explanation that was refitted and leaves clearly less: that the best of
  /// all scored so far does as well (maximum_statistic.hpp).
  void set_chances(std::vector<Explanation>& explanations) const;

 private:
  /// One simulation with derivatives of the stacked residuals by some unknowns.
  struct Run {
    std::shared_ptr<const Problem> problem;
    Eigen::VectorXd x;
    std::vector<Eigen::Index> unknowns;
    Eigen::VectorXd shape;
    Eigen::MatrixXd columns;  ///< one per unknown
  };
  /// Where a candidate's columns are: in the common run from `column` on, or in `runs` runs of its
  /// own from `run` on.
  struct Place {
    Eigen::Index column = -1;
    std::size_t run = 0, runs = 0;
  };
  struct Plan {
    std::vector<Run> runs;               ///< the common one first
    Eigen::Index fitted = 0, start = 0;  ///< first columns of the common one
    std::vector<Place> places;           ///< one per candidate of the library
  };

  bool is_asked(const Candidate& candidate, bool own_models) const;
  Plan plan(bool own_models) const;
  void add_runs_of(const Candidate& candidate, Plan& plan, Place& place) const;
  Eigen::MatrixXd columns(const Run& run) const;

  /// `jacobian`: of the base's residuals, by its unknowns in the order of the common run.
  void begin_test(const Eigen::MatrixXd& jacobian);
  /// The base's unknowns, moved as its linearised fit moves them where something `moves` its residuals.
  Eigen::VectorXd base_beside(const Eigen::VectorXd& moves) const;
  void score_start(const Eigen::MatrixXd& derivatives, std::vector<Explanation>& out);
  Explanation score_candidate(const Plan& plan, std::size_t index);
  void score_limit(const Candidate& candidate, Explanation& explanation);
  double significance(const std::vector<int>& columns, const Score& score) const;

  const CandidateSearch& search_;
  std::shared_ptr<const Problem> all_;       // the model with all effects, everything free
  Eigen::VectorXd x_;                        // the base in it
  std::vector<double> frequencies_;          // Hz, where the residuals have lines
  std::map<std::string, std::string> same_;  // those that go by the name of another one
  std::unique_ptr<ScoreTest> test_;          // of the base
  Eigen::VectorXd left_;                     // the base's residuals and what its priors leave
  std::optional<BoundedFit> fit_;            // of the base, to these
  TriedColumns tried_;                       // in it
  std::map<std::string, std::vector<int>> best_columns_;  // of each effect, at its best shape
};

}  // namespace catena
