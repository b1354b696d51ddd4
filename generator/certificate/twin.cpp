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

namespace catena {
namespace {

using Real = long double;
using Vector = std::vector<Real>;

constexpr Real kUnitRoundoff = std::numeric_limits<double>::epsilon();

// The parameters of a chain in the order of p: families with one entry per link, load, gravity.
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
          T(p[as_index(6 * table.links)]),
          T(p[as_index(6 * table.links + 1)])};
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
  if (table.coordinates != table.links) {
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
  const int n = table.links;
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
  const std::vector<double> hanging(as_index(n)), flat(as_index(n), std::acos(-1.0) / 2);
  const auto closed_mass = reference::mass_matrix(chain, hanging);
  auto closed_stiffness = reference::joint_matrix(chain.stiffness);
  const auto slope = reference::gravity(chain, flat);  // sin = 1: the derivative of G at rest
  Eigen::MatrixXd M(n, n), K(n, n);
  for (int i = 0; i < n; ++i) {
    closed_stiffness[as_index(i)][as_index(i)] += slope[as_index(i)];
    for (int j = 0; j < n; ++j) {
      M(i, j) = closed_mass[as_index(i)][as_index(j)];
      K(i, j) = closed_stiffness[as_index(i)][as_index(j)];
    }
  }
  result.applicable = true;
  result.emitted = square_roots(stiffness, mass);
  result.closed = square_roots(K, M);
  for (std::size_t i = 0; i < result.closed.size(); ++i) {
    result.largest_difference =
        std::max(result.largest_difference, std::abs(result.emitted[i] / result.closed[i] - 1));
  }
  return result;
}

}  // namespace catena
