// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "generated/catena_model.h"
#include "generator/emission/emitted_files.hpp"

namespace catena {

/// One emitted model, compiled (-ffp-contract=off; C with -std=c99) and loaded. The destructor deletes
/// all files. The compiler does not optimise: no optimisation that users may ask for changes a result,
/// and it takes five times as long as all else.
class CompiledModel {
 public:
  /// `files`: those of emit_files. `name`: of the model, "chain_12". The compiler is $CXX or c++,
  /// for C $CC or cc. Throws std::runtime_error with the messages of the compiler if compiling
  /// fails.
  CompiledModel(const EmittedFiles& files, const std::string& name, Language language);
  ~CompiledModel();
  CompiledModel(const CompiledModel&) = delete;
  CompiledModel& operator=(const CompiledModel&) = delete;

  /// The table that the compiled library exports; it lives as long as this object.
  const catena_model& table() const { return *table_; }

 private:
  std::filesystem::path folder_;
  void* library_ = nullptr;
  const catena_model* table_ = nullptr;
};

}  // namespace catena
