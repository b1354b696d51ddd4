// SPDX-License-Identifier: GPL-3.0-or-later
//
// The flat derivation against the closed forms of chapter 4, which were written by hand: exactly.
#include "generator/checking/flat_derivation.hpp"

#include <doctest/doctest.h>

#include "generator/checking/normal_form.hpp"
#include "reference/coriolis.hpp"
#include "reference/gravity.hpp"
#include "reference/joint_matrix.hpp"
#include "reference/mass_matrix.hpp"

using namespace catena;
using namespace catena::checking;
using GiNaC::ex;

namespace flat_derivation_test {
namespace {

bool identical(const ex& a, const ex& b) {
  NormalForm form({a, b});
  return form(a - b).numerator.is_zero();
}

reference::Vector<ex> from_one(const std::vector<ex>& indexed) {
  return {indexed.begin() + 1, indexed.end()};
}

}  // namespace

TEST_CASE("the flat derivation gives the closed forms of chapter 4") {
  for (int n = 1; n <= 6; ++n) {
    INFO(n << " links");
    const ChainSymbols symbols(n);
    const FlatDerivation flat(symbols);
    const reference::Chain<ex> chain{from_one(symbols.length),
                                     from_one(symbols.mass),
                                     from_one(symbols.inertia),
                                     from_one(symbols.stiffness),
                                     from_one(symbols.damping),
                                     symbols.load_mass,
                                     symbols.gravity};
    const auto theta = from_one(symbols.angle);
    const auto rate = from_one(symbols.rate);
    const auto mass = reference::mass_matrix(chain, theta);
    const auto coriolis = reference::coriolis(chain, theta, rate);
    const auto gravity = reference::gravity(chain, theta);
    const auto stiffness = reference::joint_matrix(chain.stiffness);
    const auto damping = reference::joint_matrix(chain.damping);
    for (int i = 1; i <= n; ++i) {
      const auto row = static_cast<std::size_t>(i - 1);
      CHECK(identical(total(flat.coriolis(i)), coriolis[row]));
      CHECK(identical(total(flat.gravity(i)), gravity[row]));
      ex equation = coriolis[row] + gravity[row] - symbols.torque[row + 1];
      for (int j = 1; j <= n; ++j) {
        const auto column = static_cast<std::size_t>(j - 1);
        CHECK(identical(total(flat.mass(i, j)), mass[row][column]));
        CHECK(identical(total(flat.stiffness(i, j)), stiffness[row][column]));
        CHECK(identical(total(flat.damping(i, j)), damping[row][column]));
        equation += mass[row][column] * symbols.acceleration[column + 1] +
                    damping[row][column] * rate[column] + stiffness[row][column] * theta[column];
      }
      CHECK(identical(total(flat.equation(i)), equation));
    }
  }
}

TEST_CASE("the time derivative follows the chain rule") {
  const ChainSymbols s(2);
  const ex& q = s.angle[1];
  const ex& w = s.rate[1];
  CHECK(identical(s.time_derivative(GiNaC::sin(q) * w),
                  GiNaC::cos(q) * w * w + GiNaC::sin(q) * s.acceleration[1]));
  CHECK(identical(s.time_derivative(GiNaC::pow(q - s.angle[2], 2) / s.length[1]),
                  2 * (q - s.angle[2]) * (w - s.rate[2]) / s.length[1]));
  CHECK(identical(s.time_derivative(GiNaC::exp(q * q)), 2 * q * w * GiNaC::exp(q * q)));
  CHECK(s.time_derivative(s.mass[1] * s.gravity).is_zero());
  CHECK_THROWS_AS((void)s.time_derivative(s.acceleration[1]), std::invalid_argument);
}

}  // namespace flat_derivation_test
