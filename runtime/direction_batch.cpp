// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/direction_batch.hpp"

#include <algorithm>
#include <utility>

namespace catena {

BatchTangents::BatchTangents(const Model& model) : model_(model) {
  const auto n = static_cast<std::size_t>(model.coordinates());
  const auto states = static_cast<std::size_t>(model.states());
  for (std::vector<double>* values : {&q_, &v_, &a_}) values->resize(n);
  z_.resize(states);
  p_.resize(static_cast<std::size_t>(model.parameters()));
  u_.resize(3 * static_cast<std::size_t>(model.signals()));
  change_.resize(std::max(n, states));
}

void BatchTangents::residual(const catena_point& at, const catena_point& along, double* dr) {
  if (model_.table().residual_tangents != nullptr) return model_.residual_tangents(at, along, dr);
  one_at_a_time(&Model::residual_tangent, at, along, model_.coordinates(), dr);
}

void BatchTangents::state_rate(const catena_point& at, const catena_point& along, double* dzdot) {
  if (model_.table().state_rate_tangents != nullptr)
    return model_.state_rate_tangents(at, along, dzdot);
  one_at_a_time(&Model::state_rate_tangent, at, along, model_.states(), dzdot);
}

void BatchTangents::one_at_a_time(Tangent tangent, const catena_point& at,
                                  const catena_point& along, int count, double* changes) {
  const catena_point one{0.0, q_.data(), v_.data(), a_.data(), z_.data(), u_.data(), p_.data()};
  for (int k = 0; k < CATENA_DIRECTIONS; ++k) {
    for (const auto& [batch, single] :
         {std::pair{along.q, &q_}, {along.v, &v_}, {along.a, &a_}, {along.z, &z_}, {along.p, &p_}})
      for (std::size_t i = 0; i < single->size(); ++i)
        (*single)[i] = batch[CATENA_DIRECTIONS * i + static_cast<std::size_t>(k)];
    (model_.*tangent)(at, one, change_.data());
    for (int i = 0; i < count; ++i)
      changes[CATENA_DIRECTIONS * i + k] = change_[static_cast<std::size_t>(i)];
  }
}

}  // namespace catena
