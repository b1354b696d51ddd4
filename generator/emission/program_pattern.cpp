// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/program_pattern.hpp"

#include <stdexcept>

namespace catena {

Affine affine_through(long here, long there, long links) {
  const long slope = there - here;
  return {here - slope * links, slope};
}

Statements for_any_links(Statements here, Statements there, long links) {
  std::vector<Affine*> integers;
  for_each_affine(there, [&](Affine& integer) { integers.push_back(&integer); });
  std::vector<Affine> any;
  for_each_affine(here, [&](const Affine& integer) {
    if (any.size() == integers.size()) return;  // a difference found below
    Affine& other = *integers[any.size()];
    any.push_back(affine_through(integer.constant, other.constant, links));
    other = integer;
  });
  if (here != there)
    throw std::logic_error("statements differ between numbers of links in more than integers");
  auto next = any.begin();
  for_each_affine(here, [&](Affine& integer) { integer = *next++; });
  return here;
}

}  // namespace catena
