// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cstdio>
#include <memory>
#include <vector>

#include "common/input_error.hpp"
#include "common/most_links.hpp"
#include "generator/derivation/closed_form_proof.hpp"
#include "generator/program/commands.hpp"

namespace catena {

void add_verify_command(CLI::App& app, int& status) {
  auto links = std::make_shared<std::vector<int>>(std::vector<int>{2, 3, 4, 12, 60});
  CLI::App* command =
      app.add_subcommand("verify", "Derive the plain chain, compare with closed forms");
  command->add_option("--links", *links, "link counts")->capture_default_str();
  command->footer("Exit status 1 if one differs.\nExample: catena verify --links 2 3 4 12 60");
  command->callback([links, &status] {
    for (const int n : *links) {
      if (n < 1 || n > kMostLinks)
        throw InputError("--links " + std::to_string(n) + ": must be from 1 to " +
                         std::to_string(kMostLinks));
      const auto start = std::chrono::steady_clock::now();
      const std::vector<Proof> proofs = prove_closed_form(n);
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
      std::printf("%3d links: ", n);
      for (const Proof& proof : proofs) {
        std::printf("%s %s, ", proof.what.c_str(), proof.equal ? "equal" : "DIFFERENT");
      }
      std::printf("%.2f s\n", elapsed.count());
      for (const Proof& proof : proofs) {
        if (proof.equal) continue;
        std::printf("  %s\n", proof.difference.c_str());
        status = 1;
      }
      std::fflush(stdout);
    }
  });
}

}  // namespace catena
