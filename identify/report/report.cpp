// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/report.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "common/input_error.hpp"
#include "common/whole_file.hpp"
#include "identify/report/figure.hpp"
#include "identify/report/page.hpp"
#include "identify/report/payload.hpp"
#include "identify/report/report_figures.hpp"
#include "identify/results/output_folder.hpp"

namespace catena::report {
namespace {

std::string parameters_csv(const Result& result) {
  std::string text =
      "name,value,unit,free,standard_error,low_95,high_95,start,lower,upper,verdict,sets\n";
  for (const Parameter& p : result.parameters) {
    const auto end = [&](double Interval::*at) {
      return p.interval ? csv_field((*p.interval).*at) : "";
    };
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(p.name), csv_field(p.value),
                    csv_field(p.unit), p.free, csv_field(p.standard_error), end(&Interval::low),
                    end(&Interval::high), csv_field(p.start), csv_field(p.lower),
                    csv_field(p.upper), csv_field(p.verdict), csv_field(p.sets));
  }
  return text;
}

constexpr const char* kParameters = "parameters.csv";

/// Refuses the folder of a result: both have an energy.csv.
void require_no_result(const std::filesystem::path& folder) {
  std::error_code error;  // said where the folder is made
  for (const char* name : {"result.json", "diagnosis.json", "links_study.json"})
    if (std::filesystem::exists(folder / name, error))
      throw InputError(fmt::format(
          "--csv: {} holds {}, beside which files of the same names are; give another folder",
          folder.string(), name));
}

/// A file in the page's place is replaced only if it is such a page, or empty.
void require_report(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error) || std::filesystem::is_empty(file, error))
    return;
  std::string beginning(std::size_t{1} << 12, '\0');
  std::ifstream(file, std::ios::binary)
      .read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  if (beginning.find("catena report</title>") == std::string::npos)
    throw InputError(
        fmt::format("--output: {} is no report of catena, so it is not replaced; give another "
                    "name, or remove it",
                    file.string()));
}

/// The numbers of every figure, whole or not at all; files of others are not replaced.
void write_csv(const Document& document, const std::vector<ReportFigure>& figures,
               const std::filesystem::path& folder) {
  require_no_result(folder);
  const bool parameters = !document.result.parameters.empty();
  std::vector<std::string> names;
  for (const ReportFigure& entry : figures) names.push_back(entry.figure.id + ".csv");
  if (parameters) names.emplace_back(kParameters);
  OutputFolder(folder, names).publish([&](const std::filesystem::path& unfinished) {
    for (std::size_t i = 0; i < figures.size(); ++i)
      write_whole_file(unfinished / names[i], to_csv(figures[i].figure));
    if (parameters) write_whole_file(unfinished / kParameters, parameters_csv(document.result));
  });
}

}  // namespace

Written write_report(const Document& document, const ReportFiles& files) {
  if (!files.html.empty()) require_report(files.html);
  const std::vector<ReportFigure> figures = report_figures(document);
  Written written;
  written.figures = figures.size();
  if (!files.csv.empty()) write_csv(document, figures, files.csv);
  if (!files.html.empty()) {
    const std::string html = to_html(document, figures);
    written.html_bytes = html.size();
    if (files.html.has_parent_path()) make_folder(files.html.parent_path());
    write_whole_file(files.html, html);
  }
  return written;
}

std::string report_json(const Document& document) {
  return payload(document, report_figures(document), 0);
}

}  // namespace catena::report
