// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/run_check.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>

#include "generator/checking/comparison.hpp"
#include "generator/checking/evaluator.hpp"
#include "generator/checking/parser.hpp"
#include "generator/checking/report.hpp"
#include "generator/description/input_error.hpp"

namespace catena {
namespace {

std::string contents_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad())
    throw InputError(file + ": error: cannot be read: " + std::strerror(errno));
  return text;
}

int check(const std::string& file, std::optional<int> links, std::uint64_t seed) {
  const Derivation derivation =
      evaluate(parse_derivation(contents_of(file), file), file, links);
  const std::vector<Finding> findings = compare(derivation, seed);
  std::cout << report(file, derivation, findings) << std::flush;
  if (!std::cout) throw std::runtime_error("the report could not be written");
  const bool all_equal = std::all_of(findings.begin(), findings.end(), [](const Finding& finding) {
    return finding.verdict == Verdict::kEqual;
  });
  return all_equal ? 0 : 1;
}

}  // namespace

int run_check(int argc, char** argv) {
  CLI::App app("Checks a hand derivation of the chain's equations, or scalar identities, exactly.",
               argc > 0 ? argv[0] : "catena check");
  std::string file;
  std::optional<int> links;
  std::uint64_t seed = 1;
  app.add_option("DERIVATION", file, "text file with the derivation (docs/checking.md)")->required();
  app.add_option("--links", links, "check for this number of links instead of the file's");
  app.add_option("--seed", seed, "selects the numeric states shown (default 1)");
  app.footer("Exit status: 0 all proved equal, 1 something different or undecided, 2 wrong input.");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return check(file, links, seed);
  } catch (const InputError& error) {
    std::cerr << error.what() << "\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << file << ": error: " << error.what() << "\n";
    return 1;
  }
}

}  // namespace catena
