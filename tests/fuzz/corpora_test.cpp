// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every input of tests/fuzz/corpora is read or refused, whole, cut off at many places and with words of
// 40 000 letters, by any compiler. A fault that fuzzing found is kept there as an input.
#include <doctest/doctest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "tests/fuzz/readers.hpp"
#include "tests/support/data.hpp"

namespace {

constexpr std::size_t kCuts = 12;
constexpr std::size_t kWords = 30;

bool in_a_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Where words begin and end, of names and numbers: all, or kWords of them evenly.
std::vector<std::pair<std::size_t, std::size_t>> words_of(const std::string& text) {
  std::vector<std::pair<std::size_t, std::size_t>> all, some;
  for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    for (end = at; end < text.size() && in_a_word(text[end]);) ++end;
    if (end > at) all.push_back({at, end});
  }
  if (all.size() <= kWords) return all;
  for (std::size_t k = 0; k < kWords; ++k) some.push_back(all[k * all.size() / kWords]);
  return some;
}

}  // namespace

TEST_CASE("every input of the corpora is read or refused") {
  using namespace catena::tests;
  for (const auto group : {description_readers(), recording_readers(), run_log_readers(),
                           result_readers(), derivation_readers()})
    for (const Reader& reader : group) {
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
        for (const auto& [begin, end] : words_of(text))
          CHECK_NOTHROW(
              reader.read(text.substr(0, begin) + std::string(40'000, 'a') + text.substr(end)));
      }
      CAPTURE(reader.name);
      CHECK(inputs > 0);
    }
}
