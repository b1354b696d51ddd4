// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "identify/diagnosis/candidate.hpp"
#include "identify/diagnosis/compare.hpp"
#include "identify/diagnosis/fitted_model.hpp"
#include "identify/diagnosis/score.hpp"
#include "identify/diagnosis/workshop.hpp"

namespace catena {

/// One explanation held against a fitted model: an effect, or a rival that is none.
struct Explanation {
  std::string id, title;
  int candidate = -1;  ///< index into the library; -1: a rival
  Score score;
  /// Starting values by the names of the unknowns: amplitudes, shapes and phases found by the
  /// score.
  std::vector<std::pair<std::string, double>> start;
  std::vector<std::pair<std::string, double>> other_start;  ///< of the best shape elsewhere
  double log10_p = 0;  ///< of the predicted fall, for one candidate
  std::string note;    ///< why it was not tried, or what to know about it

  bool refitted = false;
  FittedModel model;      ///< of the refit
  Comparison comparison;  ///< with the model it was added to
  GapTest fit, held_out;  ///< after the refit
};

inline constexpr const char* kStartShape = "start_shape";
inline constexpr const char* kTooFewLinks = "too_few_links";

/// One look at a fitted model: every candidate is scored with a single set of sensitivities, on one
/// model that contains them all at their neutral values.
class Search {
 public:
  /// `effects`: those of the library that are in the base already; they are not tried again.
  Search(Workshop& workshop, FittedModel base, std::vector<std::string> effects,
         std::vector<double> floors);

  /// Scores, the most promising first: of a freer start and of the candidates that share a model,
  /// or of those that need `own_models`.
  std::vector<Explanation> score(bool own_models);

  /// Adds the explanation for real and fits everything again, from its start and, if `far`, from a
  /// quarter of it and from its other start as well; keeps the best.
  void refit(Explanation& explanation, bool far) const;
  /// Again from three times the amplitudes found and from a third of them; keeps the best.
  void refit_from_elsewhere(Explanation& explanation) const;

  /// The `count` most promising admissible ones, on several threads.
  void refit_best(std::vector<Explanation>& explanations, int count, bool far) const;
  /// All admissible ones that were not.
  void refit_rest(std::vector<Explanation>& explanations) const;

  const FittedModel& base() const { return base_; }

 private:
  /// Derivatives of the stacked residuals by some unknowns.
  Eigen::MatrixXd columns(const Problem& problem, const Eigen::VectorXd& x,
                          const std::vector<Eigen::Index>& unknowns) const;
  void score_start(ScoreTest& test, const Eigen::MatrixXd& derivatives,
                   std::vector<Explanation>& out) const;
  Explanation score_limit(ScoreTest& test, int index) const;
  double significance(const ScoreTest& test, const std::vector<int>& columns,
                      const Score& score) const;

  /// Refits on several threads; tries the best of those that leave a gap from elsewhere.
  void refit_all(std::vector<Explanation*> chosen, bool far) const;
  /// Fits from a start; the explanation keeps the result if it is the best so far.
  void fit_from(Explanation& explanation, const std::shared_ptr<const Problem>& problem,
                const Eigen::VectorXd& start) const;
  /// `x` with the candidate's amplitudes times a factor, all its parameters within their bounds.
  Eigen::VectorXd scaled(const Candidate& candidate, const Problem& problem, Eigen::VectorXd x,
                         double factor) const;

  bool in_base(const std::string& id) const;
  std::vector<std::string> own_models_in_base() const;
  /// The base with a candidate added, all its parameters free.
  std::shared_ptr<const Problem> problem_with(const Candidate& candidate) const;

  Workshop& workshop_;
  FittedModel base_;
  std::vector<std::string> effects_;
  std::vector<double> floors_;
  std::shared_ptr<const Problem> all_;  // the model with all effects, everything free
  Eigen::VectorXd x_;                   // the base in it
  std::vector<double> frequencies_;     // Hz, where the residuals have lines
};

/// Frequencies (Hz) of the strongest lines in the residuals of the fitted part, at most `count`,
/// the strongest first, no two closer than what the length of the recording resolves.
std::vector<double> strongest_frequencies(const FittedModel& model,
                                          const std::vector<double>& floors, int count);

}  // namespace catena
