// SPDX-License-Identifier: BSD-3-Clause
//
// Error of sensitivities against CPU time, outside and inside of the error test: 3 s of the same
// cable from the smooth start, along two stiffnesses and two dampings. Error: root mean square over
// thirty times and all angles of the worst of the four, relative to its size. Reference: 1e-12.
//
//   sensitivity_accuracy  >  file.csv
#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include "benchmarks/table_6_1_cable.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"

int main() {
  using namespace catena;
  constexpr int kRepetitions = 5;
  std::printf("links,in_error_test,tolerance,steps,milliseconds,state_error,sensitivity_error\n");
  for (const int links : {12, 60}) {
    const Model model = Model::built_in(links);
    const benchmark::Cable cable(links);
    const Eigen::VectorXd parameters = cable.parameters(model, 0.6);
    std::vector<SensitivityDirection> directions;
    for (const char* name : {"stiffness_1", "stiffness_2", "damping_1", "damping_2"})
      directions.push_back(SensitivityDirection::parameter(model, model.parameter_index(name)));
    std::vector<double> times;
    for (int i = 0; i <= 30; ++i) times.push_back(0.1 * i);
    const auto run = [&](double tolerance, bool in_error_test) {
      SimulationOptions options;
      options.relative_tolerance = tolerance;
      options.absolute_tolerance_position = 1e-2 * tolerance;
      options.absolute_tolerance_velocity = 1e-1 * tolerance;
      options.sensitivities_in_error_test = in_error_test;
      options.energy = false;
      auto result = simulate_with_sensitivities(
          model, parameters, from_angles(model, cable.start()), directions, times, options);
      if (result.status != Status::kSuccess) throw std::runtime_error(result.message);
      return result;
    };
    const auto difference = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& reference) {
      return (a - reference).norm() / reference.norm();
    };
    const SensitiveSimulation reference = run(1e-12, true);
    for (const bool in_error_test : {false, true})
      for (const double tolerance : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
        std::vector<double> seconds;
        SensitiveSimulation result;
        for (int repetition = 0; repetition < kRepetitions; ++repetition) {
          result = run(tolerance, in_error_test);
          seconds.push_back(result.statistics.cpu_seconds);
        }
        std::sort(seconds.begin(), seconds.end());
        double error = 0;
        for (std::size_t k = 0; k < directions.size(); ++k)
          error = std::max(error, difference(result.sensitivity[k].q, reference.sensitivity[k].q));
        std::printf("%d,%d,%g,%ld,%.3f,%.2e,%.2e\n", links, in_error_test, tolerance,
                    result.statistics.steps, 1e3 * seconds[kRepetitions / 2],
                    difference(result.trajectory.q, reference.trajectory.q), error);
      }
  }
  return 0;
}
