// SPDX-License-Identifier: BSD-3-Clause
#include "common/command_line.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>

#include "common/input_error.hpp"
#include "common/nearest_name.hpp"

namespace catena {
namespace {

// CLI::Range prints its largest double with 309 digits where a value is refused.
CLI::Validator number_that(bool (*is_right)(double), const std::string& rule,
                           const std::string& description) {
  return CLI::Validator(
      [is_right, rule](std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && is_right(value)) return "";
        return text + " is not a number " + rule;
      },
      description);
}

}  // namespace

void check_command_name(const CLI::App& program, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  const std::string word = argv[1];
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == word) return;
    if (!command->get_group().empty()) names.push_back(command->get_name());  // not a hidden one
  }
  throw InputError(word + " is not a command" + suggestion(word, names));
}

CLI::Validator positive_number() {
  return number_that([](double value) { return value > 0; }, "above 0", "POSITIVE");
}

CLI::Validator non_negative_number() {
  return number_that([](double value) { return value >= 0; }, "from 0 on", "NONNEGATIVE");
}

int status_after_output(const char* program, int status) {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout) return status;
  std::fprintf(stderr, "%s: standard output could not be written%s%s\n", program, errno ? ": " : "",
               errno ? std::strerror(errno) : "");
  return status == 0 ? 1 : status;
}

}  // namespace catena
