// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "common/work_folder.hpp"
#include "runtime/model.hpp"

namespace catena {

/// A model could not be derived, compiled or kept. Programs print the message and exit with
/// status 1.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Why code in a folder cannot be trusted: the folder, or one above it, belongs to or may be
/// written by another user (a sticky folder such as /tmp may stand above). Names the folder and
/// says what to do. Empty if the folder can be trusted. The folder must exist.
std::string why_not_trusted(const std::filesystem::path& folder);

/// A folder of compiled models. A program loads them as code, so the folder must be this user's
/// alone. Several processes may use one cache at the same time.
///
/// An entry is a folder under the hash of what decides the model. It holds the sources, the library
/// model.so and model.so.sha256. A library that does not match its checksum is removed and made
/// again.
class ModelCache {
 public:
  /// The folder for this user: $CATENA_CACHE, else $XDG_CACHE_HOME/catena, else .cache/catena in
  /// the home folder ($HOME, else that of the user's account).
  static std::filesystem::path default_folder();

  /// Opens the cache, which may not be there yet. Removes what interrupted processes left. Throws
  /// ModelError if the folder is not to be trusted.
  explicit ModelCache(const std::filesystem::path& folder);

  /// Where it is.
  const std::filesystem::path& folder() const { return folder_; }

  /// The model of an entry. Nothing if there is none, or only a damaged one (which is removed).
  std::optional<Model> find(const std::string& key) const;

  /// A new folder in the cache to make an entry in. Makes the cache's folder if there is none (mode
  /// 0700). Throws ModelError if that fails.
  WorkFolder work_folder() const;

  /// Makes an entry of `made` (a folder in work_folder() with model.so) and loads it. Where another
  /// process was quicker, its entry stays. Throws ModelError if it cannot be written, InputError if
  /// the library cannot be used. Removes the entries not used for longest while all of them take
  /// more than kMostBytes.
  Model keep(const std::string& key, const std::filesystem::path& made) const;

  /// How many models there are and how many bytes they take.
  struct Usage {
    int models = 0;
    std::uintmax_t bytes = 0;
  };
  Usage usage() const;
  /// Removes all models. Those in use by a running program stay loaded there.
  void clear() const;

  /// A model takes 0.1 to 1 MB: this is room for a thousand.
  static constexpr std::uintmax_t kMostBytes = 512ULL << 20;

 private:
  void remove_oldest() const;

  std::filesystem::path folder_;
};

}  // namespace catena
