// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "common/toml_reader.hpp"

namespace catena {

// Numbers of a case by their keys. Each throws InputError with file, line, key, value and rule.

/// Squares and products of several numbers beyond these limits overflow or vanish. A model has the same limits for
/// its parameters.
inline constexpr double kLeastPositive = 1e-50, kGreatestPositive = 1e50;

/// A number between `least` and `greatest`; `absent` where the key is not there.
double optional_positive(const TomlTable& table, std::string_view key, double absent,
                         double least = kLeastPositive, double greatest = kGreatestPositive);

/// A time in s within the limits of time_limits.hpp; `absent` where the key is not there.
double optional_duration(const TomlTable& table, std::string_view key, double absent);

/// A finite number, 0 or more; `absent` where the key is not there.
double not_negative(const TomlTable& table, std::string_view key, double absent);

/// A whole number from `least` to `most`; `absent` where the key is not there.
int count(const TomlTable& table, std::string_view key, long absent, long least,
          long most = 1'000'000'000);

}  // namespace catena
