// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/work_folder.hpp"

namespace catena {

/// The folder of --output. A result is put together in a folder within it, so on the same disk, and
/// its files are moved to their places when all of them are there.
///
/// Only files that catena wrote are replaced: those that stand in manifest.sha256 with the hash they
/// have (`sha256sum --check manifest.sha256` reads it, too). Other files stay as they are.
class OutputFolder {
 public:
  /// To be made before work begins. `names`: what will be written, as patterns of fnmatch; a folder
  /// ends with "/" and is then for catena alone. Makes the folder, locks it, removes what killed
  /// runs left and moves a result that one had finished. Throws InputError where the folder cannot
  /// be made or written, is a file, is in use by another run, or holds something in the way.
  OutputFolder(const std::filesystem::path& folder, const std::vector<std::string>& names);

  /// Absolute, without a "/" at its end.
  const std::filesystem::path& path() const { return path_; }

  /// Calls `write` to write the result into the folder that it is given, then moves the files to
  /// path(). Throws std::runtime_error if that fails. Nothing that was finished is deleted: the
  /// message says where it is, in a temporary folder if this one has no room.
  void publish(const std::function<void(const std::filesystem::path&)>& write);

 private:
  /// Folders that were made. They are removed again if nothing was put into them.
  struct MadeFolders {
    std::vector<std::filesystem::path> paths;
    ~MadeFolders();
  };
  /// Hashes by path relative to the folder. While files are moved, one may have two.
  using Manifest = std::multimap<std::string, std::string>;

  static Manifest manifest_in(const std::filesystem::path& folder);
  void make();
  void recover();
  void check(const std::vector<std::string>& names) const;
  std::string why_in_the_way(const std::filesystem::path& file, const Manifest& manifest) const;
  void move_from(const std::filesystem::path& finished);

  std::filesystem::path path_;
  MadeFolders made_;
  std::optional<FolderLock> lock_;
  std::optional<WorkFolder> work_;
};

}  // namespace catena
