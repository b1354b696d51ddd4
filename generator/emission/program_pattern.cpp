// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/program_pattern.hpp"

#include <stdexcept>

namespace catena {

Statements for_any_links(Statements here, Statements there, long links) {
  std::vector<Affine*> integers;
  for_each_affine(there, [&](Affine& integer) { integers.push_back(&integer); });
  std::vector<Affine> any;
  for_each_affine(here, [&](const Affine& integer) {
    if (any.size() == integers.size()) return;  // a difference found below
    Affine& other = *integers[any.size()];
    const long slope = other.constant - integer.constant;
    any.push_back({integer.constant - slope * links, slope});
    other = integer;
  });
  if (here != there)
    throw std::logic_error("statements differ between numbers of links in more than integers");
  auto next = any.begin();
  for_each_affine(here, [&](Affine& integer) { integer = *next++; });
  return here;
}

}  // namespace catena
