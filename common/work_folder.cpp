// SPDX-License-Identifier: BSD-3-Clause
#include "common/work_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"

namespace catena {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPattern = "XXXXXX";  // of mkdtemp

/// Whether mkdtemp may have made it: whatever else a user has under such a name stays.
bool is_work_folder(const fs::directory_entry& entry, const std::string& prefix) {
  const std::string name = entry.path().filename().string();
  std::error_code error;
  const fs::file_status status = entry.symlink_status(error);
  return name.starts_with(prefix) && name.size() == (prefix + kPattern).size() &&
         fs::is_directory(status) &&
         (status.permissions() & fs::perms::all) == fs::perms::owner_all;  // not the set-gid bit
}

fs::path make_folder(const fs::path& parent, const std::string& prefix) {
  std::string pattern = (parent / (prefix + kPattern)).string();
  if (!mkdtemp(pattern.data()))
    throw fs::filesystem_error("no folder can be made in it", parent,
                               std::error_code(errno, std::generic_category()));
  return pattern;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) {
  file_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (file_ < 0) return;
  held_ = flock(file_, LOCK_EX | LOCK_NB) == 0;
  taken_ = !held_ && errno == EWOULDBLOCK;
}

FolderLock::~FolderLock() {
  if (file_ >= 0) close(file_);
}

fs::path temporary_folder() {
  std::error_code error;
  fs::path folder = fs::temp_directory_path(error);
  if (!error) return folder;
  const char* chosen = std::getenv("TMPDIR");
  throw InputError(
      (chosen ? "TMPDIR = " + in_quotes(chosen) : std::string("the temporary folder")) + ": " +
      error.message() + "; set TMPDIR to a folder that can be written");
}

WorkFolder::WorkFolder(const fs::path& parent, const std::string& prefix) {
  remove_abandoned(parent, prefix);
  do {  // another process may take it for abandoned before it is locked
    path_ = make_folder(parent, prefix);
    lock_.emplace(path_);
  } while (lock_->taken() || !fs::exists(path_));
}

WorkFolder::~WorkFolder() {
  std::error_code ignored;
  if (!kept_) fs::remove_all(path_, ignored);
}

void remove_abandoned(const fs::path& parent, const std::string& prefix) {
  std::error_code error;
  for (const auto& left : fs::directory_iterator(parent, error)) {
    if (!is_work_folder(left, prefix)) continue;
    if (const FolderLock lock(left.path()); lock.held()) fs::remove_all(left.path(), error);
  }
}

}  // namespace catena
