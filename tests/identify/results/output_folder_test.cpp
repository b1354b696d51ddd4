// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/output_folder.hpp"

#include <doctest/doctest.h>

#include <fstream>

#include "common/whole_file.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace catena;
using testing::text_of;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kNames = {"result.json", "model/", "round_*/"};

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << text;
}

/// Publishes result.json and a file in model/.
void publish(const fs::path& folder, const std::string& text, const std::string& name = "a.cpp") {
  OutputFolder output(folder, kNames);
  output.publish([&](const fs::path& unfinished) {
    write(unfinished / "result.json", text);
    write(unfinished / "model" / name, text);
  });
}

/// What a second run is refused with.
std::string refusal(const fs::path& folder) {
  return failure([&] { OutputFolder(folder, kNames); });
}

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("a result replaces an earlier one and nothing else") {
  const testing::TemporaryFolder folder;
  const fs::path out = folder.path() / "a" / "out";
  publish(out / "", "first");
  write(out / "notes.txt", "mine");
  write(out / "unfinished-thesis" / "notes.txt", "mine");
  publish(out, "second", "b.cpp");
  CHECK(text_of(out / "result.json") == "second");
  CHECK(text_of(out / "notes.txt") == "mine");
  CHECK(text_of(out / "unfinished-thesis" / "notes.txt") == "mine");
  CHECK(!fs::exists(out / "model" / "a.cpp"));  // of the earlier model
  CHECK(text_of(out / "model" / "b.cpp") == "second");
  CHECK(entries(out) == 5);  // manifest.sha256, too, and nothing unfinished
  const std::string manifest = text_of(out / "manifest.sha256");
  CHECK(manifest.find("  model/b.cpp\n") == 64);
  CHECK(manifest.size() == 64 + 2 + 12 + 64 + 2 + 12);  // and result.json, each once
}

TEST_CASE("what catena did not write is refused before work begins, and stays") {
  for (const char* name : {"result.json", "model", "model/own.cpp", "round_3/notes.txt"}) {
    CAPTURE(name);
    const testing::TemporaryFolder folder;
    publish(folder.path() / "out", "first");
    fs::remove_all(folder.path() / "out" / name);
    write(folder.path() / "out" / name, "mine");
    const std::string said = refusal(folder.path() / "out");
    CHECK_MESSAGE(said.find(name) != std::string::npos, said);
    CHECK(text_of(folder.path() / "out" / name) == "mine");
  }
  const testing::TemporaryFolder folder;
  publish(folder.path(), "first");
  write(folder.path() / "result.json", "edited");
  CHECK(refusal(folder.path()).find("was changed since catena wrote it") != std::string::npos);
  write(folder.path() / "manifest.sha256", "mine");
  CHECK(refusal(folder.path()).find("is not the list of files") != std::string::npos);
}

TEST_CASE("a folder that cannot be used is found before work begins") {
  const testing::TemporaryFolder folder;
  const fs::path file = folder.write("file", "mine");
  CHECK(refusal(file).find("is a file") != std::string::npos);
  CHECK(refusal(file / "below").find("cannot be made") != std::string::npos);
  {
    const OutputFolder used(folder.path() / "out", kNames);
    CHECK(refusal(folder.path() / "out").find("another run") != std::string::npos);
  }
  CHECK(!fs::exists(folder.path() / "out"));  // nothing was put into it
  CHECK(text_of(file) == "mine");
}

TEST_CASE("a finished result that cannot be moved is kept, and moved by the next run") {
  const testing::TemporaryFolder folder;
  std::string said;
  {
    OutputFolder output(folder.path(), kNames);
    write(folder.path() / "model" / "a.cpp", "mine");  // meanwhile
    try {
      output.publish([&](const fs::path& unfinished) {
        write(unfinished / "result.json", "found");
        write(unfinished / "model" / "a.cpp", "found");
      });
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
  }
  const auto at = said.find("the result is in ");
  REQUIRE_MESSAGE(at != std::string::npos, said);
  CHECK(text_of(fs::path(said.substr(at + 17)) / "result.json") == "found");
  CHECK(text_of(folder.path() / "model" / "a.cpp") == "mine");
  CHECK(refusal(folder.path()).find("the result of an earlier run is in") != std::string::npos);
  fs::remove(folder.path() / "model" / "a.cpp");
  CHECK(refusal(folder.path()).empty());
  CHECK(text_of(folder.path() / "result.json") == "found");
  CHECK(entries(folder.path()) == 3);
}

TEST_CASE("a folder that others made puts nothing outside of it") {
  const testing::TemporaryFolder folder;
  const fs::path out = folder.path() / "out", elsewhere = folder.path() / "elsewhere";
  const std::string hash(64, '0');
  // As a run leaves it that was killed while it moved its files.
  const auto unfinished = [&](const std::string& name, const fs::path& into) {
    fs::remove_all(out);
    write(into / "manifest.sha256", hash + "  " + name + "\n");
    write(into / fs::path(name).filename(), "evil");
    fs::create_directories(out);
    fs::create_directories(elsewhere);
  };
  for (const std::string& name : {std::string("../elsewhere/a"), (elsewhere / "a").string(),
                                  std::string("model/../../elsewhere/a")}) {
    CAPTURE(name);
    unfinished(name, out / "catena-unfinished-x");
    write(out / "catena-unfinished-x/model/a", "evil");
    CHECK(refusal(out).find("is outside of the folder") != std::string::npos);
    CHECK(fs::is_empty(elsewhere));
  }
  unfinished("model/a", out / "catena-unfinished-x");
  write(out / "catena-unfinished-x/model/a", "evil");
  fs::create_directory_symlink(elsewhere, out / "model");
  CHECK(refusal(out).find("is a link, through which no result is written") != std::string::npos);
  CHECK(fs::is_empty(elsewhere));

  unfinished("mine", folder.path() / "another");  // a result of the user's
  fs::create_directory_symlink(folder.path() / "another", out / "catena-unfinished-x");
  CHECK(refusal(out).empty());
  CHECK(text_of(folder.path() / "another" / "mine") == "evil");
}

TEST_CASE("a result that cannot be written into the folder is written elsewhere") {
  const testing::TemporaryFolder folder;
  std::string said;
  OutputFolder output(folder.path() / "out", kNames);
  fs::remove_all(folder.path() / "out");  // meanwhile
  try {
    output.publish(
        [&](const fs::path& unfinished) { write_whole_file(unfinished / "result.json", "found"); });
  } catch (const std::runtime_error& error) {
    said = error.what();
  }
  const auto at = said.find("the result is in "), end = said.find(" instead");
  REQUIRE_MESSAGE(end != std::string::npos, said);
  const fs::path where = said.substr(at + 17, end - at - 17);
  CHECK(text_of(where / "result.json") == "found");
  fs::remove_all(where);
}
