// SPDX-License-Identifier: BSD-3-Clause
#include "common/large_work.hpp"

#include <doctest/doctest.h>

#include "common/input_error.hpp"

using catena::require_yes;

TEST_CASE("work above the limits is begun where it was asked for only") {
  CHECK_NOTHROW(require_yes(false, "it", {600, 4e9}));
  CHECK_NOTHROW(require_yes(true, "it", {1e9, 1e15}));
  CHECK_THROWS_WITH_AS(
      require_yes(false, "the fit", {1200, 40e9}),
      "the fit needs about 40 GB and 20 min; above 4 GB or 10 min give --yes to go on "
      "(large_work=True in Python)",
      catena::InputError);
  CHECK_THROWS_WITH_AS(require_yes(false, "the fit", {3.5 * 86400, 40e9 / 20}),
                       "the fit needs about 3.5 days; above 4 GB or 10 min give --yes to go on "
                       "(large_work=True in Python)",
                       catena::InputError);
  CHECK_THROWS_WITH_AS(require_yes(false, "it", {10, 2.5e12}),
                       "it needs about 2.5 TB; above 4 GB or 10 min give --yes to go on "
                       "(large_work=True in Python)",
                       catena::InputError);
}
