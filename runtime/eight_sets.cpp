// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/eight_sets.hpp"

#include <stdexcept>
#include <string>

namespace catena {

EightSets::EightSets(const Model& model)
    : model_(model),
      q_(model.coordinates(), model.table().sets),
      v_(q_),
      z_(model.states(), model.table().sets),
      u_(3 * model.signals(), model.table().sets),
      p_(model.parameters(), model.table().sets),
      a_(q_) {}

void EightSets::set_parameters(int k, const Eigen::VectorXd& p) {
  if (k < 0 || k >= kSets)
    throw std::invalid_argument("set " + std::to_string(k) + ": there are sets 0 to 7");
  model_.check_parameters(p);
  for (int i = 0; i < model_.parameters(); ++i) p_.of(k, i) = p[i];
}

int EightSets::evaluate(double t) {
  const catena_model& table = model_.table();
  for (int first = 0; first < kSets; first += table.sets) {
    const catena_point at{t,
                          q_.group(first),
                          v_.group(first),
                          nullptr,
                          z_.group(first),
                          u_.group(first),
                          p_.group(first)};
    if (const int failed = table.accelerations(&at, a_.group(first)); failed != 0) return failed;
  }
  return 0;
}

}  // namespace catena
