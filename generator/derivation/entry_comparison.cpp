// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/entry_comparison.hpp"

#include <sstream>

#include "generator/derivation/written_out.hpp"

namespace catena {

EntryComparison::EntryComparison(const std::string& what) { proof_.what = what; }

void EntryComparison::entry(const std::string& place, const GiNaC::ex& difference) {
  ++proof_.entries;
  if (!proof_.equal) return;
  GiNaC::ex rest = difference.expand();
  if (!rest.is_zero()) rest = without_sine_squares(rest);
  if (rest.is_zero()) return;
  proof_.equal = false;
  std::ostringstream out;
  out << proof_.what << place << ": the model has " << rest << " more";
  proof_.difference = out.str();
}

}  // namespace catena
