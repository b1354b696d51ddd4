// SPDX-License-Identifier: BSD-3-Clause
//
// Time of a simulation with derivatives by 0 to 16 parameters: 3 s of the same cable from the
// smooth start at tolerance 1e-6.
//
//   sensitivities  >  file.csv
#include <algorithm>
#include <cstdio>
#include <vector>

#include "benchmarks/table_6_1_cable.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"

int main() {
  using catena::Model;
  constexpr int kRepetitions = 9;
  std::printf("links,parameters,steps,milliseconds,fastest,slowest,times_without\n");
  for (const int links : {12, 60}) {
    const Model model = Model::built_in(links);
    const catena::benchmark::Cable cable(links);
    const Eigen::VectorXd parameters = cable.parameters(model, 0.6);
    const catena::State start = catena::from_angles(model, cable.start());
    catena::SimulationOptions options;
    options.relative_tolerance = 1e-6;
    options.absolute_tolerance_position = 1e-8;
    options.absolute_tolerance_velocity = 1e-7;
    options.energy = false;
    const std::vector<int> counts = {0, 1, 4, 8, 16};
    std::vector<std::vector<double>> seconds(counts.size());
    std::vector<long> steps(counts.size());
    for (int repetition = 0; repetition < kRepetitions; ++repetition)
      for (std::size_t k = 0; k < counts.size(); ++k) {
        std::vector<catena::SensitivityDirection> directions;  // the first stiffnesses
        for (int i = 0; i < counts[k]; ++i)
          directions.push_back(catena::SensitivityDirection::parameter(model, 3 * links + i));
        const auto run = catena::simulate_with_sensitivities(model, parameters, start, directions,
                                                             {0.0, 3.0}, options);
        if (run.status != catena::Status::kSuccess) {
          std::fprintf(stderr, "%d links: %s\n", links, run.message.c_str());
          return 1;
        }
        seconds[k].push_back(run.statistics.cpu_seconds);
        steps[k] = run.statistics.steps;
      }
    double without = 0;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      std::sort(seconds[k].begin(), seconds[k].end());
      const double median = seconds[k][kRepetitions / 2];
      if (counts[k] == 0) without = median;
      std::printf("%d,%d,%ld,%.3f,%.3f,%.3f,%.2f\n", links, counts[k], steps[k], 1e3 * median,
                  1e3 * seconds[k].front(), 1e3 * seconds[k].back(), median / without);
    }
  }
  return 0;
}
