// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>
#include <vector>

#include "generated/catena_model.h"
#include "generator/certificate/exact_evaluation.hpp"

namespace catena {

/// A point at which a model can be evaluated, or a direction.
struct RandomPoint {
  double t = 0;
  std::vector<double> q, v, a, z, u, p;

  catena_point at() const {
    return {t, q.data(), v.data(), a.data(), z.data(), u.data(), p.data()};
  }
};

/// A value of order one, within the bounds of the parameter.
double random_parameter(const catena_parameter& parameter, std::mt19937_64& generator);

/// Angles up to 1.5 rad, rates up to 3 rad/s, accelerations up to 5 rad/s^2, extra states up to
/// 0.2. Parameters are of order one, within their bounds, and different from one another. The same
/// state of the generator gives the same point on every machine.
RandomPoint random_point(const catena_model& table, std::mt19937_64& generator);

/// All entries between -1 and 1.
RandomPoint random_direction(const catena_model& table, std::mt19937_64& generator);

/// The exact inputs of the derivation at point + step * direction.
ExactEvaluation::Inputs exact_inputs(const catena_model& table, const RandomPoint& point,
                                     const RandomPoint& direction, const GiNaC::numeric& step);
ExactEvaluation::Inputs exact_inputs(const catena_model& table, const RandomPoint& point);

}  // namespace catena
