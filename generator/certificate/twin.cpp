// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/certificate/twin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "common/as_index.hpp"
#include "generator/certificate/random_point.hpp"
#include "linear_algebra/decompositions.hpp"
#include "reference/coriolis.hpp"
#include "reference/gravity.hpp"
#include "reference/joint_matrix.hpp"
#include "reference/mass_matrix.hpp"
#include "reference/space.hpp"

namespace catena {
namespace {

using Real = long double;
using Vector = std::vector<Real>;

constexpr Real kUnitRoundoff = std::numeric_limits<double>::epsilon();

bool in_space(const catena_model& table) { return table.positions_across != nullptr; }

// The parameters of a chain in the order of p: families with one entry per link (torques, in the plane,
// too), load, gravity.
template <class T>
reference::Chain<T> reference_chain(const catena_model& table, const std::vector<double>& p) {
  const auto family = [&](int k) {
    const auto first = p.begin() + k * table.links;
    return std::vector<T>(first, first + table.links);
  };
  return {family(0),
          family(1),
          family(2),
          family(3),
          family(4),
          T(p[as_index((in_space(table) ? 5 : 6) * table.links)]),
          T(p[as_index((in_space(table) ? 5 : 6) * table.links + 1)])};
}

class Comparison {
 public:
  void add(const std::string& what, const Vector& values, const Vector& closed) {
    Real size = 0, worst = 0;
    for (const Real value : closed) size = std::max(size, std::abs(value));
    for (std::size_t i = 0; i < values.size(); ++i) {
      worst = std::isnan(values[i]) ? values[i] : std::max(worst, std::abs(values[i] - closed[i]));
    }
    const double units = worst == 0 ? 0 : static_cast<double>(worst / (kUnitRoundoff * size));
    for (FunctionAccuracy& known : result_) {
      if (known.function != what) continue;
      known.worst = std::isnan(units) ? units : std::max(known.worst, units);
      return;
    }
    result_.push_back({what, units});
  }

  const std::vector<FunctionAccuracy>& result() const { return result_; }

