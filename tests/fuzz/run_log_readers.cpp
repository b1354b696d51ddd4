// SPDX-License-Identifier: GPL-3.0-or-later
#include <sstream>

#include "common/sha256.hpp"
#include "identify/fit/run_log.hpp"
#include "tests/fuzz/readers.hpp"

namespace catena::tests {
namespace {

/// The lines of the text with the checks that the log wants: without, none would be read.
void read_a_run_log(const std::string& text) {
  std::string whole = "catena run log 2 key\n", check;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    check = sha256_hex(check + line).substr(0, 16);
    whole += line + "\t" + check + "\n";
  }
  const RunLog log(written("run.log", whole), "key", 3, true);
  (void)log.finished(0);
}

constexpr Reader kRunLogReaders[] = {{"run_log", refused_or_read<read_a_run_log>}};

}  // namespace

std::span<const Reader> run_log_readers() { return kRunLogReaders; }

}  // namespace catena::tests
