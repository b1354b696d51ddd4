// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/model.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/impossible_value.hpp"
#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "common/number_text.hpp"
#include "generated/models.hpp"

namespace catena {
namespace {

// Products of six parameters are finite.
constexpr double kGreatestParameter = 1e50;

std::span<const catena_model* const> built_in_tables() {
  int count = 0;
  const catena_model* const* tables = built_in_models(&count);
  return {tables, static_cast<std::size_t>(count)};
}

const catena_model* find_built_in(int links) {
  for (const catena_model* table : built_in_tables())
    if (table->links == links) return table;
  return nullptr;
}

/// What makes a table unusable; empty if nothing does.
std::string fault_of(const catena_model* table) {
  if (table == nullptr) return "it has no model table";
  if (table->abi != CATENA_MODEL_ABI)
    return "it was compiled for interface version " + std::to_string(table->abi) +
           ", this program needs version " + std::to_string(CATENA_MODEL_ABI) +
           "; derive and compile it again";
  if (table->size < sizeof(catena_model))
    return "its table has " + std::to_string(table->size) + " bytes, this program needs " +
           std::to_string(sizeof(catena_model)) + "; derive and compile it again";
  if (table->links < 1 || table->coordinates < table->links || table->states < 0 ||
      table->signals < 0 || table->parameters < 0 || table->terms < 0 || table->energies < 0 ||
      table->events < 0)
    return "its counts of links, coordinates, states, signals, parameters, terms, energies or "
           "events are impossible";
  // A table for fits has no terms, no energies and not what only results need.
  const bool for_fits = table->terms == 0 && table->energies == 0;
  const bool complete =
      table->residual && table->residual_tangent && table->acceleration && table->accelerations &&
      table->positions && table->positions_tangent && table->velocities &&
      (for_fits || (table->residual_term && table->mass_matrix && table->bias && table->energy &&
                    table->internal_forces)) &&
      (table->positions_across == nullptr ||
       (table->positions_across_tangent && table->velocities_across)) &&
      (table->states == 0 || (table->state_rate && table->state_rate_tangent)) &&
      (table->structured == 0 || (table->newton_factor && table->newton_solve)) &&
      (table->observes == 0 ||
       (table->observe && table->observe_tangent && table->clock && table->clock_tangent)) &&
      (table->events == 0 || (table->event && table->event_values));
  if (!complete) return "functions are missing from its table";
  if (table->batch < 1 || 8 % table->batch != 0)
    return "it evaluates batches of " + std::to_string(table->batch) + " points, not 1, 2, 4 or 8";
  return {};
}

// The three coordinates of each constraint are hold_side, ... or hold_6_side, ...
std::vector<int> held_links_of(const catena_model& table) {
  std::vector<int> links;
  if (table.gap == nullptr) return links;
  const std::string_view before = "hold_", after = "side";
  for (int i = 3 * table.links; i < table.coordinates; ++i) {
    std::string_view name = table.coordinate[i].name;
    if (!name.starts_with(before) || !name.ends_with(after)) continue;
    name.remove_prefix(before.size());
    name.remove_suffix(after.size());
    links.push_back(name.empty() ? table.links : std::stoi(std::string(name)));
  }
  return links;
}

}  // namespace

Model::Model(const catena_model* table) : Model(table, nullptr) {}

Model::Model(std::shared_ptr<const catena_model> table) : Model(table.get(), table) {}

Model::Model(const catena_model* table, std::shared_ptr<const void> owner)
    : table_(table), owner_(std::move(owner)) {
  if (const std::string fault = fault_of(table); !fault.empty())
    throw InputError("the model cannot be used: " + fault);
  held_links_ = held_links_of(*table);
}

Model Model::built_in(int links) {
  if (const catena_model* table = find_built_in(links)) return Model(table);
  std::string known;
  for (const int count : built_in_links())
    known += (known.empty() ? "" : ", ") + std::to_string(count);
  throw InputError("no model of " + std::to_string(links) + " links is built in; built in are: " +
                   (known.empty() ? "none" : known) + "; others are derived with catena derive");
}

bool Model::has_built_in(int links) { return find_built_in(links) != nullptr; }

std::vector<int> Model::built_in_links() {
  std::vector<int> counts;
  for (const catena_model* table : built_in_tables()) counts.push_back(table->links);
  std::sort(counts.begin(), counts.end());
  return counts;
}

Model Model::load(const std::filesystem::path& shared_library) {
  const std::string file = shared_library.string();
  if (!std::filesystem::exists(shared_library))
    throw InputError(file + ": no such file; a compiled model was expected");
  // An absolute path, so that dlopen does not search the library path for a bare name.
  const std::string absolute = std::filesystem::absolute(shared_library).string();
  void* handle = dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) throw InputError(file + ": cannot be loaded: " + dlerror());
  std::shared_ptr<void> library(handle, [](void* opened) { dlclose(opened); });
  const auto entry = reinterpret_cast<catena_model_entry>(dlsym(handle, CATENA_MODEL_ENTRY));
  if (entry == nullptr)
    throw InputError(file + ": is no catena model: it does not export " CATENA_MODEL_ENTRY);
  const catena_model* table = entry();
  if (const std::string fault = fault_of(table); !fault.empty())
    throw InputError(file + ": cannot be used: " + fault);
  return Model(table, std::move(library));
}

int Model::parameter_index(std::string_view name) const {
  std::vector<std::string> names;
  for (int i = 0; i < parameters(); ++i) {
    if (name == table_->parameter[i].name) return i;
    names.emplace_back(table_->parameter[i].name);
  }
  throw InputError("the model has no parameter " + in_quotes(name) + suggestion(name, names));
}

Eigen::VectorXd Model::default_parameters() const {
  Eigen::VectorXd values(parameters());
  for (int i = 0; i < parameters(); ++i) values[i] = table_->parameter[i].default_value;
  return values;
}

void Model::check_parameters(const Eigen::VectorXd& values) const {
  if (values.size() != parameters())
    throw std::invalid_argument("parameters: " + std::to_string(values.size()) +
                                " values given, the model has " + std::to_string(parameters()));
  for (int i = 0; i < parameters(); ++i) {
    const catena_parameter& parameter = table_->parameter[i];
    const std::string name = std::string("parameter ") + parameter.name;
    if (std::isnan(values[i])) throw ImpossibleValue(name + " has no value");
    if (!std::isfinite(values[i]))
      throw ImpossibleValue(name + " = " + number_text(values[i]) + " must be finite");
    if (std::abs(values[i]) > kGreatestParameter)
      throw ImpossibleValue(name + " = " + number_text(values[i]) + " " + parameter.unit +
                            " is more than " + number_text(kGreatestParameter) +
                            ", beyond which products of parameters overflow; give a smaller one");
    if (values[i] < parameter.lower)
      throw ImpossibleValue(name + " = " + number_text(values[i]) + " " + parameter.unit +
                            " is below its lower bound " + number_text(parameter.lower));
    if (values[i] > parameter.upper)
      throw ImpossibleValue(name + " = " + number_text(values[i]) + " " + parameter.unit +
                            " is above its upper bound " + number_text(parameter.upper));
  }
}

}  // namespace catena
