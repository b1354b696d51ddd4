// SPDX-License-Identifier: BSD-3-Clause
//
// Included once per processor the file is compiled for, with EIGHT_SETS_TARGET naming it: forward
// dynamics of eight parameter sets at once.
#include "generated/chain_12.hpp"
#include "generated/chain_2.hpp"
#include "generated/chain_4.hpp"
#include "generated/chain_60.hpp"
#include "runtime/lanes.hpp"

namespace catena::benchmark {

/// q, v, p and a hold eight values for each of the model's; returns nonzero if a pivot failed.
int EIGHT_SETS_TARGET(int links, const double* q, const double* v, const double* p, double* a) {
  using Eight = Lanes<struct EIGHT_SETS_TARGET>;
  const auto lanes = [](const double* values) { return reinterpret_cast<const Eight*>(values); };
  const Point<Eight> at{Eight(0), lanes(q), lanes(v), nullptr, nullptr, nullptr, lanes(p)};
  auto* const out = reinterpret_cast<Eight*>(a);
  switch (links) {
    case 2:
      return chain_2::acceleration(at, out);
    case 4:
      return chain_4::acceleration(at, out);
    case 12:
      return chain_12::acceleration(at, out);
    case 60:
      return chain_60::acceleration(at, out);
    default:
      return -1;
  }
}

}  // namespace catena::benchmark
