// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/output_folder.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/is_within.hpp"
#include "common/sha256.hpp"
#include "common/split.hpp"
#include "common/whole_file.hpp"

namespace catena {
namespace {

namespace fs = std::filesystem;

constexpr const char* kManifest = "manifest.sha256";
constexpr const char* kRoom = "room";  // a try: a run that is killed leaves no manifest by it
constexpr const char* kUnfinished =
    "catena-unfinished-";  // no user names a folder so: it is removed
/// The smallest results take as much: a disk that is full now is found before work begins.
constexpr std::size_t kFewestBytes = 64 << 10;

fs::path without_slash(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() || path == path.root_path() ? path : path.parent_path();
}

/// The files below a folder, relative to it, sorted.
std::vector<std::string> files_below(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (!fs::is_directory(entry.symlink_status()))
      files.push_back(entry.path().lexically_relative(folder).generic_string());
  std::sort(files.begin(), files.end());
  return files;
}

void move_file(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error == std::errc::cross_device_link) {  // a folder within may be another disk
    write_whole_file(to, bytes_of_file(from, SIZE_MAX));
    fs::remove(from);
  } else if (error) {
    throw fs::filesystem_error("cannot be moved", from, to, error);
  }
}

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  throw InputError("the output folder " + folder.string() + " cannot be used: " + why);
}

std::string text_of(const std::multimap<std::string, std::string>& manifest) {
  std::string text;
  for (const auto& [file, hash] : manifest) text += hash + "  " + file + "\n";
  return text;
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder, const std::vector<std::string>& names)
    : path_(without_slash(folder)) {
  make();
  lock_.emplace(path_);
  if (lock_->taken())
    refuse(path_, "another run of catena is writing into it; wait for it or choose another folder");
  try {
    recover();
    check(names);
    work_.emplace(path_, kUnfinished);
    write_whole_file(work_->path() / kRoom, std::string(kFewestBytes, ' '));
    fs::remove(work_->path() / kRoom);
  } catch (const std::exception& error) {
    refuse(path_, error.what());
  }
}

OutputFolder::MadeFolders::~MadeFolders() {
  std::error_code not_empty;
  for (; !paths.empty(); paths.pop_back()) fs::remove(paths.back(), not_empty);
}

void OutputFolder::make() {
  std::error_code error;
  std::vector<fs::path> missing;
  for (fs::path above = path_; !fs::exists(above, error); above = above.parent_path())
    missing.push_back(above);
  for (; !missing.empty(); missing.pop_back()) {
    const fs::path& folder = missing.back();
    if (fs::is_symlink(fs::symlink_status(folder, error)))
      refuse(path_,
             folder.string() + " is a link that leads nowhere; remove it, or give another folder");
    if (!fs::create_directory(folder, error) && error)
      refuse(path_, folder.string() + " cannot be made: " + error.message());
    made_.paths.push_back(folder);
  }
  if (!fs::is_directory(path_)) refuse(path_, "is a file; give a folder");
}

/// Finishes what a killed run was moving.
void OutputFolder::recover() {
  std::vector<fs::path> finished;
  for (const auto& entry : fs::directory_iterator(path_))
    if (entry.path().filename().string().starts_with(kUnfinished) && !entry.is_symlink() &&
        fs::exists(entry.path() / kManifest))
      finished.push_back(entry.path());
  for (const fs::path& folder : finished) {
    try {
      move_from(folder);
    } catch (const std::exception& error) {
      throw std::runtime_error(std::string(error.what()) + "\nthe result of an earlier run is in " +
                               folder.string());
    }
  }
}

OutputFolder::Manifest OutputFolder::manifest_in(const fs::path& folder) {
  Manifest manifest;
  if (!fs::exists(folder / kManifest)) return manifest;
  const std::string text = bytes_of_file(folder / kManifest);
  int number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    if (line.size() < 67 || line.compare(64, 2, "  ") != 0 ||
        line.find_first_not_of("0123456789abcdef") != 64)
      throw InputError((folder / kManifest).string() + ":" + std::to_string(number) +
                       ": is not the list of files that catena wrote; move the file away");
    const std::string file(line.substr(66));
    if (!is_within(file))
      throw InputError((folder / kManifest).string() + ":" + std::to_string(number) + ": " +
                       in_quotes(file) +
                       " is outside of the folder, and catena wrote no such list; move it away");
    manifest.emplace(file, line.substr(0, 64));
  }
  return manifest;
}

