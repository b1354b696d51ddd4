// SPDX-License-Identifier: GPL-3.0-or-later
//
// catena-derive: the commands that need computer algebra. Exit status 0: success; 1: a computation
// failed or a difference was found; 2: wrong usage or input.
#include <cln/malloc.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "common/command_line.hpp"
#include "common/input_error.hpp"
#include "common/manual.hpp"
#include "generator/program/commands.hpp"

namespace {

int run(int argc, char** argv) {
  CLI::App app("Derives the equations of motion of hanging chains", "catena-derive");
  app.require_subcommand(1);
  app.get_formatter()->column_width(26);
  int status = 0;
  catena::add_derive_command(app, status);
  catena::add_certify_command(app, status);
  catena::add_check_command(app, status);
  catena::add_verify_command(app, status);
  catena::add_manual_command(app);
  try {
    catena::check_first_argument(app, argc, argv);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return catena::status_of(app, error);
  } catch (const catena::InputError& error) {
    std::fprintf(stderr, "catena-derive: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "catena-derive: %s\n", error.what());
    return 1;
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  // GiNaC does not restore its expressions when memory is refused, and reads them afterwards.
  catena::end_at_first_memory_shortage("catena-derive");
  cln::malloc_hook = [](std::size_t size) {
    void* const memory = std::malloc(size);
    if (!memory) catena::end_without_memory();
    return memory;
  };
  return catena::status_after_output("catena-derive", run(argc, argv));
}
