// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/model_functions.hpp"

#include <algorithm>

#include "generator/emission/function_builder.hpp"

namespace catena {

bool has_differentials(const Function& function) {
  return std::any_of(
      function.parameters.begin(), function.parameters.end(),
      [](const Parameter& parameter) { return parameter.type == Type::kDifferential; });
}

int ModelFunctions::most_links_of_batch() const {
  if (mass.block > 1) return 300;  // arrays of blocks where the plane has numbers
  return mass.kind == MatrixForm::kDense ? 100 : 1000;
}

std::vector<TableEntry> ModelFunctions::table_entries() const {
  const bool states = summary.states > 0, structured = summary.structured;
  const bool all = set == FunctionSet::kAll, in_space = space == Space::kThreeDimensional;
  return {{"residual", true},
          {"residual_tangent", true},
          {"residual_tangents", true},
          {"residual_adjoint", all},
          {"residual_term", all},
          {"state_rate", states},
          {"state_rate_tangent", states},
          {"state_rate_tangents", states},
          {"mass_matrix", all},
          {"bias", all},
          {"acceleration", true},
          {"accelerations", true},
          {"newton_factor", structured},
          {"newton_solve", structured},
          {"newton_solves", structured},
          {"newton_solve_transposed", all && structured},
          {"energy", all},
          {"positions", true},
          {"positions_tangent", true},
          {"velocities", true},
          {"internal_forces", all},
          {"observe", observes},
          {"observe_tangent", observes},
          {"clock", observes},
          {"clock_tangent", observes},
          {"positions_across", in_space},
          {"positions_across_tangent", in_space},
          {"velocities_across", in_space},
          {"reactions", all},
          {"gap", summary.constraints > 0},
          {"event_values", summary.events > 0}};
}

ModelFunctions model_functions(const Description& description, int links, Layout layout,
                               FunctionSet set) {
  return FunctionBuilder(description, links, layout, set).build();
}

}  // namespace catena
