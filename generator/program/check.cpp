// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "common/whole_file.hpp"
#include "generator/checking/comparison.hpp"
#include "generator/checking/evaluator.hpp"
#include "generator/checking/findings_text.hpp"
#include "generator/checking/parser.hpp"
#include "generator/program/commands.hpp"
#include "generator/program/model_options.hpp"

namespace catena {
namespace {

struct CheckOptions {
  std::string file;
  std::optional<int> links;
  std::vector<std::string> effects;
  std::uint64_t seed = 1;
};

std::string contents_of(const std::string& file) {
  try {
    return bytes_of_file(file);
  } catch (const std::filesystem::filesystem_error& failure) {
    throw InputError(file + ": error: cannot be read: " + failure.code().message());
  }
}

/// 0 if every entry is equal, 1 if one is different or undecided.
int check(const CheckOptions& options) {
  using namespace checking;
  const Derivation derivation = evaluate(parse_derivation(contents_of(options.file), options.file),
                                         options.file, options.links, effects_of(options.effects));
  const std::vector<Finding> findings = compare(derivation, options.seed);
  std::cout << findings_text(options.file, derivation, findings) << std::flush;
  if (!std::cout) throw std::runtime_error("the report cannot be written to standard output");
  return std::all_of(findings.begin(), findings.end(),
                     [](const Finding& finding) { return finding.verdict == Verdict::kEqual; })
             ? 0
             : 1;
}

}  // namespace

void add_check_command(CLI::App& app, int& status) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand("check", "Check a hand derivation, or scalar identities");
  command->add_option("DERIVATION", options->file, "text file, see docs/checking.md")->required();
  command->add_option("--links", options->links, "number of links, instead of the file's");
  add_effect_option(*command, options->effects);
  command->add_option("--seed", options->seed, "selects the states shown and those of evaluations")
      ->capture_default_str();
  command->footer(
      "Exit status: 0 all equal, 1 something different or undecided, 2 wrong\ninput.\n"
      "Example: catena check examples/derivations/chapter_3_two_links.txt");
  command->callback([options, &status] { status = check(*options); });
}

}  // namespace catena
