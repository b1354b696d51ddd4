// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/generator/checking/checked.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "generator/checking/evaluator.hpp"
#include "generator/checking/parser.hpp"
#include "tests/support/data.hpp"

namespace catena::tests {

std::string example(const std::string& name) {
  const std::string path = source_folder() / "examples" / "derivations" / name;
  std::ifstream stream(path);
  if (!stream) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::string left_sides(const std::string& text) {
  return text.substr(text.find('\n'), text.find("\n# Euler") - text.find('\n')) +
         "\ndissipation = sum(j = 1..n, c_j*(thetadot[j] - thetadot[j-1])^2/2)\n"
         "for i = 1..n\n"
         "  E[i] = ddt(diff(L, thetadot_i)) - diff(L, theta_i) - T_i + "
         "diff(dissipation, thetadot_i)\n"
         "end\n";
}

int Checked::count(Verdict verdict) const {
  return static_cast<int>(
      std::count_if(findings.begin(), findings.end(),
                    [&](const Finding& finding) { return finding.verdict == verdict; }));
}

const Finding& Checked::of(const std::string& label) const {
  for (std::size_t i = 0; i < findings.size(); ++i)
    if (derivation.entries[i].label == label) return findings[i];
  throw std::runtime_error("no entry is called " + label);
}

Checked checked(const std::string& text, std::optional<int> links,
                const std::vector<Effect>& effects) {
  Checked result{evaluate(parse_derivation(text, "test"), "test", links, effects), {}};
  result.findings = compare(result.derivation, 1);
  return result;
}

}  // namespace catena::tests
