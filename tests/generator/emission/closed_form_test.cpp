// SPDX-License-Identifier: GPL-3.0-or-later
//
// The emitted text itself, run with GiNaC's expressions as its scalar: every entry of M and of each
// term of r equals the closed form exactly, all symbols kept.
#include <doctest/doctest.h>

#include "generated/chain_12.hpp"
#include "generated/chain_2.hpp"
#include "generated/chain_3.hpp"
#include "generated/chain_4.hpp"
#include "generated/chain_60.hpp"
#include "generator/derivation/closed_form_proof.hpp"

namespace {

using catena::ChainInSymbols;
using catena::ChainSymbols;
using catena::Point;
using GiNaC::ex;

// What the functions of one namespace of emitted text give for symbols.
#define CATENA_RUN_EMITTED(model)                                                                \
  ChainInSymbols run_##model(const ChainSymbols& s) {                                            \
    namespace m = catena::model;                                                                 \
    std::vector<ex> p;                                                                           \
    for (const auto* family :                                                                    \
         {&s.length, &s.mass, &s.inertia, &s.stiffness, &s.damping, &s.torque}) {                \
      p.insert(p.end(), family->begin(), family->end());                                         \
    }                                                                                            \
    p.push_back(s.load_mass);                                                                    \
    p.push_back(s.gravity);                                                                      \
    REQUIRE(p.size() == m::kParameters);                                                         \
    const Point<ex> at{0,       s.theta.data(), s.rate.data(), s.acceleration.data(),            \
                       nullptr, nullptr,        p.data()};                                       \
    const size_t n = m::kLinks;                                                                  \
    ChainInSymbols out;                                                                          \
    out.mass_matrix.resize(n* n);                                                                \
    for (auto* term : {&out.coriolis, &out.gravity, &out.elastic, &out.friction, &out.torque}) { \
      term->resize(n);                                                                           \
    }                                                                                            \
    m::mass_matrix(at, out.mass_matrix.data());                                                  \
    m::term_coriolis(at, out.coriolis.data());                                                   \
    m::term_gravity(at, out.gravity.data());                                                     \
    m::term_elastic(at, out.elastic.data());                                                     \
    m::term_friction(at, out.friction.data());                                                   \
    m::term_torque(at, out.torque.data());                                                       \
    return out;                                                                                  \
  }

CATENA_RUN_EMITTED(chain_2)
CATENA_RUN_EMITTED(chain_3)
CATENA_RUN_EMITTED(chain_4)
CATENA_RUN_EMITTED(chain_12)
CATENA_RUN_EMITTED(chain_60)

struct Row {
  int links;
  ChainInSymbols (*run)(const ChainSymbols&);
};

}  // namespace

TEST_CASE("emitted text equals the closed form, entry by entry") {
  for (const Row& row : {Row{2, run_chain_2},
                         {3, run_chain_3},
                         {4, run_chain_4},
                         {12, run_chain_12},
                         {60, run_chain_60}}) {
    CAPTURE(row.links);
    const ChainSymbols symbols(row.links);
    for (const catena::Proof& proof : compare_with_closed_form(symbols, row.run(symbols))) {
      CAPTURE(proof.what);
      CHECK_MESSAGE(proof.equal, proof.difference);
      CHECK(proof.entries >= row.links);
    }
  }
}

TEST_CASE("a planted error is found and named") {
  const ChainSymbols symbols(3);
  ChainInSymbols model = run_chain_3(symbols);
  model.coriolis[1] = -model.coriolis[1];
  const auto proofs = compare_with_closed_form(symbols, model);
  CHECK(proofs[0].equal);
  CHECK_FALSE(proofs[1].equal);
  CHECK(proofs[1].difference.starts_with("F(2): the model has"));
}

TEST_CASE("any number of links is derived, one included") {
  for (const int links : {1, 5, 6, 7, 13}) {
    CAPTURE(links);
    for (const catena::Proof& proof : catena::prove_closed_form(links)) {
      CHECK_MESSAGE(proof.equal, proof.difference);
    }
  }
}
