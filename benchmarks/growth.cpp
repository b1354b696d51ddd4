// SPDX-License-Identifier: BSD-3-Clause
//
// Time per step as a function of the number of links of the same cable: 0.02 s from the smooth
// start at tolerance 1e-6; of models in space hinged at the support and in no plane, and 0.001 s
// beyond 2000 links, as 5000 take 117 000 steps for 0.02 s.
//
//   growth [--model N library.so]...  >  file.csv
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "benchmarks/table_6_1_cable.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/simulation.hpp"

int main(int argc, char** argv) {
  using catena::Model;
  std::map<int, Model> models;
  for (const int n : {12, 60}) models.emplace(n, Model::built_in(n));
  for (int i = 1; i + 2 < argc; i += 3)
    models.insert_or_assign(std::stoi(argv[i + 1]), Model::load(argv[i + 2]));

  struct Row {
    int links;
    long steps;
    std::vector<double> seconds;
  };
  std::vector<Row> rows;
  for (const auto& entry : models) rows.push_back({entry.first, 0, {}});
  for (int repetition = 0; repetition < 5; ++repetition)
    for (Row& row : rows) {
      const Model& model = models.at(row.links);
      const catena::benchmark::Cable cable(row.links);
      catena::SimulationOptions options;
      options.relative_tolerance = 1e-6;
      options.absolute_tolerance_position = 1e-8;
      options.absolute_tolerance_velocity = 1e-7;
      options.energy = false;
      const int n = row.links;
      const bool in_space = model.in_space();
      const auto run = catena::simulate(
          model, in_space ? cable.hinged(model) : cable.parameters(model, 0.6),
          in_space ? catena::from_directions(
                         model, {cable.start(), Eigen::VectorXd::LinSpaced(n, 0, 0.5),
                                 Eigen::VectorXd::Zero(n), Eigen::VectorXd::Constant(n, 0.8)})
                   : catena::from_angles(model, cable.start()),
          {0.0, in_space && n > 2000 ? 0.001 : 0.02}, options);
      if (run.status != catena::Status::kSuccess) {
        std::fprintf(stderr, "%d links: %s\n", row.links, run.message.c_str());
        return 1;
      }
      row.steps = run.statistics.steps;
      row.seconds.push_back(run.statistics.cpu_seconds);
    }
  std::printf("links,steps,microseconds_per_step,fastest,slowest\n");
  // Exponent of the least-squares line through the logarithms, from 60 links.
  double count = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  for (Row& row : rows) {
    std::sort(row.seconds.begin(), row.seconds.end());
    const double scale = 1e6 / static_cast<double>(row.steps);
    const double median = scale * row.seconds[row.seconds.size() / 2];
    std::printf("%d,%ld,%.3f,%.3f,%.3f\n", row.links, row.steps, median,
                scale * row.seconds.front(), scale * row.seconds.back());
    if (row.links < 60) continue;
    const double x = std::log(row.links), y = std::log(median);
    count += 1, sum_x += x, sum_y += y, sum_xx += x * x, sum_xy += x * y;
  }
  if (count > 1)
    std::fprintf(stderr, "time per step grows as links to the power %.3f (from 60 links)\n",
                 (count * sum_xy - sum_x * sum_y) / (count * sum_xx - sum_x * sum_x));
  return 0;
}
