// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "generated/catena_model.h"
#include "reference/chain_constants.hpp"
#include "reference/coriolis.hpp"
#include "reference/gravity.hpp"
#include "reference/joint_matrix.hpp"
#include "reference/mass_matrix.hpp"
#include "tests/runtime/dual_number.hpp"

/// A model table of the plain chain, built from the closed forms of reference and nothing
/// emitted: the twin of the emitted tables, and a stand-in where none is at hand. Dense, slow,
/// exact; tangents by dual numbers.
namespace catena::testing {

namespace reference_model_detail {

/// The chain's parameters, in the order of the table.
template <class T>
struct Case {
  reference::Chain<T> chain;
  reference::Vector<T> torque;
};

/// read(i) gives parameter i of the table as a T.
template <class T, class Read>
Case<T> read_case(std::size_t n, Read read) {
  const auto vector = [&](std::size_t block) {
    reference::Vector<T> result;
    for (std::size_t i = 0; i < n; ++i) result.push_back(read(block * n + i));
    return result;
  };
  return {{vector(0), vector(1), vector(2), vector(3), vector(4), read(6 * n), read(6 * n + 1)},
          vector(5)};
}

template <class T>
reference::Vector<T> product(const reference::Matrix<T>& matrix, const reference::Vector<T>& x) {
  reference::Vector<T> result(x.size(), T(0));
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t j = 0; j < x.size(); ++j) result[i] = result[i] + matrix[i][j] * x[j];
  return result;
}

/// One state, with scalars that may carry derivatives.
template <class T>
struct Point {
  reference::Vector<T> q, v, a;
  Case<T> parameters;
};

template <int n>
Point<double> plain(const catena_point* at, bool read_v = true, bool read_a = true) {
  const auto vector = [](const double* x, bool read) {
    return read ? reference::Vector<double>(x, x + n) : reference::Vector<double>(n, 0.0);
  };
  return {vector(at->q, true), vector(at->v, read_v), vector(at->a, read_a),
          read_case<double>(n, [&](std::size_t i) { return at->p[i]; })};
}

template <int n>
Point<Dual> along_direction(const catena_point* at, const catena_point* along) {
  const auto vector = [](const double* x, const double* dx) {
    reference::Vector<Dual> result;
    for (int i = 0; i < n; ++i) result.emplace_back(x[i], dx[i]);
    return result;
  };
  return {vector(at->q, along->q), vector(at->v, along->v), vector(at->a, along->a),
          read_case<Dual>(n, [&](std::size_t i) { return Dual(at->p[i], along->p[i]); })};
}

/// The terms of r in the order of the table, (3.4).
template <class T>
std::array<reference::Vector<T>, 6> terms(const Point<T>& at) {
  const auto& chain = at.parameters.chain;
  reference::Vector<T> torque;
  for (const T& value : at.parameters.torque) torque.push_back(-value);
  return {product(reference::mass_matrix(chain, at.q), at.a),
          reference::coriolis(chain, at.q, at.v),
          reference::gravity(chain, at.q),
          product(reference::joint_matrix(chain.stiffness), at.q),
          product(reference::joint_matrix(chain.damping), at.v),
          torque};
}

template <class T>
reference::Vector<T> residual(const Point<T>& at) {
  reference::Vector<T> sum(at.q.size(), T(0));
  for (const auto& term : terms(at))
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = sum[i] + term[i];
  return sum;
}

/// side, down of the support, the joints and the load, (2.25).
template <class T>
std::array<reference::Vector<T>, 2> positions(const Point<T>& at) {
  using std::cos;
  using std::sin;
  std::array<reference::Vector<T>, 2> result{{{T(0)}, {T(0)}}};
  for (std::size_t i = 0; i < at.q.size(); ++i) {
    const T& length = at.parameters.chain.length[i];
    result[0].push_back(result[0].back() + length * sin(at.q[i]));
    result[1].push_back(result[1].back() + length * cos(at.q[i]));
  }
  for (auto& component : result) component.push_back(component.back());
  return result;
}

/// Gaussian elimination without pivoting; returns the 1-based index of the first pivot that is not
/// usable, 0 if all are. `lower_upper` is overwritten with the factors.
inline int factor(std::vector<double>& lower_upper, std::size_t n, bool positive) {
  for (std::size_t k = 0; k < n; ++k) {
    const double pivot = lower_upper[k * n + k];
    if (!(positive ? pivot > 0.0 : std::abs(pivot) > 0.0)) return static_cast<int>(k + 1);
    for (std::size_t i = k + 1; i < n; ++i) {
      const double ratio = lower_upper[i * n + k] / pivot;
      lower_upper[i * n + k] = ratio;
      for (std::size_t j = k + 1; j < n; ++j)
        lower_upper[i * n + j] -= ratio * lower_upper[k * n + j];
    }
  }
  return 0;
}

inline void solve(const double* lower_upper, std::size_t n, double* x) {
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j) x[i] -= lower_upper[i * n + j] * x[j];
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t j = i + 1; j < n; ++j) x[i] -= lower_upper[i * n + j] * x[j];
    x[i] /= lower_upper[i * n + i];
  }
}

