// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/simulate_command.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <iostream>

#include "identify/cases/case_reader.hpp"
#include "identify/fit/estimates.hpp"
#include "identify/program/command.hpp"
#include "identify/program/progress.hpp"
#include "identify/program/tables.hpp"
#include "identify/results/csv_tables.hpp"
#include "identify/results/result_writer.hpp"

namespace catena {
namespace {

/// The time that a simulation has come to, for whoever waits. Ends one that takes too long.
class Watch {
 public:
  /// `begin`, `end`: s, of the simulation; `before`: s of motion of those before it.
  Watch(const CommonOptions& options, Forecast& forecast, double begin, double end, double before)
      : forecast_(forecast),
        begin_(begin),
        end_(end),
        before_(before),
        waiting_(!options.quiet, [this] { return text(); }) {}

  std::function<bool(double)> keep_going() {
    return [this](double time) {
      time_ = time;
      return !interrupted() && forecast_.goes_on(before_ + time - begin_);
    };
  }

 private:
  std::string text() const {
    const double time = time_;
    return std::isnan(time) ? "simulating"
                            : fmt::format("simulating, at {:.3g} s of {:.4g} s", time, end_);
  }

  std::atomic<double> time_ = kNotGiven;
  Forecast& forecast_;
  double begin_, end_, before_;
  Waiting waiting_;
};

/// Throws where the simulation failed; false where it was interrupted.
bool succeeded(const Simulation& simulation, const std::string& name) {
  if (simulation.status == Status::kInterrupted) return false;
  if (simulation.status != Status::kSuccess)
    throw std::runtime_error(name + ": " + simulation.message);
  return true;
}

/// The case alone, for as long as it says.
int simulate_alone(const Problem& problem, const CommonOptions& options) {
  std::vector<std::string> names = motion_file_names(problem);
  names.emplace_back("result.json");
  require_yes(options.yes, "keeping the outputs of every simulation.step",
              {.bytes = memory_of_motions(problem)});
  OutputFolder output(output_folder(options), names);
  const double duration = problem.the_case().simulation.duration;
  Forecast forecast(options.yes, duration, 1);
  const Motion motion = [&] {
    Watch watch(options, forecast, 0, duration, 0);
    return motion_alone(problem, problem.start(), watch.keep_going());
  }();
  forecast.require_yes("the simulation");
  if (!succeeded(motion.simulation, "simulation"))
    return report_interruption("nothing was written");
  OutputFiles files;
  const std::string result = simulation_result_text(problem, motion);
  files.emplace_back("result.json", result);
  add_motion_files(problem, -1, motion, files);
  write_output(output, files);
  warn_of_energy(motion.simulation);
  if (options.json) std::cout << result;
  if (!options.quiet && !options.json)
    std::cout << simulation_table(motion) << "written to " << output_folder(options).string()
              << "\n";
  return kExitSuccess;
}

/// s, of the motion of an experiment.
double length_of(const Experiment& experiment) {
  return experiment.recording.time.back() - experiment.spec.start;
}

/// Every experiment of the case, compared with what was measured.
int simulate_experiments(const Problem& problem, const CommonOptions& options) {
  const Eigen::VectorXd x = problem.start();
  std::vector<std::string> names = motion_file_names(problem);
  names.insert(names.end(), {"result.json", "residuals.csv"});
  require_yes(options.yes, "keeping the motions", {.bytes = memory_of_motions(problem)});
  OutputFolder output(output_folder(options), names);
  double whole = 0, before = 0;  // s of motion
  for (const Experiment& experiment : problem.experiments()) whole += length_of(experiment);
  Forecast forecast(options.yes, whole, 2);  // once for the motions, once for the comparison
  OutputFiles files;
  std::vector<Motion> motions;
  for (int e = 0; e < static_cast<int>(problem.experiments().size()); ++e) {
    const Experiment& experiment = problem.experiments()[static_cast<std::size_t>(e)];
    motions.push_back([&] {
      Watch watch(options, forecast, experiment.spec.start, experiment.recording.time.back(),
                  before);
      return motion_of(problem, x, e, watch.keep_going());
    }());
    forecast.require_yes("the simulation");
    if (!succeeded(motions.back().simulation, experiment.spec.name))
      return report_interruption("nothing was written");
    warn_of_energy(motions.back().simulation);
    add_motion_files(problem, e, motions.back(), files);
    before += length_of(experiment);
  }
  const Evaluation evaluation = [&] {
    const Waiting waiting(!options.quiet, [] { return std::string("comparing with the data"); });
    return evaluate(problem, x, true, false, [](double) { return !interrupted(); });
  }();
  if (interrupted()) return report_interruption("nothing was written");
  if (!evaluation.ok) throw std::runtime_error(evaluation.message);
  const std::string result = comparison_result_text(problem, x, evaluation, motions);
  files.emplace_back("result.json", result);
  files.emplace_back("residuals.csv", residuals_csv(problem, evaluation));
  write_output(output, files);
  if (options.json) std::cout << result;
  if (!options.quiet && !options.json)
    std::cout << gap_table(problem, nullptr, evaluation) << "written to "
              << output_folder(options).string() << "\n";
  return kExitSuccess;
}

int simulate_case(const CommonOptions& options) {
  watch_for_interruption();
  Case the_case = read_case(options.case_file);
  const Model model = model_of(the_case, options);
  const Problem problem(std::move(the_case), model);
  show_warnings(problem, options);
  return problem.experiments().empty() ? simulate_alone(problem, options)
                                       : simulate_experiments(problem, options);
}

}  // namespace

void add_simulate_command(CLI::App& program, int& exit_status) {
  static CommonOptions options;
  CLI::App* command = program.add_subcommand("simulate", "simulate the cable of a case file");
  command->footer(
      "Example:\n  catena simulate cable.toml --output swing\n"
      "writes swing/result.json, positions.csv, angles.csv, forces.csv and energy.csv;\n"
      "with data in the case also residuals.csv, with events of the model events.csv.");
  add_common_options(*command, options, "_simulation");
  command->callback([&exit_status] { exit_status = simulate_case(options); });
}

}  // namespace catena
