// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace catena {

/// Input of a user that cannot be used. The message names the file, the line or key, the value, the
/// rule it broke and what to do. Programs print it and exit with status 2; they have written
/// nothing.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace catena