template <int n>
struct Functions {
  static void residual(const void*, const catena_point* at, double* r) {
    const auto result = reference_model_detail::residual(plain<n>(at));
    for (std::size_t i = 0; i < n; ++i) r[i] = result[i];
  }
  static void residual_tangent(const void*, const catena_point* at, const catena_point* along,
                               double* dr) {
    const auto result = reference_model_detail::residual(along_direction<n>(at, along));
    for (std::size_t i = 0; i < n; ++i) dr[i] = result[i].derivative;
  }
  static void residual_term(const void*, const catena_point* at, int32_t term, double* r) {
    const auto result = terms(plain<n>(at))[static_cast<std::size_t>(term)];
    for (std::size_t i = 0; i < n; ++i) r[i] = result[i];
  }
  static void mass_matrix(const void*, const catena_point* at, double* mass) {
    const auto point = plain<n>(at, false, false);
    const auto matrix = reference::mass_matrix(point.parameters.chain, point.q);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) mass[i * n + j] = matrix[i][j];
  }
  static void bias(const void*, const catena_point* at, double* h) {
    const auto result = reference_model_detail::residual(plain<n>(at, true, false));
    for (std::size_t i = 0; i < n; ++i) h[i] = result[i];
  }
  static int32_t acceleration(const void*, const catena_point* at, double* a) {
    std::vector<double> matrix(n * n);
    mass_matrix(nullptr, at, matrix.data());
    if (const int bad = factor(matrix, n, true)) return bad;
    bias(nullptr, at, a);
    for (int i = 0; i < n; ++i) a[i] = -a[i];
    solve(matrix.data(), n, a);
    return 0;
  }
  static int32_t newton_factor(const void*, const catena_point* at, double ca, double cv, double cq,
                               double* work) {
    std::vector<double> matrix(n * n), zero(6 * n + 2), column(n);
    for (std::size_t j = 0; j < n; ++j) {
      std::vector<double> dq(n), dv(n), da(n);
      dq[j] = cq;
      dv[j] = cv;
      da[j] = ca;
      const catena_point along{0.0, dq.data(), dv.data(), da.data(), nullptr, nullptr, zero.data()};
      residual_tangent(nullptr, at, &along, column.data());
      for (std::size_t i = 0; i < n; ++i) matrix[i * n + j] = column[i];
    }
    const int bad = factor(matrix, n, false);
    for (std::size_t i = 0; i < n * n; ++i) work[i] = matrix[i];
    return bad;
  }
  static void newton_solve(const void*, const double* work, double* x) { solve(work, n, x); }
  static void energy(const void*, const catena_point* at, double* e) {
    const auto point = plain<n>(at, true, false);
    const auto& chain = point.parameters.chain;
    const auto momentum = product(reference::mass_matrix(chain, point.q), point.v);
    const auto elastic = product(reference::joint_matrix(chain.stiffness), point.q);
    const auto friction = product(reference::joint_matrix(chain.damping), point.v);
    for (int i = 0; i < 5; ++i) e[i] = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      e[0] += point.v[i] * momentum[i] / 2;
      // (2.7): heights above the chain hanging straight down
      e[1] += chain.length[i] * (chain.mass[i] / 2 + mass_beyond(chain, i)) * chain.gravity *
              (1 - std::cos(point.q[i]));
      e[2] += point.q[i] * elastic[i] / 2;
      e[3] += point.v[i] * friction[i];
      e[4] += point.v[i] * point.parameters.torque[i];
    }
  }
  static void positions(const void*, const catena_point* at, double* side, double* down) {
    const auto result = reference_model_detail::positions(plain<n>(at, false, false));
    for (std::size_t i = 0; i < n + 2; ++i) {
      side[i] = result[0][i];
      down[i] = result[1][i];
    }
  }
  static void positions_tangent(const void*, const catena_point* at, const catena_point* along,
                                double* dside, double* ddown) {
    auto point = along_direction<n>(at, along);
    const auto result = reference_model_detail::positions(point);
    for (std::size_t i = 0; i < n + 2; ++i) {
      dside[i] = result[0][i].derivative;
      ddown[i] = result[1][i].derivative;
    }
  }
  static void velocities(const void*, const catena_point* at, double* side_rate,
                         double* down_rate) {
    const std::vector<double> zero(6 * n + 2);
    const catena_point along{0.0, at->v, zero.data(), zero.data(), nullptr, nullptr, zero.data()};
    catena_point here = *at;
    here.a = zero.data();
    positions_tangent(nullptr, &here, &along, side_rate, down_rate);
  }
  /// No closed form is known here: not a number, which no test can take for a result.
  static void internal_forces(const void*, const catena_point*, double* moment, double* tension,
                              double* curvature) {
    for (int i = 0; i < n; ++i) moment[i] = tension[i] = curvature[i] = std::nan("");
  }
};

