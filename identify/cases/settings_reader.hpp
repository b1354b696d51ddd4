// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/toml_reader.hpp"
#include "identify/cases/case.hpp"

namespace catena {

// How a case is fitted, simulated and diagnosed. Each function reads and checks the table of its name, and throws
// InputError with file, line, key, value and rule.

ErrorSpec read_error(const TomlTable& table);
OptimiserSpec read_optimiser(const TomlTable& table);
SimulationSpec read_simulation(const TomlTable& table);
DiagnosisSpec read_diagnosis(const TomlTable& table);

}  // namespace catena
