// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>

#include "description/description.hpp"
#include "identify/models/model_cache.hpp"
#include "runtime/model.hpp"

namespace catena {

struct ProviderOptions {
  std::filesystem::path derive_program;  ///< empty: beside this program, in its libexec, or in PATH
  std::filesystem::path cache_directory;  ///< empty: ModelCache::default_folder()
  std::string compiler;                   ///< empty: $CXX, else c++
  /// Only what fits call (docs/model-table.md): compiled sooner. A plain chain is not compiled.
  bool for_fits = false;
  std::function<void(const std::string&)> notice;  ///< one line before something takes its time
  bool large_work =
      true;  ///< derive what takes more than kMostUnasked (common/large_work.hpp), too
  const std::atomic<bool>* stop = nullptr;  ///< once it is true, deriving and compiling end
};

/// The model of the file `description` (empty: the plain chain) with `links` links.
///
///     const Model plain = provide_model({}, 12);           // built in
///     const Model in_air = provide_model("air.toml", 24);  // derived and compiled, or from the cache
///
/// A plain chain that is built in needs no compiler. Other models are derived, compiled and kept in
/// a cache under the hash of their description; processes may share the cache. Without
/// catena-derive or a compiler, any_links_model gives the plain chain, after a notice. Throws
/// InputError for a description that cannot be used, ModelError if deriving, compiling or loading
/// fails.
Model provide_model(const std::filesystem::path& description, int links,
                    const ProviderOptions& options = {});

/// The equations of the model with `links` links, at most 3, as `catena-derive derive --equations`
/// prints them (JSON). Throws as provide_model.
std::string derived_equations(const std::filesystem::path& description, int links);

/// Writes the emitted code of a model into `folder`, which is made. Throws InputError and ModelError
/// as provide_model.
void derive_model(const Description& description, int links, const std::filesystem::path& folder);

/// The path of catena-derive: beside this program, in ../libexec/catena or in PATH. Throws
/// ModelError if there is none.
std::filesystem::path find_derive_program();

}  // namespace catena
