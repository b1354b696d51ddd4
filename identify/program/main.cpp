// SPDX-License-Identifier: BSD-3-Clause
#include <csignal>
#include <iostream>

#include "common/command_line.hpp"
#include "common/input_error.hpp"
#include "common/manual.hpp"
#include "common/whole_file.hpp"
#include "identify/models/process.hpp"
#include "identify/program/cache_command.hpp"
#include "identify/program/command.hpp"
#include "identify/program/diagnose_command.hpp"
#include "identify/program/identify_command.hpp"
#include "identify/program/new_command.hpp"
#include "identify/program/report_command.hpp"
#include "identify/program/simulate_command.hpp"

namespace catena {
namespace {

struct HandedOver {
  const char* name;
  const char* summary;
};

/// The commands of catena-derive, which needs GiNaC: `catena derive ...` becomes
/// `catena-derive derive ...`.
constexpr HandedOver kHandedOver[] = {
    {"derive", "derive models and emit their C++"},
    {"check", "check a derivation made by hand"},
    {"verify", "compare the derived plain chain with the closed forms"},
    {"certify", "compare emitted models with their certificates"},
};

void hand_over(int argc, char** argv) {
  if (argc < 2) return;
  for (const HandedOver& command : kHandedOver)
    if (std::string(argv[1]) == command.name) {
      std::vector<std::string> call = {find_derive_program().string()};
      call.insert(call.end(), argv + 1, argv + argc);
      become_process(call);
    }
}

int run(int argc, char** argv) {
  hand_over(argc, argv);
  const ReadOnce inputs;
  int exit_status = kExitSuccess;
  CLI::App program("Models of a hanging cable: derived, simulated, identified, diagnosed.",
                   "catena");
  program.set_version_flag("--version", std::string(CATENA_VERSION));
  program.require_subcommand(1);
  program.get_formatter()->column_width(26);
  add_new_command(program, exit_status);
  add_simulate_command(program, exit_status);
  add_identify_command(program, exit_status);
  add_report_command(program, exit_status);
  add_diagnose_command(program, exit_status);
  add_cache_command(program, exit_status);
  for (const HandedOver& command : kHandedOver)
    program.add_subcommand(command.name, command.summary);
  add_manual_command(program);
  program.footer("catena COMMAND --help tells more. Example:\n  catena identify cable.toml");
  check_first_argument(program, argc, argv);
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return status_of(program, error);
  }
  return exit_status;
}

}  // namespace
}  // namespace catena

int main(int argc, char** argv) {
  using namespace catena;
  int status = kExitFailed;
  signal(SIGXFSZ, SIG_IGN);  // beyond a limit, writing fails as on a full disk
  end_where_memory_is_short("catena");
  try {
    status = run(argc, argv);
  } catch (const InputError& error) {
    status = kExitUsage;
    std::cerr << "catena: " << error.what() << "\n";
  } catch (const std::invalid_argument& error) {
    status = kExitUsage;
    std::cerr << "catena: " << error.what() << "\n";
  } catch (const std::bad_alloc&) {
    std::cerr << "catena: not enough memory\n";
  } catch (const std::exception& error) {
    // Ctrl-C ends the programs that derive and compile a model, too.
    if (interrupted()) return report_interruption("no simulation was finished");
    std::cerr << "catena: " << error.what() << "\n";
  }
  return status_after_output("catena", status);
}
