// SPDX-License-Identifier: BSD-3-Clause
//
// Simbody's CPodes in a process of its own: it contains an old copy of SUNDIALS, whose symbols
// conflict with those of the SUNDIALS that catena uses.
//
//   simbody_simulation REST_ANGLE ACCURACY  ->  CPU seconds, then the angles, one line per time
#include <cstdio>
#include <cstdlib>

#include "benchmarks/peer.hpp"

int main(int, char** argv) {
  const catena::benchmark::Cable cable(60);
  std::vector<double> times;
  for (int i = 0; i <= 30; ++i) times.push_back(0.1 * i);
  const auto solution =
      catena::benchmark::simulate_simbody(cable, std::atof(argv[1]), times, std::atof(argv[2]));
  std::printf("%.17g\n", solution.cpu_seconds);
  for (const double angle : solution.q.reshaped()) std::printf("%.17g\n", angle);
  return 0;
}
