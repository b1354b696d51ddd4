// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

class DiagnosisState;

/// A share; 1 is the whole misfit of the model without effects.
struct ShareInterval {
  double share = 0;
  /// 95 % interval of what it would be without noise and with other errors of the laws.
  double lower = 0, upper = 0;
  /// Lower end of the 95 % interval of what it would be in an endless motion like this.
  double least = 0;
};

/// What one effect takes away of the misfit.
struct EffectShare {
  std::string effect;
  ShareInterval fitted, held_out;
};

/// How the misfit of the model without effects, with the last number of links, divides among the
/// effects found and what they leave. The misfit is the mean square of the residuals over the noise,
/// less one.
///
/// An effect explains more or less by the order in which effects are added. Its share is the mean
/// over all orders (Shapley value). That needs a fit with every subset of the effects.
///
/// The intervals are of the same motion with other errors: noise, and what laws get wrong (redrawn_errors.hpp). How
/// much a share depends on this stretch of motion, `least` says: it comes from a moving-block bootstrap, in which
/// blocks of frames are drawn again from the residuals of all these fits together. Neither says whether the effects
/// are the right ones.
struct Shares {
  std::vector<EffectShare> effects;          ///< in the order found
  ShareInterval left_fitted, left_held_out;  ///< what is left with all of them
  bool has_held_out = false;
  bool empty() const { return effects.empty(); }
};

/// Shares of the effects of `state.found.final`. Empty without effects, and where the model with some
/// of them cannot be fitted. Throws Interrupted.
Shares shares_of(DiagnosisState& state);

/// The final model's case with some of its effects (`kept`, in the order found), fitted from where the
/// whole ended. Those of shares_of() are known.
FittedModel fit_with_effects(DiagnosisState& state, const std::vector<std::string>& kept);

/// For every subset of the effects (bit i of the index: effect i is in it) the residuals of each
/// experiment, channels x frames; NaN where nothing was measured.
using SubsetResiduals = std::vector<std::vector<Eigen::MatrixXd>>;

/// Residuals with errors that were drawn, with noise and without.
struct DrawnResiduals {
  explicit DrawnResiduals(std::size_t draws) : with_noise(draws), without_noise(draws) {}
  std::vector<SubsetResiduals> with_noise, without_noise;
};

/// One interval per effect, then that of what is left. Empty where the model without effects leaves no misfit.
std::vector<ShareInterval> share_intervals(const SubsetResiduals& residuals,
                                           const DrawnResiduals& drawn,
                                           const std::vector<double>& sigmas);

}  // namespace catena
