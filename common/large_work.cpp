// SPDX-License-Identifier: BSD-3-Clause
#include "common/large_work.hpp"

#include <array>
#include <cstdio>

#include "common/input_error.hpp"

namespace catena {
namespace {

struct Unit {
  double size;
  const char* name;
};

/// Two digits in the largest unit of which there is at least one: "20 min".
template <std::size_t count>
std::string in_units(double value, const std::array<Unit, count>& units) {
  std::size_t unit = 0;
  while (unit + 1 < count && value >= units[unit + 1].size) ++unit;
  const double number = value / units[unit].size;
  std::array<char, 64> text;
  std::snprintf(text.data(), text.size(), number < 9.95 ? "%.2g %s" : "%.0f %s", number,
                units[unit].name);
  return text.data();
}

std::string text_of(double seconds) {
  return in_units(seconds,
                  std::array<Unit, 4>{{{1, "s"}, {60, "min"}, {3600, "hours"}, {86400, "days"}}});
}

std::string memory_text(double bytes) {
  return in_units(bytes, std::array<Unit, 3>{{{1e6, "MB"}, {1e9, "GB"}, {1e12, "TB"}}});
}

}  // namespace

void require_yes(bool yes, const std::string& what, const WorkEstimate& estimate) {
  const bool long_one = estimate.seconds > kMostUnasked.seconds;
  const bool big_one = estimate.bytes > kMostUnasked.bytes;
  if (yes || !(long_one || big_one)) return;
  const std::string needs = !long_one ? memory_text(estimate.bytes)
                            : !big_one
                                ? text_of(estimate.seconds)
                                : memory_text(estimate.bytes) + " and " + text_of(estimate.seconds);
  throw InputError(what + " needs " + (estimate.or_more ? "more than " : "about ") + needs +
                   "; above " + memory_text(kMostUnasked.bytes) + " or " +
                   text_of(kMostUnasked.seconds) +
                   " give --yes to go on (large_work=True in Python)");
}

}  // namespace catena
