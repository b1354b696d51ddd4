// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "common/input_error.hpp"
#include "common/manual.hpp"
#include "identify/models/process.hpp"
#include "identify/program/command.hpp"

namespace catena {
namespace {

const char* const kHandedOver[] = {"derive", "check", "certify"};

/// `catena derive ...` is `catena-derive derive ...`, as git hands over to git-foo.
void hand_over(int argc, char** argv) {
  if (argc < 2) return;
  for (const char* name : kHandedOver)
    if (std::string(argv[1]) == name) {
      std::vector<std::string> command = {find_derive_program().string()};
      command.insert(command.end(), argv + 1, argv + argc);
      become_process(command);
    }
}

int run(int argc, char** argv) {
  hand_over(argc, argv);
  int exit_status = kExitSuccess;
  CLI::App program("Models of a hanging cable: derived, simulated, identified, diagnosed.",
                   "catena");
  program.set_version_flag("--version", std::string(CATENA_VERSION));
  program.require_subcommand(1);
  program.get_formatter()->column_width(26);
  add_simulate_command(program, exit_status);
  add_identify_command(program, exit_status);
  add_report_command(program, exit_status);
  add_diagnose_command(program, exit_status);
  program.add_subcommand("derive", "derive models and emit their C++");
  program.add_subcommand("check", "check a derivation made by hand");
  program.add_subcommand("certify", "hold emitted models against their certificates");
  add_manual_command(program);
  program.footer("catena COMMAND --help tells more. Example:\n  catena identify cable.toml");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kExitSuccess : kExitUsage;
  }
  return exit_status;
}

}  // namespace
}  // namespace catena

int main(int argc, char** argv) {
  using namespace catena;
  int status = kExitFailed;
  try {
    return run(argc, argv);
  } catch (const InputError& error) {
    status = kExitUsage;
    std::cerr << "catena: " << error.what() << "\n";
  } catch (const std::invalid_argument& error) {
    status = kExitUsage;
    std::cerr << "catena: " << error.what() << "\n";
  } catch (const std::bad_alloc&) {
    std::cerr << "catena: not enough memory\n";
  } catch (const std::exception& error) {
    std::cerr << "catena: " << error.what() << "\n";
  }
  return status;
}
