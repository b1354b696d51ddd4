// SPDX-License-Identifier: BSD-3-Clause
#include "identify/cases/case_numbers.hpp"

#include <cmath>
#include <string>

#include "common/number_text.hpp"
#include "identify/cases/time_limits.hpp"

namespace catena {

double optional_positive(const TomlTable& table, std::string_view key, double absent, double least,
                         double greatest) {
  const double value = table.optional_number(key).value_or(absent);
  if (table.has(key) && !(value >= least && value <= greatest))
    table.fail(key, shortest_number(value) +
                        (value > 0 ? "; must lie between " : "; must be positive, between ") +
                        shortest_number(least) + " and " + shortest_number(greatest));
  return value;
}

double optional_duration(const TomlTable& table, std::string_view key, double absent) {
  return optional_positive(table, key, absent, kShortestTime, kLongestTime);
}

double not_negative(const TomlTable& table, std::string_view key, double absent) {
  const double value = table.optional_number(key).value_or(absent);
  if (!(value >= 0) || !std::isfinite(value))
    table.fail(key, shortest_number(value) + "; must not be negative, and finite");
  return value;
}

int count(const TomlTable& table, std::string_view key, long absent, long least, long most) {
  const long value = table.optional_integer(key).value_or(absent);
  if (value < least || value > most)
    table.fail(key, std::to_string(value) + "; must be a whole number from " +
                        std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(value);
}

}  // namespace catena
