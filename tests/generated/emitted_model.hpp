// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "generated/catena_model.h"
#include "generated/scalar.hpp"
#include "tests/generated/fifty_digits.hpp"

namespace catena::tests {

/// Where a model is evaluated, or a direction there.
template <class T>
struct Input {
  T t{};
  std::vector<T> q, v, a, z, u, p;
  std::vector<T> marker;  ///< side, down, angle: what a sensor sees

  [[nodiscard]] Point<T> point() const {
    return {t, q.data(), v.data(), a.data(), z.data(), u.data(), p.data()};
  }
};

template <class To, class From>
Input<To> converted(const Input<From>& from) {
  const auto all = [](const std::vector<From>& values) {
    std::vector<To> result;
    for (const From& value : values) result.push_back(To(value));
    return result;
  };
  return {To(from.t),  all(from.q), all(from.v), all(from.a),
          all(from.z), all(from.u), all(from.p), all(from.marker)};
}

/// Zeros of the model's sizes.
Input<double> zeros(const catena_model& model);

/// A state and parameters within their bounds, of ordinary size.
Input<double> random_input(const catena_model& model, std::mt19937_64& random);

/// What the functions of a model give, by name.
template <class T>
using Outputs = std::vector<std::pair<std::string, std::vector<T>>>;

/// An emitted model with its functions run in doubles and in fifty digits.
struct EmittedModel {
  const catena_model* table;
  std::function<Outputs<double>(const Input<double>&)> values;
  std::function<Outputs<FiftyDigits>(const Input<FiftyDigits>&)> exact_values;
  /// Directional derivatives, for those outputs that have them, under the same names.
  std::function<Outputs<double>(const Input<double>& at, const Input<double>& along)> tangents;
  std::function<Outputs<FiftyDigits>(const Input<FiftyDigits>&, const Input<FiftyDigits>&)>
      exact_tangents;
};

/// chain_2 .. chain_60; every_effect and stretch; all of them.
std::vector<EmittedModel> emitted_chains();
std::vector<EmittedModel> emitted_effects();
const std::vector<EmittedModel>& emitted_models();

}  // namespace catena::tests
