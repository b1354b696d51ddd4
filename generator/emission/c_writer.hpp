// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model as one file of plain C99, for embedding: the same table of functions, in double
// precision, standard library only, nothing allocated. It has no Newton matrix; accelerations take
// O(n) where the mass matrix has the structure for it.
#pragma once

#include "description/description.hpp"
#include "generator/emission/model_writer.hpp"

namespace catena {

/// <name>.c and <name>.h, name = model_name(description, links); they include catena_model.h.
EmittedModel emit_c_model(const Description& description, int links, Layout layout);

}  // namespace catena
