// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <time.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace catena::benchmark {

inline double now() {  // ns
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// Medians over interleaved blocks of calls, ns a call.
inline std::vector<double> nanoseconds(const std::vector<std::function<void()>>& calls) {
  constexpr int kBlocks = 201, kCalls = 50;
  std::vector<std::vector<double>> blocks(calls.size());
  for (int block = 0; block < kBlocks; ++block) {
    for (std::size_t c = 0; c < calls.size(); ++c) {
      calls[c]();
      const double begin = now();
      for (int i = 0; i < kCalls; ++i) calls[c]();
      blocks[c].push_back((now() - begin) / kCalls);
    }
  }
  std::vector<double> medians;
  for (auto& times : blocks) {
    std::nth_element(times.begin(), times.begin() + kBlocks / 2, times.end());
    medians.push_back(times[kBlocks / 2]);
  }
  return medians;
}

}  // namespace catena::benchmark
