// SPDX-License-Identifier: GPL-3.0-or-later
//
// The harness of libFuzzer, a program for each group of readers. CATENA_FUZZ_READER names the reader; scripts/fuzz runs it.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/fuzz/readers.hpp"

namespace {

const catena::tests::Reader& chosen() {
  const char* name = std::getenv("CATENA_FUZZ_READER");
  for (const catena::tests::Reader& reader : catena::tests::CATENA_READERS())
    if (name != nullptr && std::string(name) == reader.name) return reader;
  std::fputs("CATENA_FUZZ_READER must be one of:", stderr);
  for (const catena::tests::Reader& reader : catena::tests::CATENA_READERS())
    std::fprintf(stderr, " %s", reader.name);
  std::fputs("\n", stderr);
  std::exit(2);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const catena::tests::Reader& reader = chosen();
  reader.read(std::string(data, data + size));
  return 0;
}
