// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/chain_measures.hpp"

#include "identify/problem/parameter_map.hpp"

namespace catena {

using Eigen::VectorXd;

ChainMeasures::ChainMeasures(const Problem& problem, const VectorXd& x, int experiment) {
  const Model& model = problem.model();
  const VectorXd p = problem.model_parameters(x, experiment);
  lengths = link_lengths(model, p);
  in_space = model.in_space();
  length = lengths.sum();
  masses = p.segment(model.parameter_index("mass_1"), model.links());
  load = p[model.parameter_index("load_mass")];
  gravity = p[model.parameter_index("gravity")];
}

}  // namespace catena
