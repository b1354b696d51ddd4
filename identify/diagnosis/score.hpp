// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace catena {

/// The score test. At a fitted model the residuals r (in units of the noise) have no part left
/// along the columns J of what the fit may change. A further parameter with column c would remove
/// from them what lies along the part of c that J cannot imitate:
///
///     c' = (I - Q Q^T) c,   J = Q R;   estimate = -(c'.r)/(c'.c'),   removed = (c'.r)^2/(c'.c')
///
/// and likewise for several columns together. Only a few per cent of c may survive the projection;
/// therefore it is done twice with an orthogonal Q, never through normal equations.

/// One column that may be added: the derivative of all residuals by one parameter, and how far that
/// parameter may go from its present value.
struct ScoreColumn {
  Eigen::VectorXd derivative;  ///< in units of the noise per unit of the parameter
  double lowest = 0, highest = 0;
};

/// All subsets of the columns with a bound are tried.
inline constexpr std::size_t kMostBoundedColumns = 16;

struct Score {
  Eigen::VectorXd estimate;  ///< change of each parameter
  double removed = 0;        ///< fall of the sum of squares, in units of the noise squared
  double share = 0;          ///< removed / sum of squares now
  double survives = 0;  ///< |c'| / |c| of the columns at the estimate: what the fit cannot imitate
  bool admissible = false;  ///< some parameter moves, and to its allowed side
  bool beyond = false;      ///< the estimate went past the far bound and was cut back to it
};

class ScoreTest {
 public:
  /// `residual`: stacked; `jacobian`: its derivative by everything that is fitted.
  ScoreTest(Eigen::VectorXd residual, const Eigen::MatrixXd& jacobian);

  /// Adds a column; returns its number.
  int add(const ScoreColumn& column);

  /// Fit of a set of columns together, each within its bounds: of all subsets whose own
  /// least-squares solution is within bounds, the one that removes most. A column without bounds is
  /// in every subset, and there may be any number of those. Throws std::invalid_argument for more
  /// than kMostBoundedColumns with a bound.
  Score score(const std::vector<int>& columns) const;

  /// What would be left after moving the columns by `estimate`, first order.
  Eigen::VectorXd residual_after(const std::vector<int>& columns,
                                 const Eigen::VectorXd& estimate) const;

  /// The part of a column (or of any difference of trajectories) that the fit cannot imitate.
  Eigen::VectorXd project(const Eigen::VectorXd& column) const;
  /// The same of every column of a matrix, at once: the fit's own columns are read once for all.
  Eigen::MatrixXd project_all(const Eigen::MatrixXd& columns) const;

  /// The part of the residuals that no move of the fit's unknowns takes away.
  const Eigen::VectorXd& residual() const { return residual_; }

  // The same score for many other residuals, in steps.

  /// The part of a column that the fit cannot imitate, of size 1; anything where nothing is left.
  const Eigen::VectorXd& direction(int column) const { return kept(column).projected; }
  /// The products of the directions of some columns with each other; 0 where nothing is left.
  Eigen::MatrixXd products_of(const std::vector<int>& columns) const;
  /// The best step of some columns within their bounds.
  struct Step {
    Eigen::VectorXd along;  ///< each direction; 0 for those left out
    double removed = 0;     ///< fall of the sum of squares
    bool beyond = false;    ///< cut back to a bound
  };
  /// `products`: of the directions with each other; `residual`: products of them with the residual.
  Step best_step(const std::vector<int>& columns, const Eigen::MatrixXd& products,
                 const Eigen::VectorXd& residual) const;

 private:
  struct Kept {
    Eigen::VectorXd projected;  // divided by `size`
    double size = 0;            // |c'|
    double whole = 0;           // |c|
    double lowest = 0, highest = 0;
    double along = 0;  // projected . r
  };
  const Kept& kept(int column) const { return columns_[static_cast<std::size_t>(column)]; }
  Eigen::VectorXd residual_;  // projected as well
  double squares_ = 0;
  Eigen::MatrixXd orthogonal_;  // Q
  std::vector<Kept> columns_;
};

}  // namespace catena
