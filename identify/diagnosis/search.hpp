// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "identify/diagnosis/candidate.hpp"
#include "identify/diagnosis/compare.hpp"
#include "identify/diagnosis/fitted_model.hpp"
#include "identify/diagnosis/score.hpp"
#include "identify/model_provider.hpp"

namespace catena {

/// What every part of a diagnosis needs from outside.
struct SearchContext {
  std::filesystem::path work;  ///< folder for descriptions
  LeastSquares least_squares;
  ProviderOptions provider;
  const std::atomic<bool>* stop = nullptr;
  int threads = 2;
  std::function<void(const std::string&)> notice;  ///< one line on what is being done

  void say(const std::string& text) const {
    if (notice) notice(text);
  }
  bool stopped() const { return stop && stop->load(); }
};

/// One explanation held against a fitted model: an effect, or a rival that is none.
struct Explanation {
  std::string id, title;
  int candidate = -1;  ///< index into the library; -1: a rival
  Score score;
  /// Starting values by the names of the unknowns: amplitudes, shapes and phases found by the score.
  std::vector<std::pair<std::string, double>> start;
  double log10_p = 0;  ///< of the predicted fall, for one candidate
  std::string note;    ///< why it was not tried, or what to know about it

  bool refitted = false;
  FittedModel model;       ///< of the refit
  Comparison comparison;   ///< with the model it was added to
  GapTest fit, held_out;   ///< after the refit
};

inline constexpr const char* kStartShape = "start_shape";
inline constexpr const char* kTooFewLinks = "too_few_links";

/// One look at a fitted model: every candidate is scored with a single set of sensitivities, on one
/// model that contains them all at their neutral values.
class Search {
 public:
  Search(const SearchContext& context, const std::vector<Candidate>& library, FittedModel base,
         std::vector<double> floors);

  /// Scores of all candidates and of a freer start, the most promising first.
  std::vector<Explanation> score();

  /// Adds the explanation for real and fits everything again, from its start and, if `far`, from a
  /// quarter of it as well; keeps the better.
  void refit(Explanation& explanation, bool far) const;

  /// The `count` most promising admissible ones, on several threads.
  void refit_best(std::vector<Explanation>& explanations, int count, bool far) const;

  const FittedModel& base() const { return base_; }

 private:
  struct Columns {
    std::vector<Eigen::VectorXd> value;  // one per direction, stacked over the fitted experiments
  };
  Eigen::MatrixXd columns(const Problem& problem, const Eigen::VectorXd& x,
                          const std::vector<Eigen::Index>& unknowns) const;
  void score_start(ScoreTest& test, const Eigen::MatrixXd& derivatives,
                   std::vector<Explanation>& out) const;
  Explanation score_candidate(ScoreTest& test, int index) const;
  Explanation score_limit(ScoreTest& test, int index) const;
  double significance(const ScoreTest& test, const std::vector<int>& columns,
                      const Score& score) const;

  const SearchContext& context_;
  const std::vector<Candidate>& library_;
  FittedModel base_;
  std::vector<double> floors_;
  std::vector<Candidate> together_;  // those that share the model
  std::shared_ptr<const Problem> all_;  // the model with all of them, everything free
  std::filesystem::path description_;
  Eigen::VectorXd x_;  // the base in it
  std::vector<double> frequencies_;
};

/// Runs f(0) .. f(count - 1) on so many threads.
void run_parallel(int threads, int count, const std::function<void(int)>& f);

/// Frequencies (Hz) of the strongest lines in the residuals of the fitted part, at most `count`, the
/// strongest first, no two closer than what the length of the recording resolves.
std::vector<double> strongest_frequencies(const FittedModel& model,
                                          const std::vector<double>& floors, int count);

}  // namespace catena
