// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact comparison with the closed forms of chapter 4 (reference), with all symbols: the difference
// of each entry, with sines and cosines of differences written out, must expand to zero.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

namespace catena {

/// A plain chain as a model gives it, in symbols: M row by row, and each term of r.
struct ChainInSymbols {
  std::vector<GiNaC::ex> mass_matrix;
  std::vector<GiNaC::ex> coriolis, gravity, elastic, friction, torque;
};

/// The symbols of both sides. Each vector has one entry per link.
struct ChainSymbols {
  explicit ChainSymbols(int links);
  std::vector<GiNaC::ex> theta, rate, acceleration;
  std::vector<GiNaC::ex> length, mass, inertia, stiffness, damping, torque;
  GiNaC::ex load_mass, gravity;
};

struct Proof {
  std::string what;        ///< "M", "F", ...
  int entries = 0;         ///< compared
  bool equal = true;       ///< all of them
  std::string difference;  ///< first entry that is not: "M(1, 2): ..."
};

/// M, F, G, K theta, C thetadot, T, in this order.
std::vector<Proof> compare_with_closed_form(const ChainSymbols& symbols,
                                            const ChainInSymbols& model);

/// Derives the plain chain and compares.
std::vector<Proof> prove_closed_form(int links);

}  // namespace catena
