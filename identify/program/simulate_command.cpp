// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/simulate_command.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <iostream>

#include "common/large_work.hpp"
#include "identify/cases/case_reader.hpp"
#include "identify/program/command.hpp"
#include "identify/program/progress.hpp"
#include "identify/program/tables.hpp"
#include "identify/results/csv_tables.hpp"
#include "identify/results/result_writer.hpp"

namespace catena {
namespace {

/// The time that a simulation has come to, for whoever waits.
class Watch {
 public:
  Watch(const CommonOptions& options, double end)
      : end_(end), waiting_(!options.quiet, [this] { return text(); }) {}

  std::function<bool(double)> keep_going() {
    return [this](double time) {
      time_ = time;
      return !interrupted();
    };
  }

 private:
  std::string text() const {
    const double time = time_;
    return std::isnan(time) ? "simulating"
                            : fmt::format("simulating, at {:.3g} s of {:.4g} s", time, end_);
  }

  std::atomic<double> time_ = kNotGiven;
  double end_;
  Waiting waiting_;
};

/// Throws where the simulation failed; false where it was interrupted.
bool succeeded(const Simulation& simulation, const std::string& name) {
  if (simulation.status == Status::kInterrupted) return false;
  if (simulation.status != Status::kSuccess)
    throw std::runtime_error(name + ": " + simulation.message);
  return true;
}

/// Motion and files are in memory until they are written, whole.
WorkEstimate estimate_of(const Case& the_case) {
  constexpr double kBytes = 1100;  // an output and link: measured with 12 links, 50 000 outputs
  return {.bytes = kBytes * the_case.simulation.duration / the_case.simulation.step *
                   (the_case.links + 1)};
}

/// The case alone, for as long as it says.
int simulate_alone(const Problem& problem, const CommonOptions& options) {
  std::vector<std::string> names = motion_file_names(problem);
  names.emplace_back("result.json");
  require_yes(options.yes, "keeping the outputs of every simulation.step",
              estimate_of(problem.the_case()));
  OutputFolder output(output_folder(options), names);
  const Motion motion = [&] {
    Watch watch(options, problem.the_case().simulation.duration);
    return motion_alone(problem, problem.start(), watch.keep_going());
  }();
  if (!succeeded(motion.simulation, "simulation"))
    return report_interruption("nothing was written");
  OutputFiles files;
  const std::string result = simulation_result_text(problem, motion);
  files.emplace_back("result.json", result);
  add_motion_files(problem, -1, motion, files);
  write_output(output, files);
  std::cerr << energy_warning(motion.simulation);
  if (options.json) std::cout << result;
  if (!options.quiet && !options.json)
    std::cout << simulation_table(motion) << "written to " << output_folder(options).string()
              << "\n";
  return kExitSuccess;
}

/// Every experiment of the case, compared with what was measured.
int simulate_experiments(const Problem& problem, const CommonOptions& options) {
  const Eigen::VectorXd x = problem.start();
  std::vector<std::string> names = motion_file_names(problem);
  names.insert(names.end(), {"result.json", "residuals.csv"});
  OutputFolder output(output_folder(options), names);
  const Evaluation evaluation = [&] {
    const Waiting waiting(!options.quiet, [] { return std::string("comparing with the data"); });
    return evaluate(problem, x, true, false, [] { return !interrupted(); });
  }();
  if (interrupted()) return report_interruption("nothing was written");
  if (!evaluation.ok) throw std::runtime_error(evaluation.message);
  OutputFiles files;
  std::vector<Motion> motions;
  for (int e = 0; e < static_cast<int>(problem.experiments().size()); ++e) {
    const Experiment& experiment = problem.experiments()[static_cast<std::size_t>(e)];
    motions.push_back([&] {
      Watch watch(options, experiment.recording.time.back());
      return motion_of(problem, x, e, watch.keep_going());
    }());
    if (!succeeded(motions.back().simulation, experiment.spec.name))
      return report_interruption("nothing was written");
    std::cerr << energy_warning(motions.back().simulation);
    add_motion_files(problem, e, motions.back(), files);
  }
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
      "with data in the case also residuals.csv.");
  add_common_options(*command, options, "_simulation");
  command->callback([&exit_status] { exit_status = simulate_case(options); });
}

}  // namespace catena
