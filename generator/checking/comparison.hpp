// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "generator/checking/derivation.hpp"

namespace catena::checking {

enum class Verdict {
  kEqual,      ///< proved, or by evaluation
  kDifferent,  ///< disproved, or not decided by algebra but different at a state
  kUndecided   ///< not decided by algebra, and equal at every state tried
};

/// The result for one entry.
struct Finding {
  Verdict verdict = Verdict::kUndecided;
  bool by_evaluation = false;        ///< equal at a random point, exactly: exact_form.hpp
  std::string remark;                ///< in what sense equal, or why undecided; may be empty
  std::string difference;            ///< by hand minus model (or left minus right), readable
  std::string simplest;              ///< the shortest term of a long difference, else empty
  std::size_t terms = 0;             ///< of the difference
  std::vector<std::string> origins;  ///< where the difference comes from
  std::vector<std::string> state;    ///< "theta_1 = 0.73" ...: of the two values below
  std::string value;                 ///< by hand, or left side, 12 digits
  std::string expected;              ///< the model's, or right side
  std::map<int, GiNaC::numeric> combination;  ///< of an equation that holds: its factors at a state
};

/// One finding for each entry of the derivation, in its order. The chain's side is derived from its
/// energies (FlatDerivation). `seed` selects the states and the points of evaluations.
std::vector<Finding> compare(const Derivation& derivation, std::uint64_t seed);

/// How many of the equations that hold are independent of one another, at a random state.
int independent_equations(const std::vector<Finding>& findings, int coordinates);

}  // namespace catena::checking
