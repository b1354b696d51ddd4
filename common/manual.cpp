// SPDX-License-Identifier: BSD-3-Clause
#include "common/manual.hpp"

#include <filesystem>
#include <memory>
#include <sstream>

#include "common/whole_file.hpp"

namespace catena {
namespace {

using Commands = std::vector<const CLI::App*>;
using ShownOptions = std::vector<const CLI::Option*>;

Commands commands_of(const CLI::App& program) {
  return program.get_subcommands(
      [](const CLI::App* command) { return !command->get_group().empty(); });
}

ShownOptions shown_options(const CLI::App& command) {
  return command.get_options(
      [](const CLI::Option* option) { return !option->get_group().empty(); });
}

/// Whether catena-derive does the work: there is nothing but --help.
bool handed_over(const CLI::App& command) { return shown_options(command).size() < 2; }

bool takes_value(const CLI::Option& option) { return option.get_items_expected_max() > 0; }

std::vector<std::string> flags_of(const CLI::Option& option) {
  std::vector<std::string> flags;
  for (const std::string& name : option.get_snames()) flags.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) flags.push_back("--" + name);
  return flags;
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
  return text;
}

/// Text for a manual page: no character is taken for a command of its language.
std::string roff(const std::string& text) {
  std::string out = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  out = replaced(out, "\n.", "\n\\&.");
  out = replaced(out, "\n'", "\n\\&'");
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

/// The first line of a footer says "Example:"; the lines after it are shown as they stand.
void write_footer(std::ostream& page, const std::string& footer) {
  if (!footer.empty()) page << ".PP\n.nf\n" << roff(footer) << "\n.fi\n";
}

void write_options(std::ostream& page, const CLI::App& command) {
  for (const CLI::Option* option : shown_options(command)) {
    if (option == command.get_help_ptr() && command.get_parent()) continue;  // said once is enough
    std::string names;
    for (const std::string& flag : flags_of(*option)) names += (names.empty() ? "" : ", ") + flag;
    if (names.empty()) names = option->get_name(true);
    page << ".TP\n\\fB" << roff(names) << "\\fR";
    if (takes_value(*option) && option->nonpositional())
      page << " \\fI" << roff(option->get_type_name()) << "\\fR";
    page << "\n" << roff(option->get_description());
    if (!option->get_default_str().empty())
      page << " (default: " << roff(option->get_default_str()) << ")";
    page << "\n";
  }
}

std::string manual_page(const CLI::App& program) {
  const std::string name = program.get_name();
  std::ostringstream page;
  page.exceptions(std::ios::badbit);  // where memory is refused
  page << ".TH " << roff(replaced(name, "\"", "")) << " 1 \"\" \"catena " << CATENA_VERSION
       << "\"\n"
       << ".SH NAME\n"
       << roff(name) << " \\- " << roff(program.get_description()) << "\n"
       << ".SH SYNOPSIS\n\\fB" << roff(name) << "\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n"
       << ".SH OPTIONS\n";
  write_options(page, program);
  write_footer(page, program.get_footer());
  page << ".SH COMMANDS\n";
  for (const CLI::App* command : commands_of(program)) {
    page << ".SS " << roff(name + " " + command->get_name()) << "\n"
         << roff(command->get_description()) << "\n";
    if (!handed_over(*command)) write_options(page, *command);
    write_footer(page, command->get_footer());
  }
  page << ".SH EXIT STATUS\n"
          "0 for success, 1 for a computation that failed, 2 for wrong usage or input (then "
          "nothing\n"
          "has been written), 130 after Ctrl\\-C.\n"
          ".SH ENVIRONMENT\n"
          ".TP\n\\fBCATENA_CACHE\\fR\n"
          "Folder of the models that were compiled on demand; otherwise catena in\n"
          "\\fBXDG_CACHE_HOME\\fR or ~/.cache.\n"
          ".TP\n\\fBCXX\\fR\nThe compiler for them; c++ otherwise.\n"
          ".SH SEE ALSO\n\\fBcatena\\fR(1), \\fBcatena\\-derive\\fR(1)\n";
  return page.str();
}

std::string function_name(const CLI::App& program) {
  return "_" + replaced(program.get_name(), "-", "_");
}

std::string bash_completion(const CLI::App& program) {
  std::ostringstream script;
  script.exceptions(std::ios::badbit);  // where memory is refused
  script << "# bash completion for " << program.get_name() << "\n"
         << function_name(program) << "() {\n"
         << "  local current=${COMP_WORDS[COMP_CWORD]} words=\n"
         << "  if ((COMP_CWORD == 1)); then\n    words=\"";
  for (const CLI::App* command : commands_of(program)) script << command->get_name() << " ";
  script << "--help\"\n    COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n    return\n  fi\n"
         << "  case ${COMP_WORDS[1]} in\n";
  for (const CLI::App* command : commands_of(program)) {
    script << "    " << command->get_name() << ") ";
    if (handed_over(*command)) {
      script << "declare -F _catena_derive >/dev/null || source "
                "\"${BASH_SOURCE[0]%/*}/catena-derive\"; _catena_derive; return ;;\n";
      continue;
    }
    script << "words=\"";
    for (const CLI::Option* option : shown_options(*command))
      for (const std::string& flag : flags_of(*option)) script << flag << " ";
    script << "\" ;;\n";
  }
  script << "  esac\n"
         << "  case $current in\n"
         << "    -*) COMPREPLY=($(compgen -W \"$words\" -- \"$current\")) ;;\n"
         << "    *) COMPREPLY=($(compgen -f -- \"$current\")) ;;\n"
         << "  esac\n}\n"
         << "complete -o filenames -F " << function_name(program) << " " << program.get_name()
         << "\n";
  return script.str();
}

/// Inside single quotes of the shell, with what _arguments takes for itself escaped.
std::string zsh(const std::string& text) {
  std::string out = replaced(text, "'", "'\\''");
  for (const char* special : {"[", "]", ":"})
    out = replaced(out, special, std::string("\\") + special);
  return replaced(out, "\n", " ");
}

std::string zsh_completion(const CLI::App& program) {
  std::ostringstream script;
  script.exceptions(std::ios::badbit);  // where memory is refused
  script << "#compdef " << program.get_name() << "\n"
         << "local -a commands=(\n";
  for (const CLI::App* command : commands_of(program))
    script << "  '" << command->get_name() << ":" << zsh(command->get_description()) << "'\n";
  script << ")\n"
         << "if ((CURRENT == 2)); then\n  _describe command commands\n  return\nfi\n"
         << "case $words[2] in\n";
  for (const CLI::App* command : commands_of(program)) {
    script << "  " << command->get_name() << ")\n";
    if (handed_over(*command)) {
      script << "    _catena-derive\n    ;;\n";
      continue;
    }
    script << "    shift words\n    ((CURRENT--))\n    _arguments";
    for (const CLI::Option* option : shown_options(*command)) {
      for (const std::string& flag : flags_of(*option)) {
        script << " \\\n      '" << flag << "[" << zsh(option->get_description()) << "]";
        if (takes_value(*option)) script << ":" << zsh(option->get_type_name()) << ":_files";
        script << "'";
      }
    }
    script << " \\\n      '*:file:_files'\n    ;;\n";
  }
  script << "esac\n";
  return script.str();
}

}  // namespace

void add_manual_command(CLI::App& program) {
  auto folder = std::make_shared<std::filesystem::path>();
  CLI::App* command = program.add_subcommand("manual", "write the manual page and completions");
  command->group("");
  command->add_option("--output", *folder, "folder to write to")->required();
  command->callback([&program, folder] {
    make_folder(*folder);
    const std::string& name = program.get_name();
    write_whole_file(*folder / (name + ".1"), manual_page(program));
    write_whole_file(*folder / name, bash_completion(program));
    write_whole_file(*folder / ("_" + name), zsh_completion(program));
  });
}

}  // namespace catena
