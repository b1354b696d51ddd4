// SPDX-License-Identifier: BSD-3-Clause
#include "common/command_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <iostream>
#include <new>
#include <string_view>

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

/// "--output", "--quiet", ...
std::vector<std::string> names_of_options(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

const char* ending_program;
std::terminate_handler usual_end;
std::atomic<bool> memory_was_short = false;

}  // namespace

void end_where_memory_is_short(const char* program) {
  ending_program = program;
  std::set_new_handler([] {
    memory_was_short = true;
    throw std::bad_alloc();
  });
  usual_end = std::set_terminate([] {
    if (!memory_was_short) usual_end();
    end_without_memory();
  });
}

void end_at_first_memory_shortage(const char* program) {
  ending_program = program;
  std::set_new_handler(end_without_memory);
}

void end_without_memory() {
  constexpr std::string_view kWords = ": not enough memory\n";
  [[maybe_unused]] const bool said =
      write(STDERR_FILENO, ending_program, std::strlen(ending_program)) >= 0 &&
      write(STDERR_FILENO, kWords.data(), kWords.size()) >= 0;
  std::_Exit(1);
}

int status_of(const CLI::App& program, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) return program.exit(error);
  const CLI::App* command = &program;
  std::string name = program.get_name(), text = error.what();
  while (!command->get_subcommands().empty()) {
    command = command->get_subcommands().front();
    name += " " + command->get_name();
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const std::vector<std::string> words = command->remaining();
    const auto option = std::find_if(words.begin(), words.end(),
                                     [](const std::string& word) { return word[0] == '-'; });
    if (option != words.end())
      text = *option + " is not an option" + suggestion(*option, names_of_options(*command));
    else if (!words.empty())
      text = words.front() + " is one argument too many";
  } else if (command == &program) {
    text = "a command is wanted";
  }
  std::cerr << name << ": " << text << "\n" << name << " --help tells more\n";
  return 2;
}

void check_first_argument(const CLI::App& program, int argc, const char* const* argv) {
  if (argc < 2) return;
  const std::string word = argv[1];
  if (word.starts_with("--")) {
    const std::vector<std::string> options = names_of_options(program);
    if (std::find(options.begin(), options.end(), word) == options.end())
      throw InputError(word + " is not an option" + suggestion(word, options));
  }
  if (word.starts_with("-")) return;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == word) return;
    if (!command->get_group().empty()) names.push_back(command->get_name());  // not a hidden one
  }
  throw InputError(word + " is not a command" + suggestion(word, names));
}

void add_yes_option(CLI::App& command, bool& yes) {
  command.add_flag("-y,--yes", yes, "go on where more than 10 min or 4 GB are needed");
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
