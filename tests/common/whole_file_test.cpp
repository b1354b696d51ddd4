// SPDX-License-Identifier: BSD-3-Clause
#include "common/whole_file.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include "common/sha256.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

TEST_CASE("what is not UTF-8 is refused with its line") {
  struct Row {
    const char* text;
    int line;  // 0: accepted
  };
  const Row rows[] = {
      {"", 0},
      {"plain\nm\xC3\xA4rker", 0},
      {"\xE2\x82\xAC \xF0\x9F\x98\x80", 0},  // three and four bytes
      {"one\ntwo\nm\xE4rker", 3},            // Latin-1
      {"\xC3", 1},                           // cut off
      {"a\n\xC0\xAF", 2},                    // longer than need be
      {"\xE0\x80\xAF", 1},
      {"\xED\xA0\x80", 1},      // a surrogate
      {"\xF4\x90\x80\x80", 1},  // beyond U+10FFFF
      {"\x80", 1},
      {"\xFF", 1},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const std::string said = failure([&] { require_utf8(row.text, "f.csv"); });
    CHECK(said.find(row.line == 0 ? "" : "f.csv:" + std::to_string(row.line) + ": ") == 0);
    CHECK(said.empty() == (row.line == 0));
  }
  CHECK(failure([] { require_utf8("\xFF\xFEt", "f"); }).find("iconv -f utf16 ") !=
        std::string::npos);
  CHECK(failure([] { require_utf8("\xE4", "f"); }).find("iconv -f latin1 ") != std::string::npos);
}

TEST_CASE("a file is read whole") {
  const testing::TemporaryFolder folder;
  CHECK(read_whole_file(folder.write("empty.txt", "")).empty());
  CHECK(read_whole_file(folder.write("marked.txt", "\xEF\xBB\xBFside\n")) == "side\n");
  CHECK(failure([&] { read_whole_file(folder.path() / "absent"); }).find("there is no such file") !=
        std::string::npos);
  CHECK(failure([&] { read_whole_file(folder.path()); }).find("is a folder") != std::string::npos);
  const auto latin = folder.write("latin.csv", "time_s,m\xE4rker\n");
  CHECK(failure([&] { read_whole_file(latin); }).find("latin.csv:1: ") != std::string::npos);
}

TEST_CASE("a file is not written through links that others made") {
  const testing::TemporaryFolder folder;
  const auto mine = folder.write("mine", "mine");
  const auto page = folder.path() / "page.html";
  std::filesystem::create_symlink(mine, page);
  // A folder may come with a link for each number that a process may have.
  std::filesystem::create_symlink(mine, page.string() + ".part" + std::to_string(getpid()));
  write_whole_file(page, "page");
  CHECK(read_whole_file(page) == "page");
  CHECK(read_whole_file(mine) == "mine");
}

TEST_CASE("an endless file is refused") {
  CHECK(failure([] {
          read_whole_file("/dev/zero");
        }).starts_with("/dev/zero: is larger than 500 MB"));
}

TEST_CASE("a result larger than an input may be has a checksum") {
  const testing::TemporaryFolder folder;
  const auto result = folder.write("positions.csv", "");
  std::filesystem::resize_file(result, kMostFileBytes + 1);
  CHECK(sha256_of_file(result).size() == 64);
}

TEST_CASE("a file that is read in parts has the hash of its text") {
  const testing::TemporaryFolder folder;
  std::string text;
  for (const std::size_t size : {0, 55, 56, 63, 64, 65, 65536, 200001}) {
    for (std::size_t k = text.size(); k < size; ++k) text += static_cast<char>('a' + k % 23);
    CHECK(sha256_of_file(folder.write("text", text)) == sha256_hex(text));
  }
}

TEST_CASE("within a run a file is read once, unless the run writes it") {
  const testing::TemporaryFolder folder;
  const auto file = folder.write("case.toml", "first");
  {
    const ReadOnce inputs;
    CHECK(read_whole_file(file) == "first");
    folder.write("case.toml", "edited");
    CHECK(read_whole_file(folder.path() / "." / "case.toml") == "first");
    std::filesystem::remove(file);
    CHECK(is_file(file));
    CHECK(read_whole_file(file) == "first");
    write_whole_file(file, "written");
    CHECK(read_whole_file(file) == "written");
  }
  folder.write("case.toml", "last");
  CHECK(read_whole_file(file) == "last");
}
