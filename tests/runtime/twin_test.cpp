// SPDX-License-Identifier: BSD-3-Clause
//
// Every emitted model against the closed forms of chapter 4, entry by entry, at seeded states: M,
// K, C, F, G, then everything else the table offers.
#include <doctest/doctest.h>

#include <Eigen/Core>
#include <limits>
#include <random>

#include "generated/models.hpp"
#include "runtime/any_links.hpp"
#include "runtime/model.hpp"
#include "tests/runtime/reference_model.hpp"

namespace twin_test {
namespace {

using catena::testing::reference_model;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();

// The terms' places in the table, after catena_model.h.
enum Term { kInertia, kCoriolis, kGravity, kElastic, kFriction, kTorque, kTerms };

/// One state and set of parameters, with directions for tangents.
struct Sample {
  VectorXd q, v, a, p, dq, dv, da, dp;
  catena_point at() const {
    return {0.3, q.data(), v.data(), a.data(), nullptr, nullptr, p.data()};
  }
  catena_point along() const {
    return {0.0, dq.data(), dv.data(), da.data(), nullptr, nullptr, dp.data()};
  }
};

enum class Kind {
  kPlain,
  kFolded,     // neighbouring links nearly on top of each other, or all in line
  kHeavyLoad,  // m_c a million times a link's mass
  kTinyLinks,  // every other link a thousand times shorter
};
constexpr Kind kKinds[] = {Kind::kPlain, Kind::kFolded, Kind::kHeavyLoad, Kind::kTinyLinks};

Sample sample(int n, unsigned seed, Kind kind) {
  std::mt19937 random(seed);
  const auto vector = [&](int size, double low, double high) {
    std::uniform_real_distribution<double> uniform(low, high);
    VectorXd values(size);
    for (double& value : values) value = uniform(random);
    return values;
  };
  Sample s;
  s.q = vector(n, -3.2, 3.2);
  s.v = vector(n, -5.0, 5.0);
  s.a = vector(n, -50.0, 50.0);
  s.p.resize(6 * n + 2);
  s.p << vector(n, 0.1, 1.0), vector(n, 0.01, 1.0), vector(n, 0.001, 0.1), vector(n, 0.0, 300.0),
      vector(n, 0.0, 1.0), vector(n, -5.0, 5.0), vector(1, 0.0, 3.0), 9.81;
  if (kind == Kind::kFolded)
    for (int i = 1; i < n; ++i)
      s.q[i] = s.q[i - 1] + (i % 2 == 0 ? 3.14159265358979 : 1e-9) * (seed % 2 == 0 ? 1.0 : 0.0);
  if (kind == Kind::kHeavyLoad) s.p[6 * n] = 1e6;
  if (kind == Kind::kTinyLinks)
    for (int i = 0; i < n; i += 2) s.p[i] *= 1e-3;
  s.dq = vector(n, -1.0, 1.0);
  s.dv = vector(n, -1.0, 1.0);
  s.da = vector(n, -1.0, 1.0);
  s.dp = vector(6 * n + 2, -1.0, 1.0);
  return s;
}

/// Bounds of the sums of magnitudes behind the rows of a result. Both sides add the same terms in
/// another order, by running sums along the chain in the emitted code, so their difference is a
/// multiple of the unit roundoff, of the number of terms and of this.
struct Scale {
  explicit Scale(const Sample& s)
      : n(static_cast<int>(s.q.size())),
        length(s.p.head(n)),
        mass(s.p[6 * n] + s.p.segment(n, n).sum()),
        inertia(s.p.segment(2 * n, n)),
        stiffness(s.p.segment(3 * n, n)),
        damping(s.p.segment(4 * n, n)),
        roundings((4 * n + 32) * kEpsilon) {}

