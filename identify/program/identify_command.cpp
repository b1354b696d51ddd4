// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/identify_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <optional>
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
#include "identify/fit/estimated_noise.hpp"
#include "identify/fit/estimates.hpp"
#include "identify/fit/links_study.hpp"
#include "identify/fit/multi_start.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/program/command.hpp"
#include "identify/program/progress.hpp"
#include "identify/program/shards.hpp"
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
  RefitsAsked refits;
  std::string shard;   ///< "3/8"; empty: all of the work
  bool merge = false;  ///< of shards; nothing is fitted
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
  const double shards =
      options.shard.empty() ? 1 : static_cast<double>(named_shard(options.shard, "").of);
  const auto rounds = [&](double pieces) { return std::ceil(pieces / shards / threads); };
  const double fits = fit * rounds(problem.the_case().optimiser.starts);
  double rounds_of_refits = rounds(options.refits.bootstrap);
  if (options.refits.profiles)
    rounds_of_refits += kRefitsOfProfile * rounds(static_cast<double>(problem.unknowns().size()));
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
  single.refits = {};
  for (const int links : options.links_study) {
    Case other = case_for_links(the_case, links);
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

/// Errors of what was found, with the profiles and the bootstrap as far as the log or the shard has
/// them.
void find_errors(const Problem& problem, const IdentifyOptions& options, RunLog& log,
                 const Shard& shard, Identification& found) {
  try {
    found.uncertainty = uncertainty_of(problem, found.fit.x);
  } catch (const std::runtime_error&) {
    return;  // sensitivities that fail leave the estimates without errors
  }
  if (options.refits.profiles && !interrupted())
    found.profiles = profiles_of(problem, found.fit, *found.uncertainty, fit_least_squares,
                                 options.threads, &interrupted(), &log, shard);
  if (options.refits.bootstrap > 0 && !interrupted())
    found.bootstrap = bootstrap(problem, found.fit, *found.uncertainty, fit_least_squares,
                                options.refits.bootstrap, problem.the_case().optimiser.seed,
                                options.threads, &interrupted(), &log, shard);
}

/// How well joined windows meet: nothing to say where none are joined.
std::string largest_shooting_defect(const Problem& problem, const Evaluation& evaluation) {
  const SoftConstraints defects = shooting_defects_of(problem, evaluation);
  const Eigen::Index n = problem.model().coordinates();
  double angle = 0, rate = 0;
  for (Eigen::Index i = 0; i < defects.value.size(); ++i)
    (i % (2 * n) < n ? angle : rate) =
        std::max(i % (2 * n) < n ? angle : rate, std::abs(defects.value[i]));
  if (defects.value.size() == 0) return "";
  return fmt::format("; the largest of {} shooting defects is {:.2g} rad and {:.2g} rad/s",
                     defects.value.size() / (2 * n), angle, rate);
}

/// What the end of the fit says, a line for a recording.
std::string remark_lines(const Problem& problem, const Evaluation& evaluation) {
  std::string out;
  for (const FitRemark& remark : remarks_on_fit(problem, evaluation))
    out += fmt::format("{}: {}\n", remark.recording, remark.words);
  return out;
}

/// What is unusual of the noise that was estimated, a line each.
std::string noise_lines(const Problem& problem) {
  std::string out;
  for (const std::string& words : noise_in_words(problem)) out += "noise of " + words + "\n";
  return out;
}

WorkPart part_of(const IdentifyOptions& options) {
  const std::filesystem::path output = output_folder(options);
  if (options.merge) return merge_in(output);
  return options.shard.empty() ? WorkPart{{}, 0, output} : named_shard(options.shard, output);
}

/// The end of a shard's work; `done`: what there is of it.
int end_shard(const IdentifyOptions& options, const RunLog& log, const std::string& done) {
  if (log.failed())
    throw std::runtime_error("the shard is not finished; make room and run the shard again");
  if (interrupted()) return report_interruption("what was finished is kept; run the shard again");
  if (!options.quiet) std::cout << "shard " << options.shard << ": " << done << "\n";
  return kExitSuccess;
}

int identify_case(const IdentifyOptions& options) {
  Case the_case = read_case(options.case_file);
  watch_for_interruption();
  if (!options.links_study.empty()) return study_links(the_case, options);
  const Model model = model_of(the_case, options);
  auto asked = std::make_shared<const Problem>(std::move(the_case), model);
  show_warnings(*asked, options);
  if (options.check) return check_case(*asked, options);
  check_fittable(*asked);

  const WorkPart part = part_of(options);
  std::vector<std::string> names;
  if (!part.is_shard()) {
    names = motion_file_names(*asked);
    names.insert(names.end(), {"residuals.csv", "history.csv", "fitted.toml", "result.json"});
  }
  Identification found;
  const WorkEstimate estimate = estimate_of(*asked, options, found.before);
  if (!part.is_merge()) require_yes(options.yes, "the identification", estimate);
  OutputFolder output(part.folder(), names);
  std::optional<WorkFolder> scratch;  // the log of a merge holds nothing new
  if (part.is_merge()) scratch.emplace(temporary_folder(), "catena-merge-");
  ProgressLine line(!options.quiet);
  RunLog log((scratch ? scratch->path() : output.path()) / "run.log", run_key(*asked),
             static_cast<Eigen::Index>(asked->unknowns().size()), options.resume || part.is_shard(),
             [&line](const std::string& text) {
               line.clear();
               std::cerr << "catena: " << text << "\n";
             });
  take_over_others(log, part);
  const FitOptions fit_options = fit_options_of(options, line);
  found.starts = fit_from_many(*before_noise_is_known(asked), fit_options, fit_least_squares,
                               options.threads, &log, part.shard);
  for (std::size_t start = 0; start < found.starts.size(); ++start)
    if (found.starts[start].status == FitStatus::kNotRun) {
      if (part.is_merge()) throw start_is_missing(start, part);
      line.clear();
      return end_shard(options, log, "its starts are finished, not yet those of all others");
    }
  WeighedFit weighed =
      fit_with_noise(asked, found.starts[best_of(found.starts)], fit_options, fit_least_squares);
  asked = std::move(weighed.problem);
  found.fit = std::move(weighed.fit);
  line.clear();
  const Problem& problem = *asked;
  if (found.fit.status == FitStatus::kFailed) throw std::runtime_error(found.fit.message);
  if (!std::isfinite(found.fit.error)) {
    if (interrupted()) return report_interruption("no simulation was finished");
    throw std::runtime_error("no simulation was finished within --time-limit");
  }
  if (part.is_merge()) require_ends(log, part, found.fit, options.refits);
  find_errors(problem, options, log, part.shard, found);
  if (part.is_shard()) {
    if (!interrupted()) note_end(log, part, found.fit, options.refits);
    return end_shard(options, log, "finished");
  }
  found.after = evaluate(problem, found.fit.x, true, false);
  for (int e = 0; e < static_cast<int>(problem.experiments().size()); ++e)
    found.motions.push_back(motion_of(problem, found.fit.x, e));
  const std::string result = identification_result_text(problem, found);
  write_output(output, files_of(problem, found, output.path(), result));
  for (const Motion& motion : found.motions) warn_of_energy(motion.simulation);
  if (options.json) std::cout << result;
  if (!options.quiet && !options.json) {
    std::cout << parameter_table(problem, found.fit, found.uncertainty) << "\n"
              << gap_table(problem, &found.before, found.after) << "\n";
    if (found.starts.size() > 1) std::cout << waterfall(problem, found.starts);
    std::cout << profile_table(problem, found.profiles);
    if (const char* strategy = strategy_of(problem); strategy != std::string("whole"))
      std::cout << "taken in " << strategy << largest_shooting_defect(problem, found.after) << "\n";
    std::cout << fmt::format(
                     "error ({}) {} before, {} after; {} evaluations, {} failed, {:.2f} s, {:.4f} "
                     "s of a core; {}\n",
                     kMeasureWords[static_cast<std::size_t>(problem.the_case().error.measure)],
                     measured_error(problem, error_of(problem, found.before, Part::kFit)),
                     measured_error(problem, found.fit.error), found.fit.evaluations,
                     found.fit.failures, found.fit.seconds, found.fit.cpu_seconds,
                     name_of(found.fit.status))
              << noise_lines(problem) << remark_lines(problem, found.after) << "written to "
              << output_folder(options).string() << "\n";
  }
  if (interrupted()) return report_interruption("the best so far was written");
  return kExitSuccess;
}

void add_refit_options(CLI::App& command, RefitsAsked& refits) {
  command.add_flag("--profiles", refits.profiles, "profile likelihood of every parameter");
  command
      .add_option("--bootstrap", refits.bootstrap,
                  "so many refits of resampled residuals; at most 100000")
      ->check(CLI::Range(0, kMostFits));
}

void add_merge_command(CLI::App& program, int& exit_status) {
  static IdentifyOptions options;
  options.merge = true;
  CLI::App* command = program.add_subcommand("merge", "put shards of an identification together");
  command->footer(
      "Example:\n  catena identify cable.toml --output fit --bootstrap 1000 --shard 1/2\n"
      "  catena identify cable.toml --output fit --bootstrap 1000 --shard 2/2\n"
      "  catena merge cable.toml --output fit --bootstrap 1000\n"
      "With several starts, run the shards twice: the first time they do the starts.");
  add_common_options(*command, options, "_result");
  add_refit_options(*command, options.refits);
  command->callback([&exit_status] { exit_status = identify_case(options); });
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
  add_refit_options(*command, options.refits);
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
  add_threads_option(*command, options.threads, "all cores");
  CLI::Option* shard = command->add_option("--shard", options.shard,
                                           "3/8: a part of starts, profiles and bootstrap");
  for (const char* other : {"--check", "--links-study", "--time-limit", "--json"})
    shard->excludes(other);
  command->callback([&exit_status] { exit_status = identify_case(options); });
  add_merge_command(program, exit_status);
}

}  // namespace catena
