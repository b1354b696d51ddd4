// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "common/input_error.hpp"

namespace catena {

/// The message of the InputError that `action` throws; empty if it throws none.
template <class Action>
std::string failure(Action action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace catena
