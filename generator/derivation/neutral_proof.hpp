// SPDX-License-Identifier: GPL-3.0-or-later
//
// Proves that a model whose parameters have their neutral values is the plain chain.
#pragma once

#include <string>
#include <vector>

#include "description/description.hpp"
#include "generator/derivation/closed_form_proof.hpp"

namespace catena {

struct NeutralProofs {
  std::vector<Proof> proofs;  ///< of the residual, each energy and each sensor
  std::string why_not;        ///< why nothing can be proved; else empty
};

/// Derives the model and the plain chain, inserts the neutral values and compares. All other
/// symbols stay: parameters without a neutral value, states and signals. Together with the closed
/// forms of the plain chain this proves those of the model. The equations and energies of a load with
/// coordinates of its own, which the plain chain lacks, must then contain nothing of the links. No proof is
/// possible if a neutral value is infinite, if links have further coordinates, or if the end is held.
NeutralProofs prove_neutral(const Description& description, int links);

}  // namespace catena
