// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>

#include "identify/cases/case.hpp"

namespace catena {

/// The value at x and, if `gradient` is not null, its gradient there. Infinite: worse than all
/// else.
using Objective = std::function<double(const Eigen::VectorXd& x, Eigen::VectorXd* gradient)>;

struct MinimiserOptions {
  FitMethod method = FitMethod::kNelderMead;  ///< any but kLeastSquares
  Eigen::VectorXd lower, upper;               ///< bounds, may be infinite; empty: none
  Eigen::VectorXd
      first_steps;  ///< of the simplex (Nelder-Mead), none of them 0; empty: NLopt's choice
  double x_tolerance = 1e-6;  ///< relative; the search ends where either is reached
  double value_tolerance = 1e-6;
  std::function<bool()> must_stop;  ///< asked after each evaluation
};

struct Minimum {
  Eigen::VectorXd x;
  double value = 0;
  bool stopped = false;  ///< must_stop said so
  std::string message;   ///< empty unless the method gave up early
};

/// The least value of a function, by NLopt: Nelder-Mead's simplex with the coefficients of chapter
/// 5 (reflection 1, expansion 2, contraction and shrink 1/2; bounds by projection) or one of the
/// bounded gradient methods. Throws std::invalid_argument for sizes that do not fit and for
/// kLeastSquares.
Minimum minimise(const Objective& objective, const Eigen::VectorXd& start,
                 const MinimiserOptions& options);

}  // namespace catena
