// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/fit/run_log.hpp"
#include "tests/fuzz/readers.hpp"

namespace catena::tests {

void read_a_run_log(const std::string& text) {
  const RunLog log(written("run.log", "catena run log 1 key\n" + text), "key", true);
  (void)log.finished(0);
}

}  // namespace catena::tests
