// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/batch_dynamics.hpp"

#include <stdexcept>
#include <string>

namespace catena {

BatchDynamics::BatchDynamics(const Model& model)
    : model_(model),
      q_(model.coordinates(), model.table().batch),
      v_(q_),
      z_(model.states(), model.table().batch),
      u_(3 * model.signals(), model.table().batch),
      p_(model.parameters(), model.table().batch),
      a_(q_) {}

void BatchDynamics::set_parameters(int k, const Eigen::VectorXd& p) {
  if (k < 0 || k >= kBatch)
    throw std::invalid_argument("set " + std::to_string(k) + ": there are sets 0 to 7");
  model_.check_parameters(p);
  for (int i = 0; i < model_.parameters(); ++i) p_.of(k, i) = p[i];
}

int BatchDynamics::evaluate(double t) {
  for (int first = 0; first < kBatch; first += model_.table().batch) {
    const catena_point at{t,
                          q_.group(first),
                          v_.group(first),
                          nullptr,
                          z_.group(first),
                          u_.group(first),
                          p_.group(first)};
    if (const int failed = model_.accelerations(at, a_.group(first)); failed != 0) return failed;
  }
  return 0;
}

}  // namespace catena
