// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/tangent_equations.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>
#include <vector>

#include "generator/derivation/written_out.hpp"

using catena::Axis;
using GiNaC::ex;
using GiNaC::numeric;

namespace {

catena::Chain chain_in_space(int links, const std::vector<std::string>& effects) {
  catena::Description description = catena::plain_chain();
  description.space = catena::Space::kThreeDimensional;
  for (const std::string& effect : effects)
    description.effects.push_back(catena::built_in_effect(effect));
  return {description, links};
}

// Directions with rational components, one of them horizontal, and |q| other than one: every comparison is exact.
class Values {
 public:
  explicit Values(catena::Chain& chain)
      : names_(chain.definitions()), written_out_(names_, {"direction_scale", "tangent_sign"}) {
    const numeric slopes[][2] = {{numeric(1, 3), numeric(-1, 2)}, {2, numeric(3, 2)}, {0, 1}};
    for (int i = 1; i <= chain.links(); ++i) {
      const auto& [u, v] = slopes[(i - 1) % 3];
      const numeric share = numeric(1) / (1 + u * u + v * v), length(i + 1, i);
      const numeric down = (1 - u * u - v * v) * share;
      const numeric e[] = {2 * u * share, down, 2 * v * share};
      for (const Axis axis : chain.axes())
        value_[names_.input("direction" + ending(axis), i)] = length * e[axis];
      value_[names_.input("direction_scale", i)] = 1 / length;
      value_[names_.input("tangent_sign", i)] = down.is_negative() ? -1 : 1;
    }
  }
  void set(const ex& symbol, const ex& value) { value_[symbol] = value; }
  // Inputs that have no value yet get one.
  ex of(const ex& expression) {
    const ex open = written_out_.of(expression);
    for (const int number : names_.symbols_of(open))
      value_.emplace(names_[number].symbol, numeric(number % 7 + 1, number % 5 + 2));
    return open.subs(value_, GiNaC::subs_options::no_pattern).expand();
  }

 private:
  catena::Definitions& names_;
  catena::WrittenOut written_out_;
  GiNaC::exmap value_;
};

// Entry (k, l) of the block of links i and j <= i.
ex block(const catena::TangentEquations& by_tangents, std::size_t i, std::size_t j, std::size_t k,
         std::size_t l) {
  const catena::Quasiseparable& mass = by_tangents.mass;
  if (i == j) return mass.diagonal[i][k][l];
  ex entry = 0;
  for (std::size_t r = 0; r < mass.lower_row[i][k].size(); ++r)
    entry += mass.lower_row[i][k][r] * mass.lower_column[j][l][r];
  return entry;
}

}  // namespace

