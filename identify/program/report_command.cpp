// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/report_command.hpp"

#include <fmt/format.h>

#include <iostream>

#include "identify/program/command.hpp"
#include "identify/report/report.hpp"

namespace catena {
namespace {

struct ReportOptions {
  std::filesystem::path result;
  report::ReportFiles files;
  bool json = false;
  bool quiet = false;
};

/// Beside the result: "swing/result.json" and "swing" give "swing/report.html".
std::filesystem::path beside(const std::filesystem::path& result) {
  return (std::filesystem::is_directory(result) ? result : result.parent_path()) / "report.html";
}

int write(ReportOptions options) {
  const report::Document document = report::read_document(options.result);
  if (options.files.html.empty() && options.files.csv.empty() && !options.json) {
    options.files.html = beside(options.result);
  }
  const report::Written written = report::write_report(document, options.files);
  if (options.json) {
    std::cout << report::report_json(document);
    return kExitSuccess;
  }
  if (options.quiet) return kExitSuccess;
  if (!options.files.html.empty()) {
    std::cout << fmt::format("{}: {} figures, {:.1f} MB\n", options.files.html.string(),
                             written.figures, 1e-6 * static_cast<double>(written.html_bytes));
  }
  if (!options.files.csv.empty())
    std::cout << fmt::format("{}: {} figures\n", options.files.csv.string(), written.figures);
  return kExitSuccess;
}

}  // namespace

void add_report_command(CLI::App& program, int& exit_status) {
  static ReportOptions options;
  CLI::App* command = program.add_subcommand("report", "write an HTML report of a result");
  command->add_option("RESULT", options.result, "result.json, diagnosis.json or their folder")
      ->required();
  command->add_option("-o,--output", options.files.html,
                      "HTML file; default: report.html beside the result");
  command->add_option("--csv", options.files.csv,
                      "write the numbers of every figure into this folder");
  command->add_flag("--json", options.json, "print the data of all figures as JSON");
  command->add_flag("-q,--quiet", options.quiet, "print nothing");
  command->footer(
      "The HTML file needs nothing else: no network, no other file. With --csv or\n"
      "--json it is written only where --output is given.\n"
      "Pictures for papers: every chart of the page saves itself as SVG or PNG;\n"
      "catena report RESULT --json | catena-figures FOLDER draws all of them.\n"
      "Example:\n  catena report swing\n"
      "writes swing/report.html.");
  command->callback([&exit_status] { exit_status = write(options); });
}

}  // namespace catena