/// Why a file may not be replaced; empty if it may, or is not there.
std::string OutputFolder::why_in_the_way(const fs::path& file, const Manifest& manifest) const {
  const fs::path link = link_below(path_, file.lexically_relative(path_).parent_path());
  if (!link.empty())
    return link.string() +
           " is a link, through which no result is written; move it away or choose another folder";
  const fs::file_status status = fs::symlink_status(file);
  if (!fs::exists(status)) return {};
  const auto [begin, end] = manifest.equal_range(file.lexically_relative(path_).generic_string());
  const bool written = fs::is_regular_file(status) && begin != end;
  if (written) {
    const std::string hash = sha256_of_file(file);
    if (std::any_of(begin, end, [&](const auto& entry) { return entry.second == hash; })) return {};
  }
  return file.string() +
         (written ? " was changed since catena wrote it" : " was not written by catena") +
         " and would be replaced; move it away or choose another folder";
}

void OutputFolder::check(const std::vector<std::string>& names) const {
  const Manifest manifest = manifest_in(path_);
  for (const auto& entry : fs::directory_iterator(path_)) {
    const std::string name = entry.path().filename().string();
    for (std::string pattern : names) {
      const bool folder = pattern.ends_with('/');
      if (folder) pattern.pop_back();
      if (fnmatch(pattern.c_str(), name.c_str(), 0) != 0) continue;
      std::vector<fs::path> files = {entry.path()};
      if (folder && fs::is_directory(entry.symlink_status())) {
        files.clear();
        for (const std::string& file : files_below(entry.path()))
          files.push_back(entry.path() / file);
      }
      for (const fs::path& file : files)
        if (const std::string why = why_in_the_way(file, manifest); !why.empty())
          throw std::runtime_error(why);
    }
  }
}

void OutputFolder::publish(const std::function<void(const fs::path&)>& write) {
  const auto write_all = [&](const fs::path& folder) {
    write(folder);
    Manifest manifest;
    for (const std::string& file : files_below(folder))
      manifest.emplace(file, sha256_of_file(folder / file));
    write_whole_file(folder / kManifest, text_of(manifest));  // last: it says that all is there
  };
  try {
    write_all(work_->path());
  } catch (const std::exception& error) {
    const std::string why = error.what();
    std::string elsewhere = (temporary_folder() / "catena-result-XXXXXX").string();
    if (!mkdtemp(elsewhere.data())) throw std::runtime_error(why);
    try {
      write_all(elsewhere);
    } catch (const std::exception&) {
      throw std::runtime_error(why + "\nwhat could be written of the result is in " + elsewhere);
    }
    throw std::runtime_error(why + "\nthe result is in " + elsewhere + " instead");
  }
  try {
    move_from(work_->path());
  } catch (const std::exception& error) {
    const std::string where = work_->path().string();
    work_->keep();
    throw std::runtime_error(std::string(error.what()) + "\nthe result is in " + where);
  }
}

void OutputFolder::move_from(const fs::path& finished) {
  const Manifest before = manifest_in(path_), fresh = manifest_in(finished);
  Manifest either = before, after = fresh;
  either.insert(fresh.begin(), fresh.end());
  for (const auto& [file, hash] : fresh)
    if (const std::string why = why_in_the_way(path_ / file, either); !why.empty())
      throw std::runtime_error(why);
  write_whole_file(path_ / kManifest, text_of(either));
  std::vector<std::string> folders;  // written anew: nothing of an earlier run stays in them
  for (const auto& [file, hash] : fresh) {
    fs::create_directories((path_ / file).parent_path());
    if (fs::exists(finished / file)) move_file(finished / file, path_ / file);
    if (const fs::path first = *fs::path(file).begin(); first != file)
      folders.push_back(first.string());
  }
  for (const auto& [file, hash] : before) {
    if (fresh.contains(file)) continue;
    if (std::find(folders.begin(), folders.end(), fs::path(file).begin()->string()) ==
        folders.end())
      after.emplace(file, hash);
    else if (why_in_the_way(path_ / file, before).empty())
      fs::remove(path_ / file);
  }
  write_whole_file(path_ / kManifest, text_of(after));
  fs::remove(finished / kManifest);  // nothing of it is to be moved again
}

}  // namespace catena
