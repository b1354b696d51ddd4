// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/diagnosis/compare.hpp"
#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// What a finer chain says about a gap.
struct FinerChain {
  int links = 0;
  std::string note;      ///< why it was not tried or not taken
  double predicted = 0;  ///< rms change of the prediction that the fit cannot absorb, m or rad
  bool refitted = false;
  FittedModel model;
  Comparison comparison;
  bool taken = false;
};

/// Too few links, the first rival of every effect: simulates with twice the links, or with as many
/// as are allowed, at the same physical values. Where what changes, less what the free parameters
/// absorb, is no small part of the misfit, refits; taken if that explains a good part of the
/// misfit.
FinerChain try_finer_chain(const FittedModel& model, const std::vector<std::string>& effects,
                           const std::vector<NoiseModel>& noise, int max_links,
                           DiagnosisContext& context);

/// Where a fit with another number of links begins: unknowns of `problem` that make its cable the model's. Joints of a finer
/// chain turn less: what goes with a power of a joint's angle or rate has a coefficient that goes with that power of
/// the number of links. Of powers from 0 to 3 each effect has the one with which a simulation leaves least.
Eigen::VectorXd start_with_links(const FittedModel& model, const Problem& problem,
                                 const std::vector<std::string>& effects,
                                 const std::vector<NoiseModel>& noise,
                                 const DiagnosisContext& context);

/// The same model with another number of links, fitted; not ok where the case cannot have it.
FittedModel refitted_with_links(const FittedModel& model, int links,
                                const std::vector<std::string>& effects,
                                const std::vector<NoiseModel>& noise, DiagnosisContext& context);
/// The same, as closely as a search needs (RefitLimits).
FittedModel tried_with_links(const FittedModel& model, int links,
                             const std::vector<std::string>& effects,
                             const std::vector<NoiseModel>& noise, DiagnosisContext& context);

}  // namespace catena
