// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/certificate/random_point.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace catena {
namespace {

using GiNaC::numeric;

// Between low and high. std::uniform_real_distribution differs between libraries.
double uniform(std::mt19937_64& generator, double low, double high) {
  return low + (high - low) * (static_cast<double>(generator() >> 11) * 0x1p-53);
}

std::vector<double> uniform_list(int count, double size, std::mt19937_64& generator) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(uniform(generator, -size, size));
  return values;
}

// "length_3" of a table is "length[3]" of the derivation, "load_drag.coefficient" is
// "load_drag_coefficient". An effect's own names never end in a number.
std::string derivation_name(std::string_view name, std::string_view suffix) {
  std::string family(name), index;
  std::replace(family.begin(), family.end(), '.', '_');
  const auto underscore = family.rfind('_');
  if (underscore != std::string::npos && underscore + 1 < family.size() &&
      std::all_of(family.begin() + static_cast<long>(underscore) + 1, family.end(),
                  [](unsigned char c) { return std::isdigit(c); })) {
    index = "[" + family.substr(underscore + 1) + "]";
    family.resize(underscore);
  }
  return family + std::string(suffix) + index;
}

numeric exact(double value) {
  int exponent = 0;
  const double mantissa = std::frexp(value, &exponent);  // value = mantissa 2^exponent
  const numeric digits(static_cast<long>(std::ldexp(mantissa, 53)));
  return digits * GiNaC::pow(numeric(2), numeric(exponent - 53));
}

}  // namespace

double random_parameter(const catena_parameter& parameter, std::mt19937_64& generator) {
  const double value = uniform(generator, 0.2, 1.2);
  if (parameter.lower <= value && value <= parameter.upper) return value;
  return parameter.lower + (parameter.upper - parameter.lower) * (value - 0.1) / 1.2;
}

RandomPoint random_point(const catena_model& table, std::mt19937_64& generator) {
  RandomPoint point;
  point.t = uniform(generator, 0, 2);
  point.q = uniform_list(table.coordinates, 1.5, generator);
  const bool in_space = table.positions_across != nullptr;
  // Further coordinates (strains, parts of a quaternion less one) are small compared with 1.
  for (int i = (in_space ? 3 : 1) * table.links; i < table.coordinates; ++i)
    point.q[static_cast<std::size_t>(i)] /= 5;
  if (in_space) {
    // Links that hang more or less: where one folds back on another, bending has no derivative.
    for (int i = table.links; i < 2 * table.links; ++i) {
      double& down = point.q[static_cast<std::size_t>(i)];
      down = 1 + down / 5;
    }
  }
  point.v = uniform_list(table.coordinates, 3, generator);
  point.a = uniform_list(table.coordinates, 5, generator);
  // Integrals of the forces that hold an end or a joint are no motion: v . r has no power of theirs.
  if (table.gap != nullptr)
    std::fill(point.v.begin() + std::ptrdiff_t{3} * table.links, point.v.end(), 0.0);
  // Extra states (slips) stay within the range that motions reach. Outside of it Newton matrices,
  // which are factored without row exchanges, may have no pivots.
  point.z = uniform_list(table.states, 0.2, generator);
  point.u = uniform_list(3 * table.signals, 1, generator);
  for (int i = 0; i < table.parameters; ++i) {
    point.p.push_back(random_parameter(table.parameter[i], generator));
  }
  return point;
}

RandomPoint random_direction(const catena_model& table, std::mt19937_64& generator) {
  RandomPoint direction;
  direction.t = uniform(generator, -1, 1);
  direction.q = uniform_list(table.coordinates, 1, generator);
  direction.v = uniform_list(table.coordinates, 1, generator);
  direction.a = uniform_list(table.coordinates, 1, generator);
  direction.z = uniform_list(table.states, 1, generator);
  direction.u = uniform_list(3 * table.signals, 1, generator);
  direction.p = uniform_list(table.parameters, 1, generator);
  return direction;
}

ExactEvaluation::Inputs exact_inputs(const catena_model& table, const RandomPoint& point,
                                     const RandomPoint& direction, const numeric& step) {
  auto values = std::make_shared<std::map<std::string, numeric>>();
  const auto add = [&](const std::string& name, double value, double change) {
    (*values)[name] = exact(value) + step * exact(change);
  };
  const auto index = [](int i) { return static_cast<std::size_t>(i); };
  add("time", point.t, direction.t);
  for (int i = 0; i < table.coordinates; ++i) {
    const char* name = table.coordinate[i].name;
    add(derivation_name(name, ""), point.q[index(i)], direction.q[index(i)]);
    add(derivation_name(name, "_dot"), point.v[index(i)], direction.v[index(i)]);
    add(derivation_name(name, "_ddot"), point.a[index(i)], direction.a[index(i)]);
  }
  for (int i = 0; i < table.states; ++i) {
    add(derivation_name(table.state[i].name, ""), point.z[index(i)], direction.z[index(i)]);
  }
  for (int i = 0; i < table.signals; ++i) {
    const char* suffixes[] = {"", "_rate", "_acceleration"};
    for (int k = 0; k < 3; ++k) {
      const std::size_t at = index(3 * i + k);
      add(derivation_name(table.signal[i].name, "") + suffixes[k], point.u[at], direction.u[at]);
    }
  }
  for (int i = 0; i < table.parameters; ++i) {
    add(derivation_name(table.parameter[i].name, ""), point.p[index(i)], direction.p[index(i)]);
  }
  return [values](const std::string& name) -> GiNaC::ex {
    const auto found = values->find(name);
    if (found == values->end()) throw std::logic_error("exact_inputs: no value for " + name);
    return found->second;
  };
}

ExactEvaluation::Inputs exact_inputs(const catena_model& table, const RandomPoint& point) {
  RandomPoint still = point;
  still.t = 0;
  for (auto* list : {&still.q, &still.v, &still.a, &still.z, &still.u, &still.p}) {
    std::fill(list->begin(), list->end(), 0.0);
  }
  return exact_inputs(table, point, still, 0);
}

}  // namespace catena
