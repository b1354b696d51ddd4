// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an effect must not do: with its parameters at their neutral values a model is the plain
// chain.
#pragma once

#include <string>
#include <vector>

#include "description/description.hpp"
#include "generator/derivation/closed_form_proof.hpp"

namespace catena {

struct NeutralProofs {
  std::vector<Proof> proofs;  ///< the residual, each energy, what sensors report
  std::string why_not;        ///< nothing is proved, because ...; else empty
};

/// Derives the model and the plain chain, puts the neutral values in and compares, all other
/// symbols kept (parameters without a neutral value, states and signals too). With the closed forms
/// of the plain chain that proves those of the model. Not to be had where a neutral value is a
/// limit, or where there are coordinates that the plain chain does not have.
NeutralProofs prove_neutral(const Description& description, int links);

}  // namespace catena
