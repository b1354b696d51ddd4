// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>

#include "identify/forces/force_law.hpp"

namespace catena {

/// A law as an effect file (docs/effects.md). It acts on one link of a chain, at a distance from its
/// middle: its amplitudes are of every link, and only this link's are not zero. A law at the end of
/// the cable acts on the load and names no link.
struct LawEffect {
  std::string text;         ///< of the TOML file
  int link = 0;             ///< from 1; 0: it names none
  double offset = 0;        ///< m, of the place from the middle of the link
  bool has_offset = false;  ///< the effect has it as a parameter, which may be fitted
};

/// `law`: found. `arc_length`: of its place, m, 0 for the torque. `lengths`: of the links, m.
LawEffect effect_of(const ForceLaw& law, const std::string& id, double arc_length,
                    const Eigen::VectorXd& lengths);

}  // namespace catena
