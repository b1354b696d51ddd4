// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "generator/checking/chain_symbols.hpp"
#include "generator/checking/exact_form.hpp"
#include "generator/checking/flat_derivation.hpp"
#include "generator/checking/numeric_state.hpp"

namespace catena::checking {

/// The chain's motion in numbers: the accelerations a that solve M a + rest = 0 at a point.
/// Elimination in symbols would have too many terms from four links on. M is regular, since the
/// kinetic energy is positive for all rates other than zero if masses and lengths are positive.
/// Values of `given` may make it singular; then there are no accelerations.
class ChainMotion {
 public:
  using Vector = std::vector<GiNaC::numeric>;

  /// `equations`: all h that is_obeyed will be called with, after replacement of what is `given`.
  ChainMotion(const ChainSymbols& chain, const FlatDerivation& model, const GiNaC::exmap& given,
              const std::vector<GiNaC::ex>& equations, std::uint64_t seed);

  /// Whether h = 0 for every motion of the chain, by its exact value at a random point
  /// (exact_form.hpp). "No" is proved; "yes" is wrong with a probability below 2^-kCertainty.
  /// Nothing if h is not rational in independent quantities or M is singular.
  std::optional<bool> is_obeyed(const GiNaC::ex& h);

  /// thetaddot_1..n at a state.
  const std::optional<Vector>& accelerations(const NumericState& state);

  /// The f_j other than 0 in h = sum_j f_j (equation j), at a state: M f = slope = dh/dthetaddot.
  [[nodiscard]] std::map<int, GiNaC::numeric> factors(const Vector& slope,
                                                      const GiNaC::exmap& values) const;

  /// The symbols of the chain's equations and of those stated, without accelerations.
  [[nodiscard]] const std::vector<GiNaC::ex>& symbols() const { return symbols_; }

 private:
  struct System {  // M a + rest = 0
    std::vector<std::vector<GiNaC::ex>> mass;
    std::vector<GiNaC::ex> rest;
  };
  /// Values at a random point, accelerations included; nothing where M is singular.
  std::optional<Evaluation>& point(int bits);

  const ChainSymbols& chain_;
  std::uint64_t seed_;
  System system_;
  std::optional<ExactForm> exact_;
  System rational_;                  // system_ in the generators of exact_
  std::vector<GiNaC::ex> variable_;  // its symbols and those of the equations
  Degree solution_;                  // of an acceleration
  std::vector<GiNaC::ex> symbols_;
  std::map<std::vector<std::string>, std::optional<Vector>> motions_;  // by assignments
  std::map<int, std::optional<Evaluation>> points_;
};

/// dh/dthetaddot_1..n at a state; nothing if h is not linear in the accelerations, or not real.
std::optional<ChainMotion::Vector> acceleration_factors(const GiNaC::ex& h,
                                                        const ChainSymbols& chain,
                                                        const GiNaC::exmap& values);

}  // namespace catena::checking
