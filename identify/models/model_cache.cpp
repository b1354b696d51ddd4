// SPDX-License-Identifier: BSD-3-Clause
#include "identify/models/model_cache.hpp"

#include <fcntl.h>
#include <grp.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>
#include <vector>

#include "common/sha256.hpp"
#include "common/whole_file.hpp"
#include "identify/models/process.hpp"

namespace catena {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLibrary = "model.so";
constexpr const char* kChecksum = "model.so.sha256";
constexpr const char* kWork = "catena-work-";  // no user names a folder so: it is removed

/// Whether nobody else made or may write a file or folder. A link may lead to what others made.
bool is_ours(const fs::path& path, mode_t kind) {
  struct stat status = {};
  return lstat(path.c_str(), &status) == 0 && (status.st_mode & S_IFMT) == kind &&
         status.st_uid == geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

/// Whether an entry holds what this user wrote when it was made. Whoever could write the library could write the
/// checksum beside it, too.
bool is_whole(const fs::path& entry) {
  try {
    return is_ours(entry, S_IFDIR) && is_ours(entry / kChecksum, S_IFREG) &&
           is_ours(entry / kLibrary, S_IFREG) &&
           bytes_of_file(entry / kChecksum) == sha256_of_file(entry / kLibrary) + "\n";
  } catch (const fs::filesystem_error&) {
    return false;  // it will be made again
  }
}

/// Makes a folder, and those above it that are missing, for this user alone, whatever the umask. False with errno.
bool make_private(const fs::path& folder) {
  std::error_code error;
  if (folder.has_parent_path() && !fs::exists(folder.parent_path(), error) &&
      !make_private(folder.parent_path()))
    return false;
  return mkdir(folder.c_str(), 0700) == 0 || errno == EEXIST;
}

/// Puts a file or folder on the disk before it gets its name: a crash leaves no half entry.
void synchronise(const fs::path& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  fsync(file);
  close(file);
}

/// An entry is called by a hash. Whatever else a user keeps in the folder is left alone.
bool is_key(const std::string& name) {
  return name.size() == 64 && name.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::uintmax_t bytes_in(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  std::error_code error;
  for (const auto& file : fs::recursive_directory_iterator(folder, error))
    if (file.is_regular_file(error)) bytes += file.file_size(error);
  return bytes;
}

/// Whether a group holds this user alone, as Linux gives each user one of the same name.
bool is_private_group(gid_t id) {
  const passwd* account = getpwuid(geteuid());
  if (!account || account->pw_gid != id) return false;
  const std::string user = account->pw_name;
  const group* members = getgrgid(id);
  if (!members || members->gr_name != user) return false;
  for (char** member = members->gr_mem; *member; ++member)
    if (*member != user) return false;
  return true;
}

/// The entries, those used last at the end.
std::vector<fs::path> entries_of(const fs::path& cache) {
  std::vector<std::pair<fs::file_time_type, fs::path>> entries;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(cache, error))
    if (entry.is_directory(error) && is_key(entry.path().filename().string()))
      entries.emplace_back(fs::last_write_time(entry.path(), error), entry.path());
  std::sort(entries.begin(), entries.end());
  std::vector<fs::path> paths;
  for (auto& [time, path] : entries) paths.push_back(std::move(path));
  return paths;
}

}  // namespace

std::string why_not_trusted(const fs::path& folder) {
  std::error_code error;
  fs::path path = fs::canonical(folder, error);
  if (error) return folder.string() + ": " + error.message();
  for (bool above = false;; above = true, path = path.parent_path()) {
    struct stat status = {};
    if (stat(path.c_str(), &status) != 0) return path.string() + ": " + std::strerror(errno);
    const bool own = status.st_uid == geteuid() || (above && status.st_uid == 0);
    if (!own) return path.string() + " belongs to another user; choose a folder of your own";
    const bool sticky = above && (status.st_mode & S_ISVTX) != 0;
    const bool by_group = (status.st_mode & S_IWGRP) != 0 && !is_private_group(status.st_gid);
    if ((by_group || (status.st_mode & S_IWOTH) != 0) && !sticky)
      return path.string() + " may be written by other users; chmod go-w " + path.string();
    if (path == path.root_path()) return {};
  }
}

namespace {

void require_trusted(const fs::path& cache) {
  if (const std::string why = why_not_trusted(cache); !why.empty())
    throw ModelError(cache.string() + ": the cache of models is not used, since it holds code: " +
                     why + ", or set CATENA_CACHE to a folder of yours");
}

}  // namespace

fs::path ModelCache::default_folder() {
  if (const char* chosen = environment_variable("CATENA_CACHE")) return chosen;
  // The specification of this variable wants relative paths to be ignored.
  if (const char* base = environment_variable("XDG_CACHE_HOME");
      base && fs::path(base).is_absolute())
    return fs::path(base) / "catena";
  if (const char* home = environment_variable("HOME")) return fs::path(home) / ".cache" / "catena";
  const passwd* account = getpwuid(geteuid());
  if (!account || !account->pw_dir || !*account->pw_dir)
    throw ModelError(
        "no folder for compiled models: neither CATENA_CACHE, XDG_CACHE_HOME nor HOME is set; set "
        "CATENA_CACHE to a folder of yours");
  return fs::path(account->pw_dir) / ".cache" / "catena";
}

ModelCache::ModelCache(const fs::path& folder) : folder_(fs::absolute(folder)) {
  std::error_code error;
  if (!fs::exists(folder_, error)) return;
  require_trusted(folder_);
  remove_abandoned(folder_, kWork);
}

std::optional<Model> ModelCache::find(const std::string& key) const {
  const fs::path entry = folder_ / key;
  std::error_code error;
  if (!fs::exists(fs::symlink_status(entry, error))) return {};
  if (!is_whole(entry)) {
    fs::remove_all(entry, error);
    return {};
  }
  fs::last_write_time(entry, fs::file_time_type::clock::now(), error);  // see remove_oldest
  return Model::load(entry / kLibrary);
}

WorkFolder ModelCache::work_folder() const {
  if (!make_private(folder_))
    throw ModelError(folder_.string() + ": the cache of models cannot be made: " +
                     std::strerror(errno) + "; set CATENA_CACHE to a folder of yours");
  require_trusted(folder_);
  try {
    return WorkFolder(folder_, kWork);
  } catch (const fs::filesystem_error& failure) {
    throw ModelError(folder_.string() + ": the cache of models cannot be written: " +
                     failure.code().message() + "; set CATENA_CACHE to a folder of yours");
  }
}

Model ModelCache::keep(const std::string& key, const fs::path& made) const {
  const fs::path entry = folder_ / key;
  Model::load(made / kLibrary);  // what cannot be used never gets into the cache
  write_whole_file(made / kChecksum, sha256_of_file(made / kLibrary) + "\n");
  std::error_code error;
  fs::permissions(made, fs::perms::owner_all, error);
  for (const char* file : {kLibrary, kChecksum}) {
    fs::permissions(made / file, fs::perms::owner_read | fs::perms::owner_write, error);
    synchronise(made / file);
  }
  synchronise(made);
  if (fs::exists(fs::symlink_status(entry, error)) && !is_whole(entry))
    fs::remove_all(entry, error);
  fs::rename(made, entry, error);
  if (error && !is_whole(entry))
    throw ModelError(entry.string() + ": cannot be written: " + error.message());
  synchronise(folder_);
  const Model model = Model::load(entry / kLibrary);
  remove_oldest();
  return model;
}

ModelCache::Usage ModelCache::usage() const {
  Usage usage;
  for (const fs::path& entry : entries_of(folder_)) {
    ++usage.models;
    usage.bytes += bytes_in(entry);
  }
  return usage;
}

void ModelCache::clear() const {
  std::error_code error;
  for (const fs::path& entry : entries_of(folder_)) fs::remove_all(entry, error);
}

void ModelCache::remove_oldest() const {
  const std::vector<fs::path> entries = entries_of(folder_);
  std::uintmax_t bytes = usage().bytes;
  std::error_code error;
  for (std::size_t i = 0; i + 1 < entries.size() && bytes > kMostBytes; ++i) {
    const std::uintmax_t freed = bytes_in(entries[i]);
    fs::remove_all(entries[i], error);
    bytes -= std::min(bytes, freed);
  }
}

}  // namespace catena
