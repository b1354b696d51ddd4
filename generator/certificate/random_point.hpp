// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <random>
#include <string>
#include <vector>

#include "generated/catena_model.h"
#include "generator/certificate/exact_evaluation.hpp"

namespace catena {

/// A point at which a model can be evaluated, and a direction has the same shape.
struct RandomPoint {
  double t = 0;
  std::vector<double> q, v, a, z, u, p;

  catena_point at() const {
    return {t, q.data(), v.data(), a.data(), z.data(), u.data(), p.data()};
  }
};

/// Of order one, within the parameter's bounds.
double random_parameter(const catena_parameter& parameter, std::mt19937_64& generator);

/// Angles up to 1.5 rad, rates up to 3/s, accelerations up to 5/s^2, extra states up to 0.2;
/// parameters of order one, within their bounds and different from one another. The same generator
/// state gives the same point on every machine.
RandomPoint random_point(const catena_model& table, std::mt19937_64& generator);

/// All entries between -1 and 1.
RandomPoint random_direction(const catena_model& table, std::mt19937_64& generator);

/// The inputs of the derivation at the point plus step times direction, exact.
ExactEvaluation::Inputs exact_inputs(const catena_model& table, const RandomPoint& point,
                                     const RandomPoint& direction, const GiNaC::numeric& step);
ExactEvaluation::Inputs exact_inputs(const catena_model& table, const RandomPoint& point);

}  // namespace catena