 private:
  std::vector<FunctionAccuracy> result_;
};

Vector product(const reference::Matrix<Real>& matrix, const Vector& x) {
  Vector y(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) y[i] += matrix[i][j] * x[j];
  }
  return y;
}

// ---- in space -------------------------------------------------------------------------------

using reference::space::Vector3;
using RealVectors = std::vector<Vector3<Real>>;

RealVectors vectors_of(const std::vector<double>& list) {
  const std::size_t n = list.size() / 3;
  RealVectors vectors(n);
  for (std::size_t i = 0; i < list.size(); ++i) vectors[i % n][i / n] = list[i];
  return vectors;
}

// The forces f on the unit vectors q / |q|, as forces on q: f / |q| without its part along q.
Vector projected(const RealVectors& force, const RealVectors& q) {
  using reference::space::dot;
  const std::size_t n = q.size();
  Vector list(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const Real square = dot(q[i], q[i]), part = dot(force[i], q[i]) / square;
    for (std::size_t c = 0; c < 3; ++c)
      list[c * n + i] = (force[i][c] - part * q[i][c]) / std::sqrt(square);
  }
  return list;
}

void compare_in_space(const catena_model& table, const RandomPoint& point, Comparison& comparison) {
  using reference::space::dot;
  const catena_point here = point.at();
  const auto chain = reference_chain<Real>(table, point.p);
  const RealVectors q = vectors_of(point.q), v = vectors_of(point.v), a = vectors_of(point.a);
  const std::size_t n = q.size();
  RealVectors unit(q), rate(q), acceleration(q);
  Vector radial(3 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const Real size = std::sqrt(dot(q[i], q[i])), size_rate = dot(q[i], v[i]) / size;
    const Real stretching = dot(q[i], a[i]) + dot(v[i], v[i]);
    const Real size_acceleration = (stretching - size_rate * size_rate) / size;
    const Real inertia =
        16 * chain.inertia[i] + 4 * chain.mass[i] * chain.length[i] * chain.length[i];
    for (std::size_t c = 0; c < 3; ++c) {
      unit[i][c] = q[i][c] / size;
      rate[i][c] = (v[i][c] - unit[i][c] * size_rate) / size;
      acceleration[i][c] =
          (a[i][c] - unit[i][c] * size_acceleration - 2 * rate[i][c] * size_rate) / size;
      radial[c * n + i] = inertia * stretching * q[i][c];
    }
  }
  Vector inertia = projected(reference::space::inertia(chain, acceleration), q);
  for (std::size_t i = 0; i < inertia.size(); ++i) inertia[i] += radial[i];
  const auto ratio = [](Real cosine) { return std::acos(cosine) / std::sqrt(1 - cosine * cosine); };
  const std::map<std::string_view, std::pair<const char*, Vector>> closed = {
      {"coriolis", {"M qddot + F", inertia}},
      {"gravity", {"G", projected(reference::space::gravity(chain), q)}},
      {"elastic", {"bending", projected(reference::space::elastic(chain, unit, ratio), q)}},
      {"friction", {"damping", projected(reference::space::friction(chain, unit, rate), q)}}};
  std::vector<double> term(as_index(table.coordinates)), moved(term);
  for (int i = 0; i < table.terms; ++i) {
    const std::string_view name = table.term[i].name;
    if (name == "inertia") table.residual_term(table.context, &here, i, moved.data());
    const auto found = closed.find(name);
    if (found == closed.end()) continue;
    table.residual_term(table.context, &here, i, term.data());
    Vector values(term.begin(), term.end());
    if (name == "coriolis")  // comes after inertia
      for (std::size_t k = 0; k < values.size(); ++k) values[k] += moved[k];
    comparison.add(found->second.first, values, found->second.second);
  }
}

std::vector<double> square_roots(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
  std::vector<double> roots;
  for (const double value : generalised_eigenvalues(stiffness, mass))
    roots.push_back(std::sqrt(value));
  return roots;
}

}  // namespace

std::vector<double> cable_parameters(const catena_model& table) {
  const double length = 3.39 / table.links, mass = 0.1424 * length;
  const std::map<std::string_view, double> families = {
      {"length", length},    {"mass", mass}, {"inertia", mass * length * length / 12},
      {"stiffness", 47.448}, {"damping", 0}, {"torque", 0}};
  std::vector<double> p;
  for (int i = 0; i < table.parameters; ++i) {
    const catena_parameter& parameter = table.parameter[i];
    const std::string_view name = parameter.name;
    const auto family = families.find(name.substr(0, name.rfind('_')));
    if (name == "load_mass") {
      p.push_back(1.47);
    } else if (name == "gravity") {
      p.push_back(9.81);
    } else if (family != families.end()) {
      p.push_back(family->second);
    } else {
      p.push_back(std::isnan(parameter.neutral) ? parameter.default_value : parameter.neutral);
    }
  }
  return p;
}

