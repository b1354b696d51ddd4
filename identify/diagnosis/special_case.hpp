// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/diagnosis/candidate.hpp"
#include "runtime/model.hpp"

namespace catena {

/// Whether one effect is a special case of another (drag of steady wind): parameters of the same
/// name give the same residuals r, the other's further ones at their defaults. Tried at seeded
/// random states of a model that has both.
bool is_special_case(const Candidate& special, const Candidate& general, const Model& both);

}  // namespace catena
