// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/comparison.hpp"
#include "generator/checking/evaluator.hpp"
#include "generator/checking/findings_text.hpp"
#include "generator/checking/parser.hpp"
#include "tests/fuzz/readers.hpp"

namespace catena::tests {
namespace {

checking::Derivation derivation_of(const std::string& text) {
  return checking::evaluate(checking::parse_derivation(text, "derivation"), "derivation");
}

void read_a_derivation(const std::string& text) { (void)derivation_of(text); }

void compare_a_derivation(const std::string& text) {  // it takes a hundred times as long
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
