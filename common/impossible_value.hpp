// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace catena {

/// A value that a fit may try but that describes no cable: a parameter outside the bounds of the
/// model, a held point farther away than the cable is long, a marker beyond the end of the cable.
/// A fit counts it as a failed simulation. Every other std::invalid_argument is a mistake of the
/// program (sizes that do not match, say) and is never caught on the way.
class ImpossibleValue : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

}  // namespace catena
