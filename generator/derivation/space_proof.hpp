// SPDX-License-Identifier: GPL-3.0-or-later
//
// The plain chain in space: its derivation compared with a closed form (reference/space.hpp), and with
// the chain of the plane.
#pragma once

#include <vector>

#include "description/description.hpp"
#include "generator/derivation/closed_form_proof.hpp"

namespace catena {

/// Derives the chain in space and compares each term of r, component by component, all symbols kept.
std::vector<Proof> prove_space_closed_form(int links);

/// A far end that is held, of a description with one: each link has its length times the force that holds the
/// end, and the constraint is g'' + 2 a g' + a^2 g with g the sum of the links less the place of the end.
Proof prove_constraint(const Description& description, int links, std::size_t place_held);

/// Puts a motion in a vertical plane of any azimuth into the derivation in space. What is left of r
/// along the plane, perpendicular to each link, has to be chapter 4; across the plane, zero. Angles
/// between neighbours are below half a turn.
std::vector<Proof> prove_plane_in_space(int links);

}  // namespace catena
