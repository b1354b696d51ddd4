// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace catena {

/// Six significant digits, for messages: "1.23", "4.5e-07".
std::string number_text(double value);

/// 17 significant digits, for files that are read again: reading gives the same double.
std::string exact_number_text(double value);

/// The shortest text that is read back to the same double.
std::string shortest_number(double value);

}  // namespace catena
