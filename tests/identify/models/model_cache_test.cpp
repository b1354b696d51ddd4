// SPDX-License-Identifier: BSD-3-Clause
#include "identify/models/model_cache.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "identify/models/model_provider.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
namespace fs = std::filesystem;

namespace {

/// A cache with the plain chain of one link in it.
struct Filled {
  testing::TemporaryFolder folder;
  ProviderOptions options;
  int made = 0;

  Filled() {
    options.derive_program = tests::build_folder() / "bin" / "catena-derive";
    options.cache_directory = folder.path() / "cache";
    options.notice = [this](const std::string&) { ++made; };
    provide();
  }
  int provide() { return provide_model({}, 1, options).links(); }
  fs::path entry() const {
    for (const auto& each : fs::directory_iterator(options.cache_directory)) return each.path();
    return {};
  }
};

}  // namespace

TEST_CASE("a damaged entry is made again") {
  Filled filled;
  REQUIRE(filled.made == 1);
  const fs::path library = filled.entry() / "model.so";
  const auto whole = fs::file_size(library);
  struct Row {
    const char* damage;
    std::function<void()> act;
  };
  const Row rows[] = {
      {"truncated", [&] { fs::resize_file(library, whole / 2); }},
      {"empty", [&] { fs::resize_file(library, 0); }},
      {"zeroed", [&] { std::ofstream(library, std::ios::binary) << std::string(whole, '\0'); }},
      {"library missing", [&] { fs::remove(library); }},
      {"checksum missing", [&] { fs::remove(filled.entry() / "model.so.sha256"); }},
      {"empty folder",
       [&] {
         const fs::path entry = filled.entry();
         fs::remove_all(entry);
         fs::create_directory(entry);
       }},
      {"others may write the entry", [&] { fs::permissions(filled.entry(), fs::perms::all); }},
      {"others may write the library", [&] { fs::permissions(library, fs::perms::all); }},
      {"the group may write the checksum",
       [&] {
         fs::permissions(filled.entry() / "model.so.sha256", fs::perms::group_write,
                         fs::perm_options::add);
       }},
      {"the library is a link",
       [&] {
         const fs::path elsewhere = filled.folder.path() / "model.so";
         fs::rename(library, elsewhere);
         fs::create_symlink(elsewhere, library);
       }},
      {"the entry is a link",
       [&] {
         const fs::path entry = filled.entry(), elsewhere = filled.folder.path() / "entry";
         fs::rename(entry, elsewhere);
         fs::create_directory_symlink(elsewhere, entry);
       }},
      {"another user's library",  // where this runs as root; else it is made again as a missing one
       [&] {
         if (chown(library.c_str(), 65534, 65534) != 0) fs::remove(library);
       }},
  };
  int made = 1;
  for (const Row& row : rows) {
    CAPTURE(row.damage);
    row.act();
    CHECK(filled.provide() == 1);
    CHECK(filled.made == ++made);
    CHECK(filled.provide() == 1);  // and is whole again
    CHECK(filled.made == made);
  }
}

TEST_CASE("code is loaded only from a folder of this user alone") {
  Filled filled;
  const fs::path cache = filled.options.cache_directory;
  CHECK(why_not_trusted(cache).empty());
  struct Row {
    fs::path folder;
    mode_t mode;
    bool trusted;
  };
  const fs::path above = filled.folder.path();
  const Row rows[] = {
      {cache, 0700, true},  {cache, 0755, true},
      {cache, 0777, false}, {cache, 01777, false},  // in a sticky folder others may still add files
      {cache, 0700, true},  {above, 0777, false},
      {above, 01777, true}, {above, 0700, true},
  };
  for (const Row& row : rows) {
    CAPTURE(row.folder.string());
    CAPTURE(row.mode);
    REQUIRE(chmod(row.folder.c_str(), row.mode) == 0);
    CHECK(why_not_trusted(cache).empty() == row.trusted);
    if (row.trusted)
      CHECK(filled.provide() == 1);
    else
      CHECK_THROWS_AS(filled.provide(), ModelError);
  }
  CHECK(filled.made == 1);
}

TEST_CASE("what a lax umask would open is for this user alone") {
  const mode_t before = umask(0);
  Filled filled;
  const fs::path above = filled.folder.path() / "missing" / "cache";
  filled.options.cache_directory = above;
  filled.provide();
  umask(before);
  CHECK(filled.made == 2);
  filled.provide();
  CHECK(filled.made == 2);  // the entry was found
  for (const fs::path& path :
       {above.parent_path(), above, filled.entry(), filled.entry() / "model.so"})
    CHECK((fs::status(path).permissions() & (fs::perms::group_all | fs::perms::others_all)) ==
          fs::perms::none);
}

TEST_CASE("without HOME the cache is not in the temporary folder") {
  const char* const names[] = {"CATENA_CACHE", "XDG_CACHE_HOME", "HOME"};
  std::vector<std::pair<const char*, std::string>> before;
  for (const char* name : names)
    if (const char* value = std::getenv(name)) {
      before.emplace_back(name, value);
      unsetenv(name);
    }
  const fs::path folder = ModelCache::default_folder();
  CHECK(folder.filename() == "catena");
  CHECK(folder.string().find(fs::temp_directory_path().string()) == std::string::npos);
  setenv("XDG_CACHE_HOME", "/x", 1);
  CHECK(ModelCache::default_folder() == "/x/catena");
  setenv("XDG_CACHE_HOME", "relative", 1);
  CHECK(ModelCache::default_folder() == folder);
  unsetenv("XDG_CACHE_HOME");
  for (const auto& [name, value] : before) setenv(name, value.c_str(), 1);
}

TEST_CASE("what an interrupted process left is removed, what is in use is not") {
  Filled filled;
  const ModelCache cache(filled.options.cache_directory);
  const WorkFolder busy = cache.work_folder();
  const fs::path left = cache.folder() / "catena-work-000000";
  fs::create_directories(left / "model");
  fs::permissions(left, fs::perms::owner_all);
  // The user may have chosen a folder with others in it.
  const std::vector<fs::path> own = {cache.folder() / "work-report" / "thesis",
                                     cache.folder() / "catena-work-report" / "thesis",
                                     cache.folder() / "thesis" / "text"};
  for (const fs::path& file : own) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "mine";
  }
  const ModelCache again(cache.folder());
  CHECK(!fs::exists(left));
  CHECK(fs::exists(busy.path()));
  CHECK(again.usage().models == 1);
  CHECK(again.usage().bytes > 10'000);
  again.clear();
  CHECK(again.usage().models == 0);
  CHECK(fs::exists(busy.path()));
  for (const fs::path& file : own) CHECK(fs::exists(file));
}