std::vector<FunctionAccuracy> compare_with_twin(const catena_model& table, int points,
                                                unsigned seed) {
  const int n = table.links;
  std::mt19937_64 generator(seed);
  Comparison comparison;
  for (int k = 0; k < points; ++k) {
    const RandomPoint point = random_point(table, generator);
    if (in_space(table)) {
      compare_in_space(table, point, comparison);
      continue;
    }
    const catena_point here = point.at();
    const auto chain = reference_chain<Real>(table, point.p);
    const Vector theta(point.q.begin(), point.q.end()), rate(point.v.begin(), point.v.end());
    std::vector<double> mass(as_index(n * n)), term(as_index(n));
    table.mass_matrix(table.context, &here, mass.data());
    Vector closed_mass;
    for (const Vector& row : reference::mass_matrix(chain, theta)) {
      closed_mass.insert(closed_mass.end(), row.begin(), row.end());
    }
    comparison.add("M", Vector(mass.begin(), mass.end()), closed_mass);
    const std::map<std::string_view, std::pair<const char*, Vector>> closed = {
        {"coriolis", {"F", reference::coriolis(chain, theta, rate)}},
        {"gravity", {"G", reference::gravity(chain, theta)}},
        {"elastic", {"K theta", product(reference::joint_matrix(chain.stiffness), theta)}},
        {"friction", {"C thetadot", product(reference::joint_matrix(chain.damping), rate)}}};
    for (int i = 0; i < table.terms; ++i) {
      const auto found = closed.find(table.term[i].name);
      if (found == closed.end()) continue;
      table.residual_term(table.context, &here, i, term.data());
      comparison.add(found->second.first, Vector(term.begin(), term.end()), found->second.second);
    }
  }
  return comparison.result();
}

Frequencies natural_frequencies(const catena_model& table) {
  Frequencies result;
  if (table.coordinates != (in_space(table) ? 3 : 1) * table.links) {
    result.why_not = "the model has coordinates other than the angles";
    return result;
  }
  RandomPoint rest;
  rest.p = cable_parameters(table);
  for (auto* list : {&rest.q, &rest.v, &rest.a}) list->assign(as_index(table.coordinates), 0.0);
  rest.z.assign(as_index(table.states), 0.0);
  rest.u.assign(as_index(3 * table.signals), 0.0);
  if (std::any_of(rest.p.begin(), rest.p.end(), [](double p) { return !std::isfinite(p); })) {
    result.why_not = "an effect of the model vanishes in a limit only";
    return result;
  }
  const int n = table.coordinates;
  if (in_space(table))
    for (int i = table.links; i < 2 * table.links; ++i) rest.q[as_index(i)] = 1;
  const catena_point here = rest.at();
  Eigen::MatrixXd mass(n, n), stiffness(n, n);  // symmetric: row by row is column by column
  table.mass_matrix(table.context, &here, mass.data());
  RandomPoint along = rest;
  std::fill(along.p.begin(), along.p.end(), 0.0);
  for (int j = 0; j < n; ++j) {
    along.q[as_index(j)] = 1;
    const catena_point direction = along.at();
    table.residual_tangent(table.context, &here, &direction, stiffness.col(j).data());
    along.q[as_index(j)] = 0;
  }
  const auto chain = reference_chain<double>(table, rest.p);
  const int links = table.links;
  const std::vector<double> hanging(as_index(links)), flat(as_index(links), std::acos(-1.0) / 2);
  const auto closed_mass = reference::mass_matrix(chain, hanging);
  auto closed_stiffness = reference::joint_matrix(chain.stiffness);
  const auto slope = reference::gravity(chain, flat);  // sin = 1: the derivative of G at rest
  Eigen::MatrixXd M(links, links), K(links, links);
  for (int i = 0; i < links; ++i) {
    closed_stiffness[as_index(i)][as_index(i)] += slope[as_index(i)];
    for (int j = 0; j < links; ++j) {
      M(i, j) = closed_mass[as_index(i)][as_index(j)];
      K(i, j) = closed_stiffness[as_index(i)][as_index(j)];
    }
  }
  result.applicable = true;
  result.closed = square_roots(K, M);
  result.emitted = square_roots(stiffness, mass);
  if (in_space(table)) {
    // Vectors along the links grow without a force; all else swings in two planes alike.
    result.emitted.erase(result.emitted.begin(), result.emitted.begin() + links);
    std::vector<double> twice;
    for (const double frequency : result.closed) twice.insert(twice.end(), 2, frequency);
    result.closed = twice;
  }
  for (std::size_t i = 0; i < result.closed.size(); ++i) {
    result.largest_difference =
        std::max(result.largest_difference, std::abs(result.emitted[i] / result.closed[i] - 1));
  }
  return result;
}

}  // namespace catena
