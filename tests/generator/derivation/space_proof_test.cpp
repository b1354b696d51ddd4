// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/space_proof.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "generator/derivation/chain.hpp"
#include "generator/derivation/written_out.hpp"

using catena::Chain;
using GiNaC::ex;

namespace {

catena::Description in_space() {
  catena::Description description = catena::plain_chain();
  description.space = catena::Space::kThreeDimensional;
  return description;
}

}  // namespace

TEST_CASE("the chain in space is its closed form, and chapter 4 in every vertical plane") {
  for (const int links : {1, 2, 3, 5, 12}) {
    CAPTURE(links);
    const auto in_space = catena::prove_space_closed_form(links);
    const auto in_plane = catena::prove_plane_in_space(links);
    CHECK(in_space.size() == 5);
    CHECK(in_plane.size() == 4);
    for (const std::vector<catena::Proof>& proofs : {in_space, in_plane}) {
      for (const catena::Proof& proof : proofs) {
        CHECK_MESSAGE(proof.equal, proof.difference);
        CHECK(proof.entries >= 2 * links);
      }
    }
  }
}

TEST_CASE("the derivative of the square of an angle, as a function of its cosine") {
  const GiNaC::realsymbol c("c");
  const ex slope = catena::squared_angle(c).diff(c);
  CHECK(slope.is_equal(-2 * catena::angle_over_sine(c)));
  for (const double angle : {0.1, 1.0, 2.5}) {
    const auto squared = [](double cosine) { return std::pow(std::acos(cosine), 2); };
    const double step = 1e-6, cosine = std::cos(angle);
    const double difference = (squared(cosine + step) - squared(cosine - step)) / (2 * step);
    CHECK(difference == doctest::Approx(-2 * angle / std::sin(angle)).epsilon(1e-6));
  }
}

// d(T + V)/dt + (power of the dampers) = qdot . r along any motion. The power comes from D, r from
// Euler-Lagrange in the variables of the chain.
TEST_CASE("the power of the equations in space is that of the energies") {
  Chain chain(in_space(), 3);
  ex balance = 0;
  for (const catena::EnergyItem& item : chain.energies()) {
    for (const ex& part : item.parts)
      balance += item.kind == catena::EnergyItem::kStored ? chain.rate(part) : part;
  }
  for (std::size_t k = 0; k < chain.residual().size(); ++k)
    balance -= chain.rates()[k] * chain.residual()[k];
  CHECK(chain.residual().size() == 9);
  CHECK(catena::WrittenOut(chain.definitions()).of(balance).is_zero());
}

TEST_CASE("a chain in space has no effects") {
  catena::Description description = in_space();
  description.effects.push_back(catena::built_in_effect("load_drag"));
  CHECK_THROWS_WITH_AS(Chain(description, 2), "a chain in space has no effects",
                       std::invalid_argument);
}
