// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/diagnosis/candidate.hpp"
#include "identify/diagnosis/diagnosis.hpp"

namespace catena {

/// What an effect, by its estimates, says is wrong with the case, with an interval of 95 %: "the load
/// is 2.1 % (1.8 to 2.4) heavier than the case says". A sentence for each parameter that has words
/// for it (EffectParameter::above, below) and is certainly not neutral. `load`: kg, as the case says;
/// a correction of it is given in per cent.
std::vector<std::string> wrong_knowns(const Effect& effect,
                                      const std::vector<FinalParameter>& parameters, double load);

}  // namespace catena
