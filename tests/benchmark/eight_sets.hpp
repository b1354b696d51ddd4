// SPDX-License-Identifier: BSD-3-Clause
//
// Included once per processor the file is compiled for, with EIGHT_SETS_TARGET naming it: forward
// dynamics of eight parameter sets at once.
#include "generated/chain_12.hpp"
#include "generated/chain_2.hpp"
#include "generated/chain_3.hpp"
#include "generated/chain_4.hpp"
#include "generated/chain_60.hpp"
#include "runtime/lanes.hpp"

namespace catena::benchmark {

using Four = Lanes<struct EIGHT_SETS_TARGET, 4>;

static inline int four_sets(int links, const Point<Four>& at, Four* out) {
  switch (links) {
    case 2:
      return chain_2::acceleration(at, out);
    case 3:
      return chain_3::acceleration(at, out);
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

/// q, v, p and a are of two fours of sets, one after the other, with four values for each of the
/// model's; returns nonzero if a pivot failed.
int EIGHT_SETS_TARGET(int links, int parameters, const double* q, const double* v, const double* p,
                      double* a) {
  const auto lanes = [](const double* values) { return reinterpret_cast<const Four*>(values); };
  int failed = 0;
  for (int half = 0; half < 2; ++half) {
    const int shift = half * links;
    const Point<Four> at{Four(0), lanes(q) + shift, lanes(v) + shift, nullptr, nullptr, nullptr,
                         lanes(p) + half * parameters};
    failed += four_sets(links, at, reinterpret_cast<Four*>(a) + shift);
  }
  return failed;
}

}  // namespace catena::benchmark
