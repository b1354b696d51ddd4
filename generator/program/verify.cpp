// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "common/most_links.hpp"
#include "generator/derivation/closed_form_proof.hpp"
#include "generator/derivation/space_proof.hpp"
#include "generator/program/commands.hpp"

namespace catena {

namespace {

struct VerifyOptions {
  std::vector<int> links{2, 3, 4, 12, 60};
  std::string space = "plane";
};

/// Prints what was compared; false if something differs.
bool verify(int links, const std::string& with,
            const std::function<std::vector<Proof>(int links)>& prove) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Proof> proofs = prove(links);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  std::printf("%3d links%s: ", links, with.c_str());
  bool equal = true;
  for (const Proof& proof : proofs) {
    std::printf("%s %s, ", proof.what.c_str(), proof.equal ? "equal" : "DIFFERENT");
    equal = equal && proof.equal;
  }
  std::printf("%.2f s\n", elapsed.count());
  for (const Proof& proof : proofs)
    if (!proof.equal) std::printf("  %s\n", proof.difference.c_str());
  std::fflush(stdout);
  return equal;
}

}  // namespace

void add_verify_command(CLI::App& app, int& status) {
  auto options = std::make_shared<VerifyOptions>();
  CLI::App* command =
      app.add_subcommand("verify", "Derive the plain chain, compare with closed forms");
  command->add_option("--links", options->links, "link counts")->capture_default_str();
  command
      ->add_option("--space", options->space,
                   "plane; or 3d, which is compared in vertical planes\n"
                   "with the plane's closed form, too")
      ->check(CLI::IsMember({"plane", "3d"}))
      ->capture_default_str();
  command->footer("Exit status 1 if one differs.\nExample: catena verify --links 2 3 4 12 60");
  command->callback([options, &status] {
    for (const int n : options->links) {
      if (n < 1 || n > kMostLinks)
        throw InputError("--links " + std::to_string(n) + ": must be from 1 to " +
                         std::to_string(kMostLinks));
      bool equal;
      if (options->space == "plane") {
        equal = verify(n, "", prove_closed_form);
      } else {
        equal = verify(n, ", closed form", prove_space_closed_form);
        equal = verify(n, ", in a plane", prove_plane_in_space) && equal;
      }
      if (!equal) status = 1;
    }
  });
}

}  // namespace catena
