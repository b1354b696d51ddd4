// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace catena {

/// A lock of a folder, which must exist, until the object or the process ends. It does not wait.
class FolderLock {
 public:
  /// Takes the lock if it is free; held() says whether it was.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  bool held() const { return held_; }
  /// Another object or process has it. Both are false where folders cannot be locked.
  bool taken() const { return taken_; }

 private:
  int file_ = -1;
  bool held_ = false, taken_ = false;
};

/// The folder for temporary files, of the environment variable TMPDIR or the system's. Throws InputError where there
/// is none.
std::filesystem::path temporary_folder();

/// A new folder for unfinished work, removed with the object. It is locked meanwhile: what killed
/// processes left is told from it.
class WorkFolder {
 public:
  /// Makes `parent`/`prefix`XXXXXX, mode 0700, after remove_abandoned. Throws
  /// std::filesystem::filesystem_error.
  WorkFolder(const std::filesystem::path& parent, const std::string& prefix);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  /// The new folder.
  const std::filesystem::path& path() const { return path_; }
  /// It stays when the object goes.
  void keep() { kept_ = true; }

 private:
  std::filesystem::path path_;
  bool kept_ = false;
  std::optional<FolderLock> lock_;
};

/// Removes the work folders in `parent` whose processes have ended. A work folder has this prefix, a name of the
/// length that WorkFolder gives, and the permissions 0700.
void remove_abandoned(const std::filesystem::path& parent, const std::string& prefix);

}  // namespace catena
