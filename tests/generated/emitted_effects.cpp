// SPDX-License-Identifier: GPL-3.0-or-later
#include "every_effect_6.hpp"
#include "stretch_5.hpp"
#include "tests/generated/emitted_functions.hpp"

namespace catena::tests {
namespace {

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

}  // namespace

std::vector<EmittedModel> emitted_effects() {
  return {CATENA_MODEL(every_effect_6, values_with_sensors, tangents_with_sensors),
          CATENA_MODEL(stretch_5, values_with_states_stretch_5, tangents_with_states_stretch_5)};
}

}  // namespace catena::tests
