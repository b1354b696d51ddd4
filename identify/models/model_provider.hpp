// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>

#include "runtime/model.hpp"

namespace catena {

/// A model could not be derived or compiled. Programs print the message and exit with status 1.
class ModelError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ProviderOptions {
  std::filesystem::path derive_program;  ///< empty: beside this program, in its libexec, or in PATH
  std::filesystem::path
      cache_directory;   ///< empty: $CATENA_CACHE, $XDG_CACHE_HOME/catena, ~/.cache/catena
  std::string compiler;  ///< empty: $CXX, else c++
  std::function<void(const std::string&)> notice;  ///< one line before something takes its time
};

/// The model of a description (empty: the plain chain) with so many links. The plain chain with a
/// count that is linked in needs no compiler. Any other is derived, compiled and kept in a cache
/// under the hash of what decides it; concurrent processes may share the cache. Where catena-derive
/// or a compiler is not to be found, the plain chain is had from any_links_model, after a notice.
/// Throws InputError for a bad description, ModelError where deriving, compiling or loading fails.
Model provide_model(const std::filesystem::path& description, int links,
                    const ProviderOptions& options = {});

/// The equations that the derivation finds for the model with so many links, at most 3, as
/// `catena-derive derive --equations` prints them (JSON). Empty where catena-derive is not to be
/// had.
std::string derived_equations(const std::filesystem::path& description, int links);

/// catena-derive: beside this program, in ../libexec/catena, or in PATH. Throws ModelError.
std::filesystem::path find_derive_program();

}  // namespace catena
