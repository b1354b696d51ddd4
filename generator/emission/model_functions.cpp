// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/model_functions.hpp"

#include "generator/emission/function_builder.hpp"

namespace catena {

std::vector<std::string> ModelFunctions::table_entries(Language language) const {
  const bool states = summary.states > 0, in_c = language == Language::kC;
  const auto maybe = [](bool there, const char* name) {
    return std::string(there ? name : "nullptr");
  };
  return {"c_residual",
          "c_residual_tangent",
          maybe(!in_c, "c_residual_tangents"),
          "c_residual_adjoint",
          "c_residual_term",
          maybe(states, "c_state_rate"),
          maybe(states, "c_state_rate_tangent"),
          maybe(!in_c && states, "c_state_rate_tangents"),
          "c_mass_matrix",
          "c_bias",
          "c_acceleration",
          has_batch() ? "c_accelerations" : "c_acceleration",
          maybe(summary.structured, "c_newton_factor"),
          maybe(summary.structured, "c_newton_solve"),
          maybe(summary.structured, "c_newton_solves"),
          maybe(summary.structured, "c_newton_solve_transposed"),
          "c_energy",
          "c_positions",
          "c_positions_tangent",
          "c_velocities",
          "c_internal_forces",
          maybe(observes, "c_observe"),
          maybe(observes, "c_observe_tangent"),
          maybe(observes, "c_clock"),
          maybe(observes, "c_clock_tangent")};
}

int ModelFunctions::most_links_of_batch() const {
  return accelerations.empty() ? 0 : summary.mass_structured ? 1000 : 100;
}

ModelFunctions model_functions(const Description& description, int links, Layout layout,
                               Language language) {
  return FunctionBuilder(description, links, layout, language).build();
}

}  // namespace catena
