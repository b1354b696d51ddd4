// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

namespace catena::checking {

/// A part of a quantity and its origin in the chain, such as "kinetic energy of link 3".
struct Contribution {
  std::string origin;
  GiNaC::ex value;
};
using Contributions = std::vector<Contribution>;

/// The sum of the parts.
GiNaC::ex total(const Contributions& parts);

}  // namespace catena::checking
