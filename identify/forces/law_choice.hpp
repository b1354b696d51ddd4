// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <optional>
#include <vector>

#include "identify/forces/candidate_law.hpp"

namespace catena {

/// The recorded part (first) and random ones, without what the unknowns imitate, and what the terms of
/// every candidate have to do with them.
struct LawTrials {
  struct OfCandidate {
    /// Products of the terms that stand together in a form, terms x terms. A push at any moment has a form a frame,
    /// each of one term.
    Eigen::SparseMatrix<double> gram;
    Eigen::MatrixXd cross;  ///< terms x columns
  };
  std::vector<OfCandidate> candidates;
  Eigen::VectorXd squares;  // of each column
  Eigen::MatrixXd noise;    // in the random ones
  Eigen::Index rows = 0, seen = 0;
};

/// The products of these terms, the columns of `terms`, that `forms` need.
Eigen::SparseMatrix<double> products_in_forms(const Eigen::Ref<const Eigen::MatrixXd>& terms,
                                              const std::vector<std::vector<int>>& forms);

/// A formula fitted to some columns of trials: its coefficients, and how much it takes off the squares.
struct LinearFit {
  Eigen::MatrixXd coefficients;  // terms x columns
  Eigen::VectorXd explained;
};
std::optional<LinearFit> fit_of(const LawTrials::OfCandidate& candidate,
                                const std::vector<int>& form, Eigen::Index first,
                                Eigen::Index columns);

/// A law fitted to one column: its form, without the pieces of a curve that make energy or are of no use.
struct FittedColumn {
  std::vector<int> form;
  Eigen::VectorXd coefficients;
  double explained = 0;
};
/// Nothing where it is no law. `cost`: what each constant has to take off the squares.
std::optional<FittedColumn> fit_of_column(const CandidateLaw& law,
                                          const LawTrials::OfCandidate& candidate,
                                          std::vector<int> form, Eigen::Index column, double cost);

/// The candidate and its form that explain most of a column, and what they say.
struct ChosenLaw {
  std::size_t candidate = 0;
  std::vector<int> form;
  double score = 0;  ///< share explained, less what so many free constants explain by chance
  Eigen::VectorXd coefficients;
  /// Of the squares of the second part, where its force follows the state there.
  std::optional<double> explained_in_second = std::nullopt;
};

/// The best candidate for each column of the trials, of formulas or of curves.
enum class LawForms { kFormulas, kCurves };
std::vector<ChosenLaw> choose_law(const std::vector<CandidateLaw>& candidates,
                                  const LawTrials& trials, LawForms of);

/// What a law with its coefficients takes off the squares of a column.
double explained_squares(const LawTrials& trials, Eigen::Index column, const ChosenLaw& law);
/// Of what can be explained of a column, down to the squares `least`: the share that a law does.
double explained_by_law(const LawTrials& trials, Eigen::Index column, const ChosenLaw& law,
                        double least);

}  // namespace catena
