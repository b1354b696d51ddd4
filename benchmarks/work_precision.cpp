// SPDX-License-Identifier: BSD-3-Clause
//
// 3 s of the 60-link cable from two starts, by several programs: error against CPU time.
//
//   work_precision [smooth|rough] [repetitions]  >  file.csv
//
// "smooth": the rest angle of joint 1 is its start angle. "rough": it is zero, as in the source;
// the moment in joint 1 then jumps and excites fast modes. Error: the largest difference of any
// angle at any of thirty times from a reference at tolerance 1e-13. Another reference at 1e-12
// estimates its error.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>

#include "benchmarks/cvode_dense.hpp"
#include "benchmarks/cvode_expert.hpp"
#include "benchmarks/peer.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/simulation.hpp"

namespace {

using catena::benchmark::Cable;
using catena::benchmark::Solution;

Solution simulate_catena(const Cable& cable, double rest_angle, const std::vector<double>& times,
                         double tolerance) {
  const auto model = catena::Model::built_in(cable.links);
  catena::SimulationOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance_position = 1e-2 * tolerance;
  options.absolute_tolerance_velocity = 1e-1 * tolerance;
  options.max_steps = 100'000'000;
  options.energy = false;
  const auto run = catena::simulate(model, cable.parameters(model, rest_angle),
                                    catena::from_angles(model, cable.start()), times, options);
  if (run.status != catena::Status::kSuccess) std::fprintf(stderr, "%s\n", run.message.c_str());
  return {run.statistics.cpu_seconds, run.trajectory.q};
}

/// By the program simbody_simulation beside this one.
Solution simulate_simbody(const std::string& folder, const Cable& cable, double rest_angle,
                          std::size_t times, double accuracy) {
  const std::string command = folder + "/simbody_simulation " + std::to_string(rest_angle) + " " +
                              (std::ostringstream() << accuracy).str();
  FILE* output = popen(command.c_str(), "r");
  Solution solution;
  solution.q.resize(cable.links, static_cast<Eigen::Index>(times));
  bool complete = std::fscanf(output, "%lf", &solution.cpu_seconds) == 1;
  for (double& angle : solution.q.reshaped())
    complete = complete && std::fscanf(output, "%lf", &angle) == 1;
  if (pclose(output) != 0 || !complete) throw std::runtime_error(command + " failed");
  return solution;
}

}  // namespace

int main(int argc, char** argv) {
  const bool rough = argc > 1 && std::string(argv[1]) == "rough";
  const int repetitions = argc > 2 ? std::stoi(argv[2]) : 5;
  const Cable cable(60);
  const std::string folder = std::filesystem::path(argv[0]).parent_path().string();
  const double rest_angle = rough ? 0.0 : 0.6;
  std::vector<double> times;
  for (int i = 0; i <= 30; ++i) times.push_back(0.1 * i);

  const Eigen::MatrixXd reference = simulate_catena(cable, rest_angle, times, 1e-13).q;
  const double uncertainty =
      (simulate_catena(cable, rest_angle, times, 1e-12).q - reference).cwiseAbs().maxCoeff();
  std::fprintf(stderr, "reference: two tolerances differ by %.1e rad\n", uncertainty);

  struct Row {
    std::string method;
    double setting;
    std::function<Solution()> run;
    std::vector<double> seconds;
    double error = 0.0;
  };
  std::vector<Row> rows;
  const auto add = [&](const char* method, const std::vector<double>& settings,
                       const std::function<Solution(double)>& run) {
    for (const double setting : settings)
      rows.push_back({method, setting, [=] { return run(setting); }, {}});
  };
  add("catena", {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10},
      [&](double x) { return simulate_catena(cable, rest_angle, times, x); });
  add("CVODE, dense", {1e-4, 1e-6, 1e-8}, [&](double x) {
    return catena::benchmark::simulate_cvode_dense(cable, rest_angle, times, x);
  });
  add("CVODE, expert's O(n) code", {1e-4, 1e-5, 1e-6, 1e-7, 1e-8}, [&](double x) {
    return catena::benchmark::simulate_cvode_expert(cable, rest_angle, times, x);
  });
  add("Simbody CPodes", {1e-4, 1e-6, 1e-8},
      [&](double x) { return simulate_simbody(folder, cable, rest_angle, times.size(), x); });
  add("MuJoCo implicit", {1e-4, 5e-5}, [&](double x) {
    return catena::benchmark::simulate_mujoco(cable, rest_angle, times, x, false);
  });
  add("MuJoCo RK4", {5e-5}, [&](double x) {
    return catena::benchmark::simulate_mujoco(cable, rest_angle, times, x, true);
  });

  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (Row& row : rows) {
      if (!row.seconds.empty() && row.seconds.front() > 2.0) continue;  // once is enough
      const Solution solution = row.run();
      row.seconds.push_back(solution.cpu_seconds);
      row.error = (solution.q - reference).cwiseAbs().maxCoeff();
      std::fprintf(stderr, "%-25s %-7g error %.2e rad  %.4f s\n", row.method.c_str(), row.setting,
                   row.error, solution.cpu_seconds);
    }
  std::printf("method,setting,error_rad,seconds,fastest,slowest\n");
  for (Row& row : rows) {
    std::sort(row.seconds.begin(), row.seconds.end());
    std::printf("\"%s\",%g,%.3e,%.4f,%.4f,%.4f\n", row.method.c_str(), row.setting, row.error,
                row.seconds[row.seconds.size() / 2], row.seconds.front(), row.seconds.back());
  }
  return 0;
}
