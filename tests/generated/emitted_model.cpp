// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/generated/emitted_model.hpp"

#include <cmath>

namespace catena::tests {

Input<double> zeros(const catena_model& model) {
  const auto none = [](int count) {
    return std::vector<double>(static_cast<std::size_t>(count), 0.0);
  };
  const int n = model.coordinates;
  return {0,
          none(n),
          none(n),
          none(n),
          none(model.states),
          none(3 * model.signals),
          none(model.parameters),
          none(3)};
}

Input<double> random_input(const catena_model& model, std::mt19937_64& random) {
  const auto uniform = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random() >> 11) * 0x1p-53;
  };
  Input<double> input = zeros(model);
  input.t = uniform(0, 3);
  for (double& value : input.q) value = uniform(-2, 2);
  for (double& value : input.v) value = uniform(-3, 3);
  for (double& value : input.a) value = uniform(-10, 10);
  for (double& value : input.z) value = uniform(-0.5, 0.5);
  for (double& value : input.u) value = uniform(-1, 1);
  for (double& value : input.marker) value = uniform(-1, 1);
  // Coordinates beyond the angles are stretches, of the size of a small strain.
  for (auto i = static_cast<std::size_t>(model.links); i < input.q.size(); ++i) input.q[i] *= 0.01;
  for (std::size_t i = 0; i < input.p.size(); ++i) {
    const catena_parameter& parameter = model.parameter[i];
    const double least = std::isfinite(parameter.lower) ? std::max(parameter.lower, -2.0) : -2;
    const double most = std::isfinite(parameter.upper) ? std::min(parameter.upper, 2.0) : 2;
    // Off the lower bound, where a mass or a stiffness would vanish.
    input.p[i] = least + (most - least) * uniform(0.2, 0.9);
    if (std::string(parameter.name) == "gravity") input.p[i] = 9.81;
  }
  return input;
}

const std::vector<EmittedModel>& emitted_models() {
  static const std::vector<EmittedModel> models = [] {
    std::vector<EmittedModel> all = emitted_chains();
    for (const EmittedModel& model : emitted_effects()) all.push_back(model);
    return all;
  }();
  return models;
}

}  // namespace catena::tests