/// Names must outlive the table.
template <int n>
struct Texts {
  std::vector<std::string> names;
  std::vector<catena_parameter> parameters;
  std::vector<catena_quantity> coordinates;

  Texts() {
    names.reserve(7 * n + 2);
    const char* families[][3] = {{"length_", "m", "length of the link"},
                                 {"mass_", "kg", "mass of the link"},
                                 {"inertia_", "kg m^2", "inertia about the link's centre"},
                                 {"stiffness_", "N m/rad", "stiffness of the joint"},
                                 {"damping_", "N m s/rad", "damping of the joint"},
                                 {"torque_", "N m", "external torque on the link"}};
    const double infinity = std::numeric_limits<double>::infinity();
    const double none = std::numeric_limits<double>::quiet_NaN();
    for (const auto& family : families)
      for (int i = 1; i <= n; ++i) {
        const bool torque = &family == &families[5];
        names.push_back(family[0] + std::to_string(i));
        parameters.push_back({names.back().c_str(), family[1], family[2], torque ? 0.0 : none,
                              torque ? -infinity : 0.0, infinity, none});
      }
    parameters.push_back({"load_mass", "kg", "mass at the free end", none, 0.0, infinity, none});
    parameters.push_back({"gravity", "m/s^2", "gravity", 9.81, -infinity, infinity, none});
    for (int i = 1; i <= n; ++i) {
      names.push_back("theta_" + std::to_string(i));
      coordinates.push_back({names.back().c_str(), "rad"});
    }
  }
};

}  // namespace reference_model_detail

/// The table for n links. `structured` = false leaves out newton_factor and newton_solve, as a
/// model does whose Newton matrix has no structure to exploit.
template <int n>
const catena_model* reference_model(bool structured = true) {
  using F = reference_model_detail::Functions<n>;
  static const reference_model_detail::Texts<n> texts;
  static const catena_quantity terms[] = {{"inertia", "N m"},  {"coriolis", "N m"},
                                          {"gravity", "N m"},  {"elastic", "N m"},
                                          {"friction", "N m"}, {"torque", "N m"}};
  static const catena_energy energies[] = {{"kinetic", CATENA_STORED},
                                           {"gravity", CATENA_STORED},
                                           {"joint_elastic", CATENA_STORED},
                                           {"joint_damping", CATENA_DISSIPATED},
                                           {"torque", CATENA_SUPPLIED}};
  const auto make = [](bool with_newton) {
    catena_model model{};
    model.abi = CATENA_MODEL_ABI;
    model.size = sizeof(catena_model);
    model.id = "reference";
    model.description_hash = "";
    model.links = n;
    model.coordinates = n;
    model.parameters = 6 * n + 2;
    model.terms = 6;
    model.energies = 5;
    model.structured = with_newton ? 1 : 0;
    model.newton_work = with_newton ? n * n : 0;
    model.coordinate = texts.coordinates.data();
    model.parameter = texts.parameters.data();
    model.term = terms;
    model.energy_item = energies;
    model.residual = &F::residual;
    model.residual_tangent = &F::residual_tangent;
    model.residual_term = &F::residual_term;
    model.mass_matrix = &F::mass_matrix;
    model.bias = &F::bias;
    model.acceleration = &F::acceleration;
    model.accelerations = &F::acceleration;
    model.batch = 1;
    model.newton_factor = with_newton ? &F::newton_factor : nullptr;
    model.newton_solve = with_newton ? &F::newton_solve : nullptr;
    model.energy = &F::energy;
    model.positions = &F::positions;
    model.positions_tangent = &F::positions_tangent;
    model.velocities = &F::velocities;
    model.internal_forces = &F::internal_forces;
    return model;
  };
  static const catena_model with_structure = make(true);
  static const catena_model without = make(false);
  return structured ? &with_structure : &without;
}

}  // namespace catena::testing
