// SPDX-License-Identifier: BSD-3-Clause
#define EIGHT_SETS_TARGET eight_sets_avx2
#include "tests/benchmark/eight_sets.hpp"
