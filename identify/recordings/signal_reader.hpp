// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/cases/case.hpp"
#include "runtime/model.hpp"
#include "runtime/signals.hpp"

namespace catena {

/// Reads what the model asks for as functions of time, in the model's order. Throws InputError
/// naming a signal that is not given (at `where`), a file, a line or a column.
Signals read_signals(const std::vector<SignalSpec>& specs, const Model& model,
                     const std::string& where);

}  // namespace catena
