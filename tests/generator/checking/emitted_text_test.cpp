// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two derivations that share no code: the text that the generator emits, run with symbols for
// numbers, against the flat derivation with which hand derivations are checked. Exactly, for 1 to 6
// links.
#include <doctest/doctest.h>

#include <vector>

#include "chain_1.hpp"
#include "chain_2.hpp"
#include "chain_3.hpp"
#include "chain_4.hpp"
#include "chain_5.hpp"
#include "chain_6.hpp"
#include "generator/checking/flat_derivation.hpp"
#include "generator/checking/normal_form.hpp"

using namespace catena;
using namespace catena::checking;
using GiNaC::ex;

namespace {

bool identical(const ex& a, const ex& b) {
  NormalForm form({a, b});
  return form(a - b).numerator.is_zero();
}

/// Parameters in the order of the emitted model's table.
std::vector<ex> parameters_of(const checking::ChainSymbols& chain) {
  std::vector<ex> result;
  for (const auto* family : {&chain.length, &chain.mass, &chain.inertia, &chain.stiffness,
                             &chain.damping, &chain.torque})
    result.insert(result.end(), family->begin() + 1, family->end());
  result.push_back(chain.load_mass);
  result.push_back(chain.gravity);
  return result;
}

template <class Residual, class MassMatrix>
void compare(int links, const Residual& residual, const MassMatrix& mass_matrix) {
  const checking::ChainSymbols chain(links);
  const FlatDerivation flat(chain);
  const std::vector<ex> parameters = parameters_of(chain);
  const Point<ex> at{0,       &chain.angle[1], &chain.rate[1],   &chain.acceleration[1],
                     nullptr, nullptr,         parameters.data()};
  const auto n = static_cast<std::size_t>(links);
  std::vector<ex> r(n), mass(n * n);
  residual(at, r.data());
  mass_matrix(at, mass.data());
  for (int i = 1; i <= links; ++i) {
    INFO(links << " links, row " << i);
    const auto row = static_cast<std::size_t>(i - 1);
    CHECK(identical(r[row], total(flat.equation(i))));
    CHECK_FALSE(identical(r[row], total(flat.equation(i % links + 1)) + chain.gravity));
    for (int j = 1; j <= links; ++j)
      CHECK(identical(mass[row * n + static_cast<std::size_t>(j - 1)], total(flat.mass(i, j))));
  }
}

// The functions of an emitted namespace are templates, so a macro has to name them.
#define CATENA_COMPARE(links)                                                    \
  compare(                                                                       \
      links, [](const Point<ex>& at, ex* r) { chain_##links::residual(at, r); }, \
      [](const Point<ex>& at, ex* mass) { chain_##links::mass_matrix(at, mass); })

}  // namespace

TEST_CASE("the emitted text equals the flat derivation") {
  CATENA_COMPARE(1);
  CATENA_COMPARE(2);
  CATENA_COMPARE(3);
  CATENA_COMPARE(4);
  CATENA_COMPARE(5);
  CATENA_COMPARE(6);
}
