// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/identify_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <thread>

#include "common/command_line.hpp"
#include "common/input_error.hpp"
#include "common/most_links.hpp"
#include "common/sha256.hpp"
#include "description/description.hpp"
#include "identify/cases/case_reader.hpp"
#include "identify/cases/case_words.hpp"
#include "identify/cases/case_writer.hpp"
#include "identify/fit/error.hpp"
#include "identify/fit/estimates.hpp"
#include "identify/fit/links_study.hpp"
#include "identify/fit/multi_start.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/program/command.hpp"
#include "identify/program/progress.hpp"
#include "identify/program/tables.hpp"
#include "identify/results/csv_tables.hpp"
#include "identify/results/fit_remarks.hpp"
#include "identify/results/result_writer.hpp"
#include "identify/uncertainty/bootstrap.hpp"
#include "identify/uncertainty/profile.hpp"

namespace catena {
namespace {

struct IdentifyOptions : CommonOptions {
  double time_limit = 0;
  bool resume = false;
  bool check = false;
  bool profiles = false;
  int bootstrap = 0;
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::vector<int> links_study;
  double error_budget = 0.05;
};

OutputFiles files_of(const Problem& problem, const Identification& found,
                     const std::filesystem::path& folder, const std::string& result) {
  OutputFiles files;
  for (int e = 0; e < static_cast<int>(problem.experiments().size()); ++e)
    add_motion_files(problem, e, found.motions[static_cast<std::size_t>(e)], files);
  files.emplace_back("residuals.csv", residuals_csv(problem, found.after));
  files.emplace_back("history.csv", history_csv(problem, found.fit));
  files.emplace_back("fitted.toml", case_text(problem.with(found.fit.x), folder));
  files.emplace_back("result.json", result);
  return files;
}

/// Everything that decides a run: the case, its numbers, the data, the model.
std::string run_key(const Problem& problem) {
  std::string all = case_text(problem.the_case(), problem.the_case().file.parent_path());
  all += problem.model().table().description_hash;
  const auto add = [&](const double* values, std::size_t count) {
    all.append(reinterpret_cast<const char*>(values), count * sizeof(double));
  };
  for (const Experiment& experiment : problem.experiments()) {
    add(experiment.recording.time.data(), experiment.recording.time.size());
    const Eigen::MatrixXd& measured = experiment.recording.measured;
    add(measured.data(), static_cast<std::size_t>(measured.size()));
  }
  return sha256_hex(all);
}

FitOptions fit_options_of(const IdentifyOptions& options, ProgressLine& line) {
  FitOptions fit_options;
  fit_options.time_limit = options.time_limit;
  fit_options.stop = &interrupted();
  fit_options.progress = [&line](const Progress& progress) {
    line.show(static_cast<double>(progress.evaluations) / progress.limit,
              fmt::format("evaluation {} of at most {}, error {:.6g}", progress.evaluations,
                          progress.limit, progress.error));
  };
  return fit_options;
}

/// What the data can determine, before any fit.
int check_case(const Problem& problem, const IdentifyOptions& options) {
  check_fittable(problem);
  double noise = 1;  // where the experiments state theirs, residuals are counted in it
  for (const Experiment& experiment : problem.experiments())
    if (std::isnan(experiment.spec.noise)) noise = 1e-3;
  const Uncertainty uncertainty = uncertainty_of(problem, problem.start(), noise);
  if (!options.quiet) {
    if (noise < 1)
      std::cout << "noise taken as 1 mm or 1 mrad (state it as `noise` in [[experiment]])\n";
    std::cout << identifiability_table(problem, uncertainty);
  }
  return kExitSuccess;
}

/// The refits of a profile, by experience: of the 16 that are possible, those within its interval.
constexpr double kRefitsOfProfile = 10;

/// The time of fits, profiles and bootstrap, from that of a simulation, which is put into `start`.
WorkEstimate estimate_of(const Problem& problem, const IdentifyOptions& options,
                         Evaluation& start) {
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const double threads = std::min(options.threads, cores);
  const double fit = simulations_of_a_fit(problem);
  const double fits = fit * std::ceil(problem.the_case().optimiser.starts / threads);
  double rounds_of_refits = std::ceil(options.bootstrap / threads);
  if (options.profiles)
    rounds_of_refits +=
        kRefitsOfProfile * std::ceil(static_cast<double>(problem.unknowns().size()) / threads);
  const double refits = kShareOfRefit * fit * rounds_of_refits;
  return estimate_of(
      problem,
      [&](double simulation) {
        const double of_fits = simulation * fits;
        return simulation * refits +
               (options.time_limit > 0 ? std::min(of_fits, options.time_limit) : of_fits);
      },
      options.yes, [] { return interrupted().load(); }, start);
}

int study_links(const Case& the_case, const IdentifyOptions& options) {
  WorkEstimate whole;
  IdentifyOptions single = options;  // a study takes one fit for each number of links
  single.bootstrap = 0;
  single.profiles = false;
  for (const int links : options.links_study) {
    Case other = with_links(the_case, links);
    other.optimiser.starts = 1;
    Evaluation start;
    const WorkEstimate one = estimate_of(Problem(other, model_of(other, options)), single, start);
    whole.seconds += one.seconds;
    whole.or_more = whole.or_more || one.or_more;
    require_yes(options.yes, fmt::format("--links-study up to {} links", links), whole);
  }
  OutputFolder output(output_folder(options), {"links_study.json"});
  std::vector<LinksResult> results;
  {
    ProgressLine line(!options.quiet);
    results = links_study(
        the_case, options.links_study, [&](const Case& other) { return model_of(other, options); },
        fit_options_of(options, line), fit_least_squares);
  }
  const std::string text = links_study_result_text(the_case, results);
  write_output(output, {{"links_study.json", text}});
  if (options.json) std::cout << text;
  if (!options.quiet && !options.json)
    std::cout
        << links_table(results)
        << fmt::format("fewest links within {:.3g} % of the least error: {}\n",
                       100 * options.error_budget, recommended_links(results, options.error_budget))
        << (more_links_are_worse(results, options.error_budget)
                ? "more links leave a larger error: the model lacks something else, so this does "
                  "not say how many are enough; catena diagnose\n"
                : "")
        << "written to " << output_folder(options).string() << "\n";
  return interrupted() ? kExitInterrupted : kExitSuccess;
}

/// Before and after, motions and errors of what was found.
void complete(const Problem& problem, const IdentifyOptions& options, Identification& found) {
  found.after = evaluate(problem, found.fit.x, true, false);
  for (int e = 0; e < static_cast<int>(problem.experiments().size()); ++e)
    found.motions.push_back(motion_of(problem, found.fit.x, e));
  try {
    found.uncertainty = uncertainty_of(problem, found.fit.x);
  } catch (const std::runtime_error&) {
    return;  // sensitivities that fail leave the estimates without errors
  }
  if (options.profiles && !interrupted())
    found.profiles = profiles_of(problem, found.fit, *found.uncertainty, fit_least_squares,
                                 options.threads, &interrupted());
  if (options.bootstrap > 0 && !interrupted())
    found.bootstrap =
        bootstrap(problem, found.fit, *found.uncertainty, fit_least_squares, options.bootstrap,
                  problem.the_case().optimiser.seed, options.threads, &interrupted());
}

/// How well joined windows meet: nothing to say where none are joined.
std::string largest_joint_gap(const Problem& problem, const Evaluation& evaluation) {
  const SoftConstraints defects = shooting_defects_of(problem, evaluation);
  const Eigen::Index n = problem.model().coordinates();
  double angle = 0, rate = 0;
  for (Eigen::Index i = 0; i < defects.value.size(); ++i)
    (i % (2 * n) < n ? angle : rate) =
        std::max(i % (2 * n) < n ? angle : rate, std::abs(defects.value[i]));
  if (defects.value.size() == 0) return "";
  return fmt::format("; the largest of {} gaps between windows is {:.2g} rad and {:.2g} rad/s",
                     defects.value.size() / (2 * n), angle, rate);
}

/// What the end of the fit says, a line for an experiment.
std::string remark_lines(const Problem& problem, const Evaluation& evaluation) {
  std::string out;
  const std::vector<std::string> remarks = remarks_on_fit(problem, evaluation);
  for (std::size_t e = 0; e < remarks.size(); ++e)
    if (!remarks[e].empty()) out += problem.experiments()[e].spec.name + ": " + remarks[e] + "\n";
  return out;
}

int identify_case(const IdentifyOptions& options) {
  Case the_case = read_case(options.case_file);
  watch_for_interruption();
  if (!options.links_study.empty()) return study_links(the_case, options);
  const Model model = model_of(the_case, options);
  const Problem problem(std::move(the_case), model);
  show_warnings(problem, options);
  if (options.check) return check_case(problem, options);
  check_fittable(problem);

  std::vector<std::string> names = motion_file_names(problem);
  names.insert(names.end(), {"residuals.csv", "history.csv", "fitted.toml", "result.json"});
  Identification found;
  require_yes(options.yes, "the identification", estimate_of(problem, options, found.before));
  OutputFolder output(output_folder(options), names);
  {
    ProgressLine line(!options.quiet);
    RunLog log(output.path() / "run.log", run_key(problem), options.resume,
               [&line](const std::string& text) {
                 line.clear();
                 std::cerr << "catena: " << text << "\n";
               });
    found.starts = fit_from_many(problem, fit_options_of(options, line), fit_least_squares,
                                 options.threads, &log);
  }
  found.fit = found.starts[best_of(found.starts)];
  if (found.fit.status == FitStatus::kFailed) throw std::runtime_error(found.fit.message);
  if (!std::isfinite(found.fit.error)) {
    if (interrupted()) return report_interruption("no simulation was finished");
    throw std::runtime_error("no simulation was finished within --time-limit");
  }
  complete(problem, options, found);
  const std::string result = identification_result_text(problem, found);
  write_output(output, files_of(problem, found, output.path(), result));
  if (options.json) std::cout << result;
  if (!options.quiet && !options.json) {
    std::cout << parameter_table(problem, found.fit, found.uncertainty) << "\n"
              << gap_table(problem, &found.before, found.after) << "\n";
    if (found.starts.size() > 1) std::cout << waterfall(problem, found.starts);
    std::cout << profile_table(problem, found.profiles);
    if (const char* strategy = strategy_of(problem); strategy != std::string("whole"))
      std::cout << "taken in " << strategy << largest_joint_gap(problem, found.after) << "\n";
    std::cout << fmt::format(
                     "error ({}) {} before, {} after; {} evaluations, {} failed, {:.2f} s, {:.4f} "
                     "s of a core; {}\n",
                     kMeasureWords[static_cast<std::size_t>(problem.the_case().error.measure)],
                     measured_error(problem, found.starts.front().start_error),  // the case's own
                     measured_error(problem, found.fit.error), found.fit.evaluations,
                     found.fit.failures, found.fit.seconds, found.fit.cpu_seconds,
                     name_of(found.fit.status))
              << remark_lines(problem, found.after) << "written to "
              << output_folder(options).string() << "\n";
  }
  if (interrupted()) return report_interruption("the best so far was written");
  return kExitSuccess;
}

}  // namespace

void add_identify_command(CLI::App& program, int& exit_status) {
  static IdentifyOptions options;
  CLI::App* command =
      program.add_subcommand("identify", "fit the free parameters of a case file to its data");
  command->footer(
      "Example:\n  catena identify cable.toml --output fit\n"
      "writes fit/result.json, fitted.toml (the case with what was found),\n"
      "history.csv, residuals.csv, positions.csv, angles.csv, forces.csv,\nenergy.csv and "
      "run.log.\n"
      "Ctrl-C ends with the best so far.");
  add_common_options(*command, options, "_result");
  command->add_flag("--check", options.check, "only tell what the data can determine; no fit");
  command->add_flag("--profiles", options.profiles, "profile likelihood of every parameter");
  command
      ->add_option("--bootstrap", options.bootstrap,
                   "so many refits of resampled residuals; at most 100000")
      ->check(CLI::Range(0, kMostFits));
  command
      ->add_option("--links-study", options.links_study,
                   "refit with these numbers of links: 6,12,24")
      ->delimiter(',')
      ->check(CLI::Range(2, kMostLinks));
  command
      ->add_option("--error-budget", options.error_budget,
                   "so much above its least error will do; 0.05")
      ->check(non_negative_number());
  command->add_flag("--resume", options.resume, "go on where a run that was killed stopped");
  command
      ->add_option("--time-limit", options.time_limit,
                   "stop after so many seconds, with the best so far")
      ->check(positive_number());
  command
      ->add_option("--threads", options.threads, "threads; all cores. Results do not depend on it")
      ->check(CLI::Range(1, kMostThreads));
  command->callback([&exit_status] { exit_status = identify_case(options); });
}

}  // namespace catena
