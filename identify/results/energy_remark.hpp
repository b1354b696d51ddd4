// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "runtime/simulation.hpp"

namespace catena {

/// Words where the energy balance of a simulation is off by more than 1 % of the energy that changed form; else
/// empty.
std::string energy_remark(const Simulation& simulation);

}  // namespace catena