TEST_CASE("the equations by tangents are those of the coordinates") {
  const std::vector<std::string> plain, moving_water = {"added_mass", "load_inertia"};
  for (const auto& each : {std::pair(1, plain), {2, plain}, {4, plain}, {3, moving_water}}) {
    const int links = each.first;
    const std::vector<std::string>& effects = each.second;
    CAPTURE(links);
    CAPTURE(effects.size());
    catena::Chain chain = chain_in_space(links, effects);
    catena::Definitions& names = chain.definitions();
    const auto by_tangents = catena::find_tangent_equations(chain, "mass_");
    const catena::Quasiseparable& mass = by_tangents.mass;
    REQUIRE_MESSAGE(mass.found, mass.reason);
    CHECK(mass.symmetric);
    CHECK(mass.lower_rank == (links == 1 ? 1 : 3));
    Values values(chain);
    const auto n = static_cast<std::size_t>(links);
    const auto row_of = [&](std::size_t axis, std::size_t i) { return axis * n + i - 1; };
    const auto M = [&](std::size_t a, std::size_t i, std::size_t b, std::size_t j) {
      catena::Differential along(names, [](const std::string& family) { return family + "_by"; });
      along.set(chain.accelerations()[row_of(b, j)], 1);
      return values.of(along.of(chain.residual()[row_of(a, i)]));
    };
    for (std::size_t i = 1; i <= n; ++i) {
      CAPTURE(i);
      const auto& E = by_tangents.tangent[i];
      ex along_q = 0;
      for (std::size_t k = 0; k < 2; ++k) {
        ex to_q = 0;
        for (std::size_t a = 0; a < 3; ++a) to_q += E[k][a] * chain.coordinates()[row_of(a, i)];
        CHECK(values.of(to_q).is_zero());
        for (std::size_t l = 0; l < 2; ++l) {
          ex product = k == l ? -1 : 0;
          for (std::size_t a = 0; a < 3; ++a) product += E[k][a] * E[l][a];
          CHECK(values.of(product).is_zero());
        }
      }
      for (std::size_t j = 1; j <= i; ++j) {
        CAPTURE(j);
        ex left[2][2];
        for (std::size_t a = 0; a < 3; ++a) {
          for (std::size_t b = 0; b < 3; ++b) {
            const ex entry = M(a, i, b, j);
            const ex& q = chain.coordinates()[row_of(a, i)];
            if (i == j)
              along_q += q * entry * chain.coordinates()[row_of(b, i)] *
                         GiNaC::pow(names.input("direction_scale", static_cast<int>(i)), 2);
            for (std::size_t k = 0; k < 2; ++k)
              for (std::size_t l = 0; l < 2; ++l)
                left[k][l] += E[k][a] * entry * by_tangents.tangent[j][l][b];
          }
        }
        const ex sizes = by_tangents.size[i][0][0] * by_tangents.size[j][0][0];
        for (std::size_t k = 0; k < 2; ++k) {
          for (std::size_t l = 0; l < 2; ++l)
            CHECK(values.of(sizes * left[k][l] - block(by_tangents, i, j, k, l)).is_zero());
        }
      }
      CHECK(values.of(along_q - by_tangents.along[i][0][0]).is_zero());
    }
    // With what is known of q'', and any x, no equation is left along q, and the equations of x say what is left
    // along the tangents.
    for (const ex& acceleration : chain.accelerations()) values.set(acceleration, 0);
    const auto x = [](std::size_t i, std::size_t k) {
      return numeric(static_cast<long>(k + i), 3);
    };
    std::vector<ex> accelerations;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t i = 1; i <= n; ++i) {
        accelerations.push_back(values.of(by_tangents.acceleration[i][a][0]));
        for (std::size_t k = 0; k < 2; ++k)
          accelerations.back() += x(i, k) * values.of(by_tangents.size[i][0][0]) *
                                  values.of(by_tangents.tangent[i][k][a]);
      }
    }
    for (std::size_t k = 0; k < 3 * n; ++k) values.set(chain.accelerations()[k], accelerations[k]);
    for (std::size_t i = 1; i <= n; ++i) {
      ex along = 0, left[2];
      for (std::size_t a = 0; a < 3; ++a) {
        const ex r = values.of(chain.residual()[row_of(a, i)]);
        along += values.of(chain.coordinates()[row_of(a, i)]) * r;
        for (std::size_t k = 0; k < 2; ++k) left[k] += values.of(by_tangents.tangent[i][k][a]) * r;
      }
      CHECK(along.is_zero());
      for (std::size_t k = 0; k < 2; ++k) {
        ex equation = values.of(by_tangents.force[i][k][0]);
        for (std::size_t j = 1; j <= n; ++j)
          for (std::size_t l = 0; l < 2; ++l)
            equation += x(j, l) * values.of(j <= i ? block(by_tangents, i, j, k, l)
                                                   : block(by_tangents, j, i, l, k));
        CHECK((left[k] * values.of(by_tangents.size[i][0][0]) - equation).is_zero());
      }
    }
  }
}

TEST_CASE("one number stands for each block where inertia is the same in all directions") {
  catena::Chain chain = chain_in_space(3, {}), in_water = chain_in_space(3, {"added_mass"});
  const auto plain = catena::find_tangent_equations(chain, "mass_");
  REQUIRE(plain.isotropic);
  CHECK(!catena::find_tangent_equations(in_water, "mass_").isotropic);
  Values values(chain);
  for (std::size_t i = 1; i <= 3; ++i) {
    for (std::size_t j = 1; j <= i; ++j) {
      for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t l = 0; l < 2; ++l) {
          ex product = 0;
          for (std::size_t a = 0; a < 3; ++a)
            product += plain.tangent[i][k][a] * plain.tangent[j][l][a];
          const ex number = i == j ? plain.number_of_diagonal[i][0][0]
                                   : plain.number_of_row[i][0][0] * plain.number_of_column[j][0][0];
          CHECK(values.of(number * product - block(plain, i, j, k, l)).is_zero());
        }
      }
    }
  }
}

TEST_CASE("a load that moves has coordinates beyond those of the links") {
  catena::Chain chain = chain_in_space(2, {"load_body"});
  const auto by_tangents = catena::find_tangent_equations(chain, "mass_");
  CHECK(!by_tangents.mass.found);
  CHECK(by_tangents.mass.reason == "there are coordinates of no link");
}
