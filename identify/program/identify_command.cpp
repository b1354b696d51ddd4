// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <iostream>

#include "generator/description/input_error.hpp"
#include "identify/case_words.hpp"
#include "identify/ceres/least_squares.hpp"
#include "identify/program/command.hpp"
#include "identify/program/progress.hpp"
#include "identify/program/tables.hpp"
#include "identify/result_writer.hpp"

namespace catena {
namespace {

struct IdentifyOptions : CommonOptions {
  double time_limit = 0;
};

OutputFiles files_of(const Problem& problem, const Identification& found,
                     const std::filesystem::path& folder, const std::string& result) {
  OutputFiles files;
  for (int e = 0; e < static_cast<int>(problem.experiments().size()); ++e) {
    const Motion& motion = found.motions[static_cast<std::size_t>(e)];
    files.emplace_back(file_name(problem, e, "positions"), positions_csv(motion));
    files.emplace_back(file_name(problem, e, "angles"), angles_csv(problem.model(), motion));
    files.emplace_back(file_name(problem, e, "energy"), energy_csv(problem.model(), motion));
  }
  files.emplace_back("residuals.csv", residuals_csv(problem, found.after));
  files.emplace_back("fitted.toml", case_text(problem.with(found.fit.x), folder));
  files.emplace_back("result.json", result);  // last: where it is, the rest is
  return files;
}

int identify_case(const IdentifyOptions& options) {
  Case study = read_case(options.case_file);
  const Model model = model_of(study, options);
  const Problem problem(std::move(study), model);
  watch_for_interruption();

  FitOptions fit_options;
  fit_options.time_limit = options.time_limit;
  fit_options.stop = &interrupted();
  ProgressLine line(!options.quiet);
  fit_options.progress = [&](const Progress& progress) {
    line.show(static_cast<double>(progress.evaluations) / progress.limit,
              fmt::format("evaluation {} of at most {}, error {:.6g}", progress.evaluations,
                          progress.limit, progress.error));
  };
  Identification found;
  found.fit = fit(problem, fit_options, fit_least_squares);
  if (found.fit.status == FitStatus::kFailed) throw std::runtime_error(found.fit.message);
  const bool stopped = found.fit.status == FitStatus::kInterrupted;
  if (!std::isfinite(found.fit.error)) {
    if (stopped) return kExitInterrupted;  // nothing was found yet
    throw std::runtime_error("no simulation was finished within --time-limit");
  }
  found.before = evaluate(problem, problem.start(), true, false);
  found.after = evaluate(problem, found.fit.x, true, false);
  for (int e = 0; e < static_cast<int>(problem.experiments().size()); ++e)
    found.motions.push_back(motion_of(problem, found.fit.x, e));
  const std::filesystem::path folder = output_folder(options);
  const std::string result = identification_result_text(problem, found);
  write_output(folder, files_of(problem, found, folder, result));
  if (options.json) std::cout << result;
  if (!options.quiet && !options.json) {
    std::cout << parameter_table(problem, found.fit) << "\n"
              << gap_table(problem, &found.before, found.after)
              << fmt::format("\nerror ({}) {} before, {} after; {} evaluations, {} failed, {:.1f} s; {}\n",
                             kMeasureWords[static_cast<std::size_t>(problem.study().error.measure)],
                             measured_error(problem, found.fit.start_error),
                             measured_error(problem, found.fit.error), found.fit.evaluations,
                             found.fit.failures, found.fit.seconds, name_of(found.fit.status))
              << "written to " << folder.string() << "\n";
  }
  return stopped ? kExitInterrupted : kExitSuccess;
}

}  // namespace

void add_identify_command(CLI::App& program, int& exit_status) {
  static IdentifyOptions options;
  CLI::App* command =
      program.add_subcommand("identify", "fit the free parameters of a case file to its data");
  command->footer("Example:\n  catena identify cable.toml --output fit\n"
                  "writes fit/result.json, fitted.toml (the case with what was found), residuals.csv,\n"
                  "positions.csv, angles.csv and energy.csv. Ctrl-C ends with the best so far.");
  add_common_options(*command, options);
  command->add_option("--time-limit", options.time_limit, "stop after so many seconds, with the best so far")
      ->check(CLI::PositiveNumber);
  command->callback([&exit_status] { exit_status = identify_case(options); });
}

}  // namespace catena
