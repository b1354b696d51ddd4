// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every input of tests/fuzz/corpora is read or refused, whole and cut off at many places, by any
// compiler. A fault that fuzzing found is kept there as an input.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/fuzz/readers.hpp"
#include "tests/support/data.hpp"

namespace {
constexpr std::size_t kCuts = 12;
}

TEST_CASE("every input of the corpora is read or refused") {
  for (const catena::tests::Reader& reader : catena::tests::readers()) {
    int inputs = 0;
    const auto corpus = catena::tests::source_folder() / "tests/fuzz/corpora" / reader.name;
    for (const auto& entry : std::filesystem::directory_iterator(corpus)) {
      ++inputs;
      INFO(entry.path().string());
      std::ifstream stream(entry.path(), std::ios::binary);
      const std::string text{std::istreambuf_iterator<char>(stream),
                             std::istreambuf_iterator<char>()};
      for (std::size_t cut = 1; cut <= kCuts; ++cut)
        CHECK_NOTHROW(reader.read(text.substr(0, text.size() * cut / kCuts)));
    }
    CAPTURE(reader.name);
    CHECK(inputs > 0);
  }
}
