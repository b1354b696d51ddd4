// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

#include "generated/catena_model.h"
#include "generator/emission/emitted_files.hpp"

namespace catena {

/// One emitted model, compiled as users compile it (-O2 -ffp-contract=off; C as -std=c99) and
/// loaded. Everything it wrote is gone when it is.
class CompiledModel {
 public:
  /// `files` as emit_files gives them, `name` the model's ("chain_12"). The compiler is $CXX or
  /// c++, of C $CC or cc. Throws std::runtime_error with what the compiler said if it cannot be
  /// compiled.
  CompiledModel(const EmittedFiles& files, const std::string& name, Language language);
  ~CompiledModel();
  CompiledModel(const CompiledModel&) = delete;
  CompiledModel& operator=(const CompiledModel&) = delete;

  const catena_model& table() const { return *table_; }

 private:
  std::filesystem::path folder_;
  void* library_ = nullptr;
  const catena_model* table_ = nullptr;
};

}  // namespace catena
