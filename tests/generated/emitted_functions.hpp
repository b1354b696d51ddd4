// SPDX-License-Identifier: GPL-3.0-or-later
//
// The functions of an emitted namespace gathered by name. They are templates, so a macro has to
// name them.
#pragma once

#include <string>
#include <vector>

#include "tests/generated/emitted_model.hpp"

namespace catena::tests {

template <class T, class Function>
void add(Outputs<T>& outputs, const std::string& name, int size, const Function& function) {
  std::vector<T> values(static_cast<std::size_t>(size), T(0));
  function(values.data());
  outputs.emplace_back(name, std::move(values));
}

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
    add(out, "positions", n + 2, [&](T* r) { m::positions_tangent(at, along, r, other.data()); }); \
    out.back().second.insert(out.back().second.end(), other.begin(), other.end());                 \
    return out;                                                                                    \
  }

#define CATENA_MODEL(model, values, tangents) \
  { &model::table(), values<double>, values<FiftyDigits>, tangents<double>, tangents<FiftyDigits> }

}  // namespace catena::tests
