// SPDX-License-Identifier: BSD-3-Clause
//
// The closed forms of chapter 4 against chapter 3's models written out by hand.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "reference/coriolis.hpp"
#include "reference/four_links.hpp"
#include "reference/gravity.hpp"
#include "reference/joint_matrix.hpp"
#include "reference/mass_matrix.hpp"
#include "reference/three_links.hpp"
#include "reference/two_links.hpp"
#include "tests/runtime/dual_number.hpp"

namespace {

namespace reference = catena::reference;
using Vector = reference::Vector<double>;

// Both sides sum the same few positive masses and multiply the same factors, in another order: a
// dozen roundings, relative to the largest product before sines and cosines, whose differences may
// cancel to nearly nothing.
constexpr double kRoundings = 16 * std::numeric_limits<double>::epsilon();

struct Sample {
  reference::Chain<double> chain;
  Vector theta, rate;
};

Sample sample(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  const auto vector = [&](double low, double high) {
    std::uniform_real_distribution<double> uniform(low, high);
    Vector values(n);
    for (double& value : values) value = uniform(random);
    return values;
  };
  Sample result;
  result.chain = {vector(0.1, 2.0),
                  vector(0.0, 3.0),
                  vector(0.0, 0.1),
                  vector(0.0, 50.0),
                  vector(0.0, 1.0),
                  vector(0.0, 5.0)[0],
                  9.81};
  result.theta = vector(-3.2, 3.2);
  result.rate = vector(-5.0, 5.0);
  return result;
}

double largest(const Vector& x) {
  double result = 0.0;
  for (const double value : x) result = std::max(result, std::abs(value));
  return result;
}

void compare(const Vector& actual, const Vector& expected, double scale) {
  REQUIRE(actual.size() == expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(actual[i] - expected[i]) <= kRoundings * scale);
  }
}

void compare(const reference::Matrix<double>& actual, const reference::Matrix<double>& expected) {
  REQUIRE(actual.size() == expected.size());
  for (std::size_t i = 0; i < actual.size(); ++i) {
    CAPTURE(i);
    compare(actual[i], expected[i], largest(expected[i]));
  }
}

/// A bound of the products l_i l_j mu that sines and cosines multiply in M, kg m^2.
double inertia_scale(const Sample& s) {
  double mass = s.chain.load_mass;
  for (const double m : s.chain.mass) mass += m;
  return mass * largest(s.chain.length) * largest(s.chain.length);
}

template <class MassMatrix, class JointMatrix, class Coriolis, class Gravity>
void check_witness(std::size_t n, MassMatrix mass_matrix, JointMatrix joint_matrix,
                   Coriolis coriolis, Gravity gravity) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    const Sample s = sample(n, seed);
    compare(reference::mass_matrix(s.chain, s.theta), mass_matrix(s.chain, s.theta));
    compare(reference::joint_matrix(s.chain.stiffness), joint_matrix(s.chain.stiffness));
    compare(reference::coriolis(s.chain, s.theta, s.rate), coriolis(s.chain, s.theta, s.rate),
            inertia_scale(s) * largest(s.rate) * largest(s.rate));
    const Vector expected = gravity(s.chain, s.theta);
    compare(reference::gravity(s.chain, s.theta), expected, largest(expected));
  }
}

#define CHECK_WITNESS(n, name)                                           \
  check_witness(                                                         \
      n, [](auto&&... x) { return reference::name::mass_matrix(x...); }, \
      [](auto&&... x) { return reference::name::joint_matrix(x...); },   \
      [](auto&&... x) { return reference::name::coriolis(x...); },       \
      [](auto&&... x) { return reference::name::gravity(x...); })

TEST_CASE("two links: section 3.2 agrees with chapter 4") { CHECK_WITNESS(2, two_links); }
TEST_CASE("three links: section 3.3 agrees with chapter 4") { CHECK_WITNESS(3, three_links); }
TEST_CASE("four links: section 3.4 agrees with chapter 4") { CHECK_WITNESS(4, four_links); }

/// dL/dtheta_i at rest is -(K theta + G)_i, and dL/drate_i is (M rate)_i: the Lagrangians as
/// printed against the matrices as printed.
template <class Lagrangian>
void check_lagrangian(std::size_t n, Lagrangian lagrangian) {
  using catena::testing::Dual;
  const Sample s = sample(n, 7);
  const auto dual = [](const Vector& x) { return reference::Vector<Dual>(x.begin(), x.end()); };
  const reference::Chain<Dual> chain{
      dual(s.chain.length),  dual(s.chain.mass), dual(s.chain.inertia), dual(s.chain.stiffness),
      dual(s.chain.damping), s.chain.load_mass,  s.chain.gravity};
  const auto mass = reference::mass_matrix(s.chain, s.theta);
  const auto stiffness = reference::joint_matrix(s.chain.stiffness);
  const Vector gravity = reference::gravity(s.chain, s.theta);
  Vector momentum(n), force(n), expected_momentum(n), expected_force(n);
  for (std::size_t i = 0; i < n; ++i) {
    auto theta = dual(s.theta), rate = dual(s.rate);
    rate[i].derivative = 1.0;
    momentum[i] = lagrangian(chain, theta, rate).derivative;
    theta[i].derivative = 1.0;
    force[i] = lagrangian(chain, theta, reference::Vector<Dual>(n)).derivative;
    expected_force[i] = -gravity[i];
    for (std::size_t j = 0; j < n; ++j) {
      expected_momentum[i] += mass[i][j] * s.rate[j];
      expected_force[i] -= stiffness[i][j] * s.theta[j];
    }
  }
  compare(momentum, expected_momentum, inertia_scale(s) * largest(s.rate));
  compare(force, expected_force, largest(s.chain.stiffness) * largest(s.theta) + largest(gravity));
}

TEST_CASE("the Lagrangians (3.1), (3.6), (3.10) give the matrices printed beside them") {
  check_lagrangian(2, [](auto&&... x) { return reference::two_links::lagrangian(x...); });
  check_lagrangian(3, [](auto&&... x) { return reference::three_links::lagrangian(x...); });
  check_lagrangian(4, [](auto&&... x) { return reference::four_links::lagrangian(x...); });
}

TEST_CASE("friction as printed in (3.2)-(3.14) is -C thetadot") {
  for (const std::size_t n : {2u, 3u, 4u}) {
    const Sample s = sample(n, 3);
    const Vector printed = n == 2   ? reference::two_links::friction_force(s.chain, s.rate)
                           : n == 3 ? reference::three_links::friction_force(s.chain, s.rate)
                                    : reference::four_links::friction_force(s.chain, s.rate);
    const auto damping = reference::joint_matrix(s.chain.damping);
    Vector expected(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) expected[i] -= damping[i][j] * s.rate[j];
    compare(printed, expected, largest(s.chain.damping) * largest(s.rate));
  }
}

TEST_CASE("K for two to four joints is (4.8)-(4.10)") {
  CHECK(reference::joint_matrix<double>({3, 5}) == reference::Matrix<double>{{8, -5}, {-5, 5}});
  CHECK(reference::joint_matrix<double>({3, 5, 7}) ==
        reference::Matrix<double>{{8, -5, 0}, {-5, 12, -7}, {0, -7, 7}});
  CHECK(
      reference::joint_matrix<double>({3, 5, 7, 11}) ==
      reference::Matrix<double>{{8, -5, 0, 0}, {-5, 12, -7, 0}, {0, -7, 18, -11}, {0, 0, -11, 11}});
}

}  // namespace
