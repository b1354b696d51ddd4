// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/space_proof.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "generator/derivation/chain.hpp"
#include "generator/derivation/structure.hpp"
#include "generator/derivation/written_out.hpp"
#include "tests/support/near.hpp"

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
    CHECK(difference == catena::near(-2 * angle / std::sin(angle), 1e-6));
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

// What the emitted solvers factor, from rows and columns, against the derivatives of the equations, all
// symbols kept.
TEST_CASE("the blocks of the matrices in space are the derivatives of the equations") {
  const auto compare = [](int links, const char* term, bool mass_alone) {
    Chain chain(in_space(), links, term);
    catena::Definitions& names = chain.definitions();
    catena::Weights weights{1, 0, 0};
    if (!mass_alone) weights = {names.input("ca"), names.input("cv"), names.input("cq")};
    const catena::Quasiseparable matrix = catena::find_structure(chain, weights, "matrix_");
    REQUIRE_MESSAGE(matrix.found, matrix.reason);
    CHECK(matrix.block == 3);
    if (mass_alone) CHECK(matrix.symmetric);
    catena::WrittenOut written_out(names, {"direction_scale"});
    catena::Differential change(names, [](const std::string& family) { return family + "_by"; });
    const auto n = static_cast<std::size_t>(links);
    const auto unit = [&](std::size_t k) { return names.input("unit_" + std::to_string(k)); };
    for (std::size_t k = 0; k < 3 * n; ++k) {
      change.set(chain.coordinates()[k], weights.position * unit(k));
      change.set(chain.rates()[k], weights.velocity * unit(k));
      change.set(chain.accelerations()[k], weights.acceleration * unit(k));
    }
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t i = 1; i <= n; ++i) {
        ex row = -change.of(chain.residual()[a * n + i - 1]);
        for (std::size_t b = 0; b < 3; ++b) {
          for (std::size_t j = 1; j <= n; ++j) {
            ex entry = i == j       ? matrix.diagonal[i][a][b]
                       : j == i + 1 ? matrix.above[i][a][b]
                       : i == j + 1 ? matrix.below[i][a][b]
                                    : ex(0);
            const auto& rows = (j > i ? matrix.upper_row : matrix.lower_row)[i][a];
            const auto& columns = (j > i ? matrix.upper_column : matrix.lower_column)[j][b];
            for (std::size_t r = 0; i != j && r < rows.size(); ++r) entry += rows[r] * columns[r];
            row += entry * unit(b * n + j - 1);
          }
        }
        CAPTURE(a);
        CAPTURE(i);
        CHECK(written_out.of(row).is_zero());
      }
    }
  };
  for (const int links : {1, 2, 3, 5}) compare(links, "kinetic", true);
  for (const char* term : {"kinetic", "elastic", "friction"}) compare(3, term, false);
}

TEST_CASE("what has a meaning in the plane only is refused in space") {
  catena::Description description = in_space();
  description.effects.push_back(catena::built_in_effect("axial_stretch"));
  CHECK_THROWS_WITH_AS(Chain(description, 2),
                       "\"axial_stretch\" acts in the plane only: built in: axial_stretch:34: "
                       "kinematics.extension: links in space do not stretch yet. Space is "
                       "\"3d\"; leave one of them away",
                       std::invalid_argument);
}
