// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/generator/precision/emitted_model.hpp"

#include <cmath>

#include "chain_12.hpp"
#include "chain_2.hpp"
#include "chain_3.hpp"
#include "chain_4.hpp"
#include "chain_60.hpp"
#include "every_effect_6.hpp"
#include "stretch_5.hpp"

namespace catena::tests {
namespace {

template <class T, class Function>
void add(Outputs<T>& outputs, const std::string& name, int size, const Function& function) {
  std::vector<T> values(static_cast<std::size_t>(size), T(0));
  function(values.data());
  outputs.emplace_back(name, std::move(values));
}

// The functions of an emitted namespace are templates, so a macro has to name them.
#define CATENA_EMITTED(model)                                                                      \
  template <class T>                                                                               \
  Outputs<T> values_##model(const Input<T>& input) {                                               \
    namespace m = model;                                                                           \
    const Point<T> at = input.point();                                                             \
    const int n = m::kLinks, size = m::kCoordinates;                                               \
    Outputs<T> out;                                                                                \
    add(out, "residual", size, [&](T* r) { m::residual(at, r); });                                 \
    for (int term = 0; term < m::table().terms; ++term)                                            \
      add(out, std::string("term ") + m::table().term[term].name, size,                            \
          [&](T* r) { m::residual_term(at, term, r); });                                           \
    add(out, "mass_matrix", size* size, [&](T* r) { m::mass_matrix(at, r); });                     \
    add(out, "bias", size, [&](T* r) { m::bias(at, r); });                                         \
    add(out, "energy", m::table().energies, [&](T* r) { m::energy(at, r); });                      \
    std::vector<T> other(static_cast<std::size_t>(n + 2));                                         \
    std::vector<T> third(static_cast<std::size_t>(n + 2));                                         \
    add(out, "positions", n + 2, [&](T* r) { m::positions(at, r, other.data()); });                \
    out.back().second.insert(out.back().second.end(), other.begin(), other.end());                 \
    add(out, "velocities", n + 2, [&](T* r) { m::velocities(at, r, other.data()); });              \
    out.back().second.insert(out.back().second.end(), other.begin(), other.end());                 \
    add(out, "moments", n, [&](T* r) { m::internal_forces(at, r, other.data(), third.data()); });  \
    out.emplace_back("tensions", std::vector<T>(other.begin(), other.begin() + n));                \
    out.emplace_back("curvatures", std::vector<T>(third.begin(), third.begin() + n));              \
    return out;                                                                                    \
  }                                                                                                \
  template <class T>                                                                               \
  Outputs<T> tangents_##model(const Input<T>& input, const Input<T>& direction) {                  \
    namespace m = model;                                                                           \
    const Point<T> at = input.point(), along = direction.point();                                  \
    const int n = m::kLinks;                                                                       \
    Outputs<T> out;                                                                                \
    add(out, "residual", m::kCoordinates, [&](T* r) { m::residual_tangent(at, along, r); });       \
    std::vector<T> other(static_cast<std::size_t>(n + 2));                                         \
    std::vector<T> third(static_cast<std::size_t>(n + 2));                                         \
    add(out, "positions", n + 2, [&](T* r) { m::positions_tangent(at, along, r, other.data()); }); \
    out.back().second.insert(out.back().second.end(), other.begin(), other.end());                 \
    add(out, "velocities", n + 2,                                                                  \
        [&](T* r) { m::velocities_tangent(at, along, r, other.data()); });                         \
    out.back().second.insert(out.back().second.end(), other.begin(), other.end());                 \
    add(out, "energy", m::table().energies, [&](T* r) { m::energy_tangent(at, along, r); });       \
    add(out, "moments", n, [&](T* r) {                                                             \
      m::internal_forces_tangent(at, along, r, other.data(), third.data());                        \
    });                                                                                            \
    out.emplace_back("tensions", std::vector<T>(other.begin(), other.begin() + n));                \
    out.emplace_back("curvatures", std::vector<T>(third.begin(), third.begin() + n));              \
    return out;                                                                                    \
  }

CATENA_EMITTED(chain_2)
CATENA_EMITTED(chain_3)
CATENA_EMITTED(chain_4)
CATENA_EMITTED(chain_12)
CATENA_EMITTED(chain_60)
CATENA_EMITTED(every_effect_6)
CATENA_EMITTED(stretch_5)

#define CATENA_STATES(model)                                                                    \
  template <class T>                                                                            \
  Outputs<T> values_with_states_##model(const Input<T>& input) {                                \
    Outputs<T> out = values_##model(input);                                                     \
    add(out, "state_rate", model::kStates, [&](T* r) { model::state_rate(input.point(), r); }); \
    return out;                                                                                 \
  }                                                                                             \
  template <class T>                                                                            \
  Outputs<T> tangents_with_states_##model(const Input<T>& input, const Input<T>& along) {       \
    Outputs<T> out = tangents_##model(input, along);                                            \
    add(out, "state_rate", model::kStates,                                                      \
        [&](T* r) { model::state_rate_tangent(input.point(), along.point(), r); });             \
    return out;                                                                                 \
  }

CATENA_STATES(every_effect_6)
CATENA_STATES(stretch_5)

template <class T>
Outputs<T> values_with_sensors(const Input<T>& input) {
  namespace m = every_effect_6;
  Outputs<T> out = values_with_states_every_effect_6(input);
  add(out, "observe", 3,
      [&](T* r) { m::observe(input.t, input.p.data(), input.marker.data(), r); });
  out.emplace_back("clock", std::vector<T>{m::clock(input.t, input.p.data())});
  return out;
}

template <class T>
Outputs<T> tangents_with_sensors(const Input<T>& input, const Input<T>& along) {
  namespace m = every_effect_6;
  Outputs<T> out = tangents_with_states_every_effect_6(input, along);
  add(out, "observe", 3, [&](T* r) {
    m::observe_tangent(input.t, input.p.data(), along.p.data(), input.marker.data(),
                       along.marker.data(), r);
  });
  out.emplace_back("clock",
                   std::vector<T>{m::clock_tangent(input.t, input.p.data(), along.p.data())});
  return out;
}

#define CATENA_MODEL(model, values, tangents) \
  { &model::table(), values<double>, values<FiftyDigits>, tangents<double>, tangents<FiftyDigits> }

}  // namespace

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
  static const std::vector<EmittedModel> models = {
      CATENA_MODEL(chain_2, values_chain_2, tangents_chain_2),
      CATENA_MODEL(chain_3, values_chain_3, tangents_chain_3),
      CATENA_MODEL(chain_4, values_chain_4, tangents_chain_4),
      CATENA_MODEL(chain_12, values_chain_12, tangents_chain_12),
      CATENA_MODEL(chain_60, values_chain_60, tangents_chain_60),
      CATENA_MODEL(every_effect_6, values_with_sensors, tangents_with_sensors),
      CATENA_MODEL(stretch_5, values_with_states_stretch_5, tangents_with_states_stretch_5)};
  return models;
}

}  // namespace catena::tests
