// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "identify/forces/candidate_law.hpp"
#include "identify/forces/force_path.hpp"
#include "identify/forces/law_response.hpp"

namespace catena {

/// The motions found.
std::vector<LawMotion> motions_of(const ForcePaths& paths);

/// A formula of a law, and its fit with its force following the state.
struct FittedForm {
  CandidateLaw law;
  std::vector<int> form;
  Eigen::VectorXd coefficients = {};
  Eigen::MatrixXd covariance = {};  ///< of the coefficients and the law's numbers
  double squares = HUGE_VAL, freedom = 0;
  double without = HUGE_VAL;  ///< squares without a law

  double constants() const { return law.constants(form); }
};

/// Fits formulas to recordings that are linear about a motion. The force follows the state: its slopes enter the
/// equations. `linear`: with a torque on every link as its forces, about the motion of `paths`; both may change
/// between two calls.
class LawFit {
 public:
  LawFit(const ForcePaths& paths, const LinearProblem& linear, const LawChain& chain)
      : paths_(paths), linear_(linear), chain_(chain) {}

  /// The linear problem with what a law remembers behind the states.
  LinearProblem with_memory(const CandidateLaw& law) const;
  /// The terms of a form along the motion. With coefficients also how the law's force changes with
  /// each of its numbers, and how it follows the state.
  std::vector<NodeForces> forces_of(const CandidateLaw& law, const std::vector<int>& form,
                                    const Eigen::VectorXd& coefficients) const;
  /// The coefficients and numbers of least squares, by Gauss-Newton steps. They begin with those given; there may be no
  /// coefficients.
  FittedForm fit(const FittedForm& begin, FrameHalf half = FrameHalf::kBoth) const;
  /// The same, where pieces of a curve that would make energy are left out, one by one.
  FittedForm fit_without_drive(const FittedForm& begin, FrameHalf half = FrameHalf::kBoth) const;

 private:
  const ForcePaths& paths_;
  const LinearProblem& linear_;
  const LawChain& chain_;
};

}  // namespace catena
