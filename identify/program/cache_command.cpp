// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/cache_command.hpp"

#include <fmt/format.h>

#include <iostream>

#include "identify/models/model_cache.hpp"
#include "identify/program/command.hpp"

namespace catena {

void add_cache_command(CLI::App& program, int& exit_status) {
  static bool clear = false;
  CLI::App* command = program.add_subcommand("cache", "look at the compiled models that are kept");
  command->add_flag("--clear", clear, "remove all of them; they are made again when needed");
  command->footer(
      "The folder is $CATENA_CACHE, else $XDG_CACHE_HOME/catena, else ~/.cache/catena.\n"
      "Example:\n  catena cache --clear");
  command->callback([&exit_status] {
    const ModelCache cache(ModelCache::default_folder());
    if (clear) cache.clear();
    const ModelCache::Usage usage = cache.usage();
    std::cout << fmt::format("{}: {} models, {:.1f} of at most {:.0f} MB\n",
                             cache.folder().string(), usage.models,
                             1e-6 * static_cast<double>(usage.bytes),
                             1e-6 * static_cast<double>(ModelCache::kMostBytes));
    exit_status = kExitSuccess;
  });
}

}  // namespace catena
