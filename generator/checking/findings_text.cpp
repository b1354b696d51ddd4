// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/findings_text.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>

#include "generator/checking/exact_form.hpp"

namespace catena::checking {
namespace {

std::string verdict_text(const Finding& finding) {
  if (finding.verdict == Verdict::kEqual)
    return finding.by_evaluation ? "equal by evaluation" : "equal";
  return finding.verdict == Verdict::kDifferent ? "different" : "undecided";
}

std::string lines_text(const Entry& entry) {
  std::string text = "line " + std::to_string(entry.at.line);
  std::vector<int> earlier;
  for (const Location& at : entry.overwritten)
    if (at.line != entry.at.line &&
        std::find(earlier.begin(), earlier.end(), at.line) == earlier.end())
      earlier.push_back(at.line);
  if (earlier.empty()) return text;
  text += ", overwriting line";
  for (std::size_t i = 0; i < earlier.size(); ++i)
    text += (i == 0 ? " " : ", ") + std::to_string(earlier[i]);
  return text;
}

std::string paragraph(const Entry& entry, const Finding& finding, std::size_t width) {
  const bool sides = entry.quantity == Quantity::kIdentity;
  std::string text =
      entry.label + std::string(width - entry.label.size() + 2, ' ') + verdict_text(finding);
  if (!finding.remark.empty()) text += ", " + finding.remark;
  text += "  (" + lines_text(entry) + ")\n";
  if (finding.verdict == Verdict::kEqual) return text;
  const std::string indent = "    ";
  if (!finding.difference.empty()) {
    if (!finding.simplest.empty())
      text += indent + "simplest term of the difference: " + finding.simplest + "\n";
    text += indent + (sides ? "left - right" : "yours - the chain's") + " = " + finding.difference +
            "\n";
  }
  for (const std::string& origin : finding.origins) text += indent + "from: " + origin + "\n";
  if (finding.value.empty()) return text;
  std::string state;
  for (const std::string& assignment : finding.state)
    state += (state.empty() ? "" : ", ") + assignment;
  text += indent + (state.empty() ? "" : "at " + state + ":\n" + indent) +
          (sides ? "left " : "yours ") + finding.value + ", " +
          (sides ? "right " : "the chain's ") + finding.expected + "\n";
  return text;
}

/// Remarks on a whole matrix.
std::string matrix_remarks(const Derivation& derivation, const std::vector<Finding>& findings,
                           Quantity quantity) {
  const int n = derivation.chain->coordinates();
  std::map<std::pair<int, int>, const Entry*> entries;
  bool different = false;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const Entry& entry = derivation.entries[i];
    if (entry.quantity != quantity) continue;
    entries[{entry.row, entry.column}] = &entry;
    different = different || findings[i].verdict == Verdict::kDifferent;
  }
  if (entries.empty()) return "";
  const std::string name = name_of(quantity);
  std::string text;
  const auto total = static_cast<std::size_t>(n) * static_cast<std::size_t>(n);
  if (entries.size() < total)
    text += name + ": " + std::to_string(entries.size()) + " of " + std::to_string(total) +
            " entries are given; the others are not checked\n";
  if (!different || n < 2) return text;
  bool diagonal = entries.size() == total, mirrored = true;
  for (const auto& [index, entry] : entries) {
    if (index.first == index.second) continue;
    diagonal = diagonal && entry->value.is_zero();
    const auto other = entries.find({index.second, index.first});
    if (other != entries.end())
      mirrored = mirrored && (entry->value - other->second->value).expand().is_zero();
  }
  if (diagonal)
    text += name + " comes out diagonal; the chain's is " +
            (quantity == Quantity::kMass                           ? "full"
             : derivation.chain->space == Space::kThreeDimensional ? "tridiagonal in each block"
                                                                   : "tridiagonal") +
            "\n";
  if (!mirrored) text += name + " is not symmetric as written; the chain's is\n";
  return text;
}

/// True equations may be too few: the same one twice, or two and their sum.
std::string equations_remark(const Derivation& derivation, const std::vector<Finding>& findings) {
  const auto hold = std::count_if(findings.begin(), findings.end(), [](const Finding& finding) {
    return !finding.combination.empty();
  });
  const int coordinates = derivation.chain->coordinates();
  const int independent = independent_equations(findings, coordinates);
  if (hold < coordinates || independent == coordinates) return "";
  return "of the " + std::to_string(hold) + " equations that hold " + std::to_string(independent) +
         (independent == 1 ? " is" : " are") + " independent; the motion needs " +
         std::to_string(coordinates) + "\n";
}

}  // namespace

std::string findings_text(const std::string& file, const Derivation& derivation,
                          const std::vector<Finding>& findings) {
  std::string text = file;
  if (derivation.chain) {
    text += ": " + std::to_string(derivation.chain->links) +
            (derivation.chain->links == 1 ? " link" : " links");
    if (derivation.chain->space == Space::kThreeDimensional) text += " in space";
    for (std::size_t i = 0; i < derivation.effects.size(); ++i)
      text += (i == 0 ? ", with " : " and ") + derivation.effects[i].id;
  }
  text += "\n\n";
  std::size_t width = 0;
  for (const Entry& entry : derivation.entries) width = std::max(width, entry.label.size());
  std::map<Verdict, int> count;
  int evaluated = 0;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    text += paragraph(derivation.entries[i], findings[i], width);
    ++(findings[i].by_evaluation ? evaluated : count[findings[i].verdict]);
  }
  std::string remarks;
  if (derivation.chain)
    for (const Quantity quantity : {Quantity::kMass, Quantity::kDamping, Quantity::kStiffness})
      remarks += matrix_remarks(derivation, findings, quantity);
  if (derivation.chain) remarks += equations_remark(derivation, findings);
  if (evaluated > 0)
    remarks +=
        "equal by evaluation: too long to be expanded; the exact values at a random point are "
        "the same, which for\ndifferent expressions has a chance below 2^-" +
        std::to_string(kCertainty) + "\n";
  for (const std::string& note : derivation.notes) remarks += note + "\n";
  if (!remarks.empty()) text += "\n" + remarks;
  return text + "\n" + std::to_string(findings.size()) +
         " checked: " + std::to_string(count[Verdict::kEqual]) + " equal (proved), " +
         (evaluated > 0 ? std::to_string(evaluated) + " equal by evaluation, " : "") +
         std::to_string(count[Verdict::kDifferent]) + " different, " +
         std::to_string(count[Verdict::kUndecided]) + " undecided\n";
}

}  // namespace catena::checking
