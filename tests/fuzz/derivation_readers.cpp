// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/budget.hpp"
#include "generator/checking/comparison.hpp"
#include "generator/checking/evaluator.hpp"
#include "generator/checking/findings_text.hpp"
#include "generator/checking/parser.hpp"
#include "tests/fuzz/readers.hpp"

namespace catena::tests {
namespace {

/// Operations of an input with all its statements and comparisons: up to half a second. A user may
/// have 10 million for each, as whole matrices need minutes; what lies beyond the first of them is the same
/// again, so that inputs tell more than time does.
constexpr double kMostOperations = 1e5;

checking::Derivation derivation_of(const std::string& text) {
  return checking::evaluate(checking::parse_derivation(text, "derivation"), "derivation");
}

void read_a_derivation(const std::string& text) {
  const checking::Budget budget(kMostOperations);
  (void)derivation_of(text);
}

void compare_a_derivation(const std::string& text) {  // it takes a hundred times as long
  const checking::Budget budget(kMostOperations);
  const checking::Derivation derivation = derivation_of(text);
  (void)findings_text("derivation", derivation, compare(derivation, 1));
}

constexpr Reader kDerivationReaders[] = {
    {"derivation", refused_or_read<read_a_derivation>},
    {"comparison", refused_or_read<compare_a_derivation>},
};

}  // namespace

std::span<const Reader> derivation_readers() { return kDerivationReaders; }

}  // namespace catena::tests
