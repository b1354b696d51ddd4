// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "generated/catena_model.h"

namespace catena {

/// An emitted model: the table of functions in generated/catena_model.h with a safe way to get hold
/// of it. Cheap to copy; copies share a loaded library, which stays open as long as one of them
/// lives.
class Model {
 public:
  /// The plain chain of `links` links, linked into this program. Throws InputError naming the
  /// counts there are.
  static Model built_in(int links);
  static bool has_built_in(int links);
  /// The link counts for which built_in works, ascending.
  static std::vector<int> built_in_links();

  /// A model compiled as a shared library that exports catena_model_table. Throws InputError naming
  /// the file and what is wrong with it (missing, no such entry, another ABI, members missing).
  static Model load(const std::filesystem::path& shared_library);

  /// A table that outlives this object and its copies. Throws InputError if it is unusable.
  explicit Model(const catena_model* table);
  /// A table that lives as long as this object and its copies.
  explicit Model(std::shared_ptr<const catena_model> table);

  const catena_model& table() const { return *table_; }

  int links() const { return table_->links; }
  int coordinates() const { return table_->coordinates; }
  int states() const { return table_->states; }
  int parameters() const { return table_->parameters; }
  int signals() const { return table_->signals; }
  int energies() const { return table_->energies; }

  /// Place of a parameter in the vector p. Throws InputError naming the nearest known name.
  int parameter_index(std::string_view name) const;

  /// Defaults in the order of the parameter table; NaN where a case must give the value.
  Eigen::VectorXd default_parameters() const;

  /// Throws std::invalid_argument naming the parameter, its value and the rule it breaks: one value
  /// per parameter, finite, within the bounds of the parameter table.
  void check_parameters(const Eigen::VectorXd& parameters) const;

 private:
  Model(const catena_model* table, std::shared_ptr<const void> owner);

  const catena_model* table_;
  std::shared_ptr<const void> owner_;  // a loaded library, or the table itself
};

}  // namespace catena
