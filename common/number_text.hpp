// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace catena {

/// For messages: six significant digits, "1.23", "4.5e-07".
std::string number_text(double value);

/// For files that are read again: 17 significant digits, which give back the same double.
std::string exact_number_text(double value);

/// A number as short as it can be written and still read back to the same double.
std::string shortest_number(double value);

}  // namespace catena
