// SPDX-License-Identifier: BSD-3-Clause
//
// catena::identify: the simplex method of Nelder and Mead on Himmelblau's function (5.4). The
// function has four equal minima. The start decides which of them is found; it is not always the
// nearest.
//
//   himmelblau [FILE]    every evaluation of the first search to FILE, for a plot
#include <cstdio>
#include <fstream>

#include "identify/fit/minimise.hpp"

namespace {

double himmelblau(double x, double y) {
  const double a = x * x + y - 11, b = x + y * y - 7;
  return a * a + b * b;
}

}  // namespace

int main(int argc, char** argv) {
  const Eigen::Vector2d starts[] = {{0, 0}, {-1, 1}, {-1, -1}, {3, -3}};
  std::ofstream history;
  if (argc > 1) {
    history.open(argv[1]);
    history.precision(17);
    history << "step,x,y,value\n";
  }
  for (const Eigen::Vector2d& start : starts) {
    int step = 0;
    const catena::Objective value = [&](const Eigen::VectorXd& at, Eigen::VectorXd*) {
      const double result = himmelblau(at[0], at[1]);
      ++step;
      if (history.is_open())
        history << step << ',' << at[0] << ',' << at[1] << ',' << result << '\n';
      return result;
    };
    catena::MinimiserOptions options;
    options.first_steps = Eigen::Vector2d(1, 1);
    options.x_tolerance = options.value_tolerance = 1e-12;
    const catena::Minimum found = catena::minimise(value, start, options);
    std::printf("from (%2.0f, %2.0f): f(%9.6f, %9.6f) = %.1e after %d evaluations\n", start[0],
                start[1], found.x[0], found.x[1], found.value, step);
    if (history.is_open()) {
      history.close();
      if (!history) {
        std::fprintf(stderr, "himmelblau: %s cannot be written\n", argv[1]);
        return 1;
      }
    }
  }
}