  /// |M|_ij
  double m(int i, int j) const {
    return length[i] * length[j] * mass + (i == j ? inertia[i] : 0.0);
  }
  /// (|M| |x|)_i
  double m_times(int i, const VectorXd& x) const {
    return length[i] * mass * length.dot(x.cwiseAbs()) + inertia[i] * std::abs(x[i]);
  }
  double coriolis(int i, const VectorXd& v) const {
    return length[i] * mass * length.dot(v.cwiseAbs2());
  }
  double gravity(int i) const { return length[i] * mass * 9.81; }
  static double joint(const VectorXd& joint, int i, const VectorXd& x) {
    const int n = static_cast<int>(x.size());
    const double above = i > 0 ? std::abs(x[i - 1]) : 0.0;
    double sum = joint[i] * (std::abs(x[i]) + above);
    if (i + 1 < n) sum += joint[i + 1] * (std::abs(x[i]) + std::abs(x[i + 1]));
    return sum;
  }
  double residual(int i, const Sample& s) const {
    return m_times(i, s.a) + coriolis(i, s.v) + gravity(i) + joint(stiffness, i, s.q) +
           joint(damping, i, s.v) + std::abs(s.p[5 * n + i]);
  }

  int n;
  VectorXd length;
  double mass;
  VectorXd inertia, stiffness, damping;
  double roundings;
};

#define CHECK_NEAR(actual, expected, scale)                          \
  do {                                                               \
    const double kActual = (actual), kExpected = (expected);         \
    CAPTURE(kActual);                                                \
    CAPTURE(kExpected);                                              \
    CHECK(std::abs(kActual - kExpected) <= (scale)*bound.roundings); \
  } while (false)

/// The matrix of a term that is linear in q (or v), column by column.
MatrixXd columns(const catena_model& model, Term term, Sample s, VectorXd Sample::*argument) {
  const int n = model.coordinates;
  MatrixXd result(n, n);
  for (int j = 0; j < n; ++j) {
    (s.*argument).setZero();
    (s.*argument)[j] = 1.0;
    const catena_point at = s.at();
    model.residual_term(model.context, &at, term, result.col(j).data());
  }
  return result;
}

VectorXd term(const catena_model& model, Term which, const Sample& s) {
  VectorXd result(model.coordinates);
  const catena_point at = s.at();
  model.residual_term(model.context, &at, which, result.data());
  return result;
}

void compare_matrices(const catena_model& emitted, const catena_model& closed, const Sample& s) {
  const int n = emitted.links;
  const Scale bound(s);
  const catena_point at = s.at();
  MatrixXd mass(n, n), expected(n, n);
  emitted.mass_matrix(emitted.context, &at, mass.data());
  closed.mass_matrix(closed.context, &at, expected.data());
  const MatrixXd stiffness = columns(emitted, kElastic, s, &Sample::q),
                 expected_stiffness = columns(closed, kElastic, s, &Sample::q),
                 damping = columns(emitted, kFriction, s, &Sample::v),
                 expected_damping = columns(closed, kFriction, s, &Sample::v);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      CAPTURE(i);
      CAPTURE(j);
      CHECK_NEAR(mass(i, j), expected(i, j), bound.m(i, j));
      const VectorXd unit = VectorXd::Unit(n, j);
      CHECK_NEAR(stiffness(i, j), expected_stiffness(i, j), Scale::joint(bound.stiffness, i, unit));
      CHECK_NEAR(damping(i, j), expected_damping(i, j), Scale::joint(bound.damping, i, unit));
    }
}

void compare_vectors(const catena_model& emitted, const catena_model& closed, const Sample& s) {
  const int n = emitted.links;
  const Scale bound(s);
  const catena_point at = s.at();
  const VectorXd inertia = term(emitted, kInertia, s), coriolis = term(emitted, kCoriolis, s),
                 gravity = term(emitted, kGravity, s), torque = term(emitted, kTorque, s);
  VectorXd residual(n), bias(n), expected_residual(n), expected_bias(n);
  emitted.residual(emitted.context, &at, residual.data());
  closed.residual(closed.context, &at, expected_residual.data());
  emitted.bias(emitted.context, &at, bias.data());
  closed.bias(closed.context, &at, expected_bias.data());
  for (int i = 0; i < n; ++i) {
    CAPTURE(i);
    CHECK_NEAR(coriolis[i], term(closed, kCoriolis, s)[i], bound.coriolis(i, s.v));
    CHECK_NEAR(gravity[i], term(closed, kGravity, s)[i], bound.gravity(i));
    CHECK_NEAR(inertia[i], term(closed, kInertia, s)[i], bound.m_times(i, s.a));
    CHECK(torque[i] == -s.p[5 * n + i]);
    CHECK_NEAR(residual[i], expected_residual[i], bound.residual(i, s));
    CHECK_NEAR(bias[i], expected_bias[i], bound.residual(i, s));
  }
}

/// a and the Newton solution are checked by what they leave over in the closed form's equations:
/// backward stability, whatever the condition of the matrix.
void compare_solutions(const catena_model& emitted, const catena_model& closed, const Sample& s) {
  const int n = emitted.links;
  const Scale bound(s);
  Sample solved = s;
  const catena_point at = s.at();
  REQUIRE(emitted.acceleration(emitted.context, &at, solved.a.data()) == 0);
  VectorXd left_over(n);
  const catena_point at_solution = solved.at();
  closed.residual(closed.context, &at_solution, left_over.data());
  for (int i = 0; i < n; ++i) {
    CAPTURE(i);
    // Elimination without row exchanges of a positive definite matrix: n steps, each as exact.
    CHECK_NEAR(left_over[i], 0.0, n * bound.residual(i, solved));
  }

  if (emitted.structured == 0) return;
  std::vector<double> work(static_cast<std::size_t>(emitted.newton_work));
  const double gamma = 1e-3;
  REQUIRE(emitted.newton_factor(emitted.context, &at, 1.0, gamma, gamma * gamma, work.data()) == 0);
  VectorXd x = s.da;
  emitted.newton_solve(emitted.context, work.data(), x.data());
  Sample direction = s;
  direction.da = x;
  direction.dv = gamma * x;
  direction.dq = gamma * gamma * x;
  direction.dp.setZero();
  const catena_point along = direction.along();
  closed.residual_tangent(closed.context, &at, &along, left_over.data());
  for (int i = 0; i < n; ++i) {
    CAPTURE(i);
    const double rows =
        bound.m_times(i, x) + Scale::joint(bound.damping, i, direction.dv) +
        Scale::joint(bound.stiffness, i, direction.dq) +
        bound.m_times(i, s.v.cwiseProduct(direction.dv)) * 2 +
        bound.m_times(i, s.a.cwiseProduct(direction.dq)) +
        bound.m_times(i, s.a) * std::abs(direction.dq[i]) +
        (bound.coriolis(i, s.v) + bound.gravity(i)) * direction.dq.cwiseAbs().maxCoeff();
    CHECK_NEAR(left_over[i], s.da[i], n * (rows + std::abs(s.da[i])));
  }
}

void compare_tangent(const catena_model& emitted, const catena_model& closed, const Sample& s) {
  const int n = emitted.links;
  const Scale bound(s);
  const catena_point at = s.at(), along = s.along();
  VectorXd tangent(n), expected(n);
  emitted.residual_tangent(emitted.context, &at, &along, tangent.data());
  closed.residual_tangent(closed.context, &at, &along, expected.data());
  // A derivative of a product is a sum of products with one factor replaced; relative changes of
  // parameters reach 1000 (a length of 1e-4 changed at rate one).
  double relative = 2.0;
  for (int i = 0; i < s.p.size(); ++i)
    if (s.p[i] != 0.0) relative = std::max(relative, std::abs(s.dp[i] / s.p[i]));
  for (int i = 0; i < n; ++i) {
    CAPTURE(i);
    CHECK_NEAR(tangent[i], expected[i], 4.0 * relative * bound.residual(i, s));
  }
}

void compare_geometry(const catena_model& emitted, const catena_model& closed, const Sample& s) {
  const int n = emitted.links;
  const Scale bound(s);
  const catena_point at = s.at(), along = s.along();
  VectorXd side(n + 2), down(n + 2), expected_side(n + 2), expected_down(n + 2);
  const double reach = bound.length.sum(), speed = reach * s.v.cwiseAbs().maxCoeff(),
               change = reach * 2.0 + s.dp.head(n).cwiseAbs().sum();
  const auto compare = [&](double scale) {
    for (int i = 0; i < n + 2; ++i) {
      CAPTURE(i);
      CHECK_NEAR(side[i], expected_side[i], scale);
      CHECK_NEAR(down[i], expected_down[i], scale);
    }
  };
  emitted.positions(emitted.context, &at, side.data(), down.data());
  closed.positions(closed.context, &at, expected_side.data(), expected_down.data());
  compare(reach);
  emitted.velocities(emitted.context, &at, side.data(), down.data());
  closed.velocities(closed.context, &at, expected_side.data(), expected_down.data());
  compare(speed);
  emitted.positions_tangent(emitted.context, &at, &along, side.data(), down.data());
  closed.positions_tangent(closed.context, &at, &along, expected_side.data(), expected_down.data());
  compare(change);

  VectorXd energy(emitted.energies), expected(closed.energies);
  emitted.energy(emitted.context, &at, energy.data());
  closed.energy(closed.context, &at, expected.data());
  double kinetic = 0.0, height = 0.0, elastic = 0.0, damping = 0.0;
  for (int i = 0; i < n; ++i) {
    kinetic += std::abs(s.v[i]) * bound.m_times(i, s.v);
    height += 2.0 * bound.gravity(i);
    elastic += std::abs(s.q[i]) * Scale::joint(bound.stiffness, i, s.q);
    damping += std::abs(s.v[i]) * Scale::joint(bound.damping, i, s.v);
  }
  CHECK_NEAR(energy[0], expected[0], kinetic);
  CHECK_NEAR(energy[2], expected[2], elastic);
  CHECK_NEAR(energy[3], expected[3], damping);
  CHECK_NEAR(energy[4], expected[4],
             damping + s.v.cwiseAbs().dot(s.p.segment(5 * n, n).cwiseAbs()));
  // Heights may be counted from anywhere: only changes of the gravity energy are compared.
  Sample other = s;
  other.q += s.dq;
  const catena_point at_other = other.at();
  VectorXd energy_other(emitted.energies), expected_other(closed.energies);
  emitted.energy(emitted.context, &at_other, energy_other.data());
  closed.energy(closed.context, &at_other, expected_other.data());
  CHECK_NEAR(energy_other[1] - energy[1], expected_other[1] - expected[1], 2.0 * height);
}

// Moments from the springs and dampers, tensions from Newton's second law for all that hangs below,
// curvatures from the length of cable that a joint stands for: from middle to middle of its links,
// at the clamp half of link 1.
void compare_internal_forces(const catena_model& emitted, const Sample& s) {
  const int n = emitted.links;
  const Scale bound(s);
  const catena_point at = s.at();
  VectorXd moment(n), tension(n), curvature(n);
  emitted.internal_forces(emitted.context, &at, moment.data(), tension.data(), curvature.data());
  const auto parameter = [&](int family, int i) { return s.p[family * n + i]; };
  const double load = s.p[6 * n], gravity = s.p[6 * n + 1];
  VectorXd side(n), down(n);  // forces that link i and the load ask for: m (a - g)
  double joint_side = 0.0, joint_down = 0.0;
  for (int i = 0; i < n; ++i) {
    const double l = parameter(0, i), m = parameter(1, i);
    const double span_side = l * (s.a[i] * std::cos(s.q[i]) - s.v[i] * s.v[i] * std::sin(s.q[i]));
    const double span_down = -l * (s.a[i] * std::sin(s.q[i]) + s.v[i] * s.v[i] * std::cos(s.q[i]));
    side[i] = m * (joint_side + span_side / 2);
    down[i] = m * (joint_down + span_down / 2 - gravity);
    joint_side += span_side;
    joint_down += span_down;
  }
  const double load_side = load * joint_side, load_down = load * (joint_down - gravity);
  for (int i = 0; i < n; ++i) {
    CAPTURE(i);
    const double above = i == 0 ? 0.0 : s.q[i - 1], rate_above = i == 0 ? 0.0 : s.v[i - 1];
    const double spacing = ((i == 0 ? 0.0 : parameter(0, i - 1)) + parameter(0, i)) / 2;
    CHECK_NEAR(moment[i],
               -parameter(3, i) * (s.q[i] - above) - parameter(4, i) * (s.v[i] - rate_above),
               Scale::joint(bound.stiffness, i, s.q) + Scale::joint(bound.damping, i, s.v));
    CHECK_NEAR(curvature[i], (s.q[i] - above) / spacing,
               (std::abs(s.q[i]) + std::abs(above)) / spacing);
    const double force_side = side.tail(n - i).sum() + load_side;
    const double force_down = down.tail(n - i).sum() + load_down;
    const double largest = side.cwiseAbs().sum() + down.cwiseAbs().sum() + std::abs(load_side) +
                           std::abs(load_down) +
                           (s.p.segment(n, n).sum() + load) * s.p.head(n).sum() *
                               (s.a.cwiseAbs() + s.v.cwiseAbs2()).maxCoeff();
    CHECK_NEAR(tension[i], -(force_side * std::sin(s.q[i]) + force_down * std::cos(s.q[i])),
               largest);
  }
}

template <int n>
void check_twins(const catena::Model& model) {
  CAPTURE(n);
  REQUIRE(model.links() == n);
  const catena_model& emitted = model.table();
  const catena_model& closed = *reference_model<n>();
  REQUIRE(emitted.parameters == closed.parameters);
  for (int i = 0; i < closed.parameters; ++i)
    CHECK(std::string(emitted.parameter[i].name) == closed.parameter[i].name);
  for (int i = 0; i < closed.terms; ++i)
    CHECK(std::string(emitted.term[i].name) == closed.term[i].name);
  REQUIRE(emitted.energies == closed.energies);
  for (int i = 0; i < closed.energies; ++i) {
    CHECK(std::string(emitted.energy_item[i].name) == closed.energy_item[i].name);
    CHECK(emitted.energy_item[i].kind == closed.energy_item[i].kind);
  }
  for (const Kind kind : kKinds)
    for (unsigned seed = 1; seed <= (n > 20 ? 2u : 10u); ++seed) {
      CAPTURE(static_cast<int>(kind));
      CAPTURE(seed);
      const Sample s = sample(n, seed, kind);
      compare_matrices(emitted, closed, s);
      compare_vectors(emitted, closed, s);
      compare_solutions(emitted, closed, s);
      compare_tangent(emitted, closed, s);
      compare_geometry(emitted, closed, s);
      compare_internal_forces(emitted, s);
    }
}

TEST_CASE("emitted models agree with the closed forms of chapter 4") {
  SUBCASE("2 links") { check_twins<2>(catena::Model::built_in(2)); }
  SUBCASE("3 links") { check_twins<3>(catena::Model::built_in(3)); }
  SUBCASE("4 links") { check_twins<4>(catena::Model::built_in(4)); }
  SUBCASE("12 links") { check_twins<12>(catena::Model::built_in(12)); }
  SUBCASE("60 links") { check_twins<60>(catena::Model::built_in(60)); }
}

TEST_CASE("the model for any number of links agrees with the closed forms of chapter 4") {
  SUBCASE("5 links") { check_twins<5>(catena::any_links_model(5)); }
  SUBCASE("6 links") { check_twins<6>(catena::any_links_model(6)); }
  SUBCASE("11 links") { check_twins<11>(catena::any_links_model(11)); }
  SUBCASE("29 links") { check_twins<29>(catena::any_links_model(29)); }
}

TEST_CASE("every built-in model was compared above") {
  CHECK(catena::Model::built_in_links() == std::vector<int>{2, 3, 4, 12, 60});
}

}  // namespace

}  // namespace twin_test
