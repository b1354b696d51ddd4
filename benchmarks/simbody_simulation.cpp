// SPDX-License-Identifier: BSD-3-Clause
//
// Simbody's CPodes in a process of its own: it contains an old copy of SUNDIALS, whose symbols
// conflict with those of the SUNDIALS that catena uses.
//
//   simbody_simulation REST_ANGLE ACCURACY  ->  CPU seconds, then the angles, one line per time
//   simbody_simulation askew ACCURACY       ->  the same in space, with joints() instead of angles
#include <cstdio>
#include <cstdlib>
#include <string>

#include "benchmarks/spatial_peer.hpp"

int main(int, char** argv) {
  const catena::benchmark::Cable cable(60);
  std::vector<double> times;
  for (int i = 0; i <= 30; ++i) times.push_back(0.1 * i);
  const double accuracy = std::atof(argv[2]);
  const auto solution =
      std::string(argv[1]) == "askew"
          ? catena::benchmark::simulate_simbody_in_space(cable, times, accuracy)
          : catena::benchmark::simulate_simbody(cable, std::atof(argv[1]), times, accuracy);
  std::printf("%.17g\n", solution.cpu_seconds);
  for (const double number : solution.q.reshaped()) std::printf("%.17g\n", number);
  return 0;
}
