// SPDX-License-Identifier: BSD-3-Clause
#define EIGHT_SETS_TARGET eight_sets_baseline
#include "tests/benchmark/eight_sets.hpp"
