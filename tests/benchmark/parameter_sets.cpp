// SPDX-License-Identifier: BSD-3-Clause
//
// Forward dynamics of eight parameter sets at once, per set, against one call each; AVX2 where the
// processor has it. Results are compared bit for bit first.
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <vector>

#include "runtime/model.hpp"
#include "tests/benchmark/cable.hpp"

namespace catena::benchmark {
int eight_sets_avx2(int links, int parameters, const double* q, const double* v, const double* p,
                    double* a);
int eight_sets_baseline(int links, int parameters, const double* q, const double* v,
                        const double* p, double* a);
}  // namespace catena::benchmark

namespace {

/// Medians over blocks of 50 calls, ns.
double nanoseconds(const std::function<void()>& call) {
  const auto now = [] {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
  };
  std::vector<double> blocks;
  for (int block = 0; block < 200; ++block) {
    const double begin = now();
    for (int i = 0; i < 50; ++i) call();
    blocks.push_back((now() - begin) / 50);
  }
  std::nth_element(blocks.begin(), blocks.begin() + 100, blocks.end());
  return blocks[100];
}

}  // namespace

int main() {
  namespace b = catena::benchmark;
  const bool avx2 = __builtin_cpu_supports("avx2") != 0;
  std::printf("links,one_ns,eight_baseline_ns_per_set,eight_avx2_ns_per_set\n");
  for (const int n : {2, 3, 4, 12, 60}) {
    const auto model = catena::Model::built_in(n);
    const b::Cable cable(n);
    std::vector<Eigen::VectorXd> q, v, p;
    struct alignas(32) Four {
      double set[4];
    };
    const auto packed = [](const std::vector<Eigen::VectorXd>& sets) {
      const auto size = static_cast<std::size_t>(sets[0].size());
      std::vector<Four> all(2 * size);
      for (std::size_t k = 0; k < 8; ++k)
        for (std::size_t i = 0; i < size; ++i)
          all[k / 4 * size + i].set[k % 4] = sets[k][static_cast<Eigen::Index>(i)];
      return all;
    };
    for (int k = 0; k < 8; ++k) {
      q.push_back(cable.start() * (1.0 + 0.1 * k));
      v.push_back(cable.start() * (0.1 * k));
      p.push_back(cable.parameters(model) * (1.0 + 0.01 * k));
    }
    const auto all_q = packed(q), all_v = packed(v), all_p = packed(p);
    std::vector<Four> all_a(static_cast<std::size_t>(2 * n));
    Eigen::VectorXd a(n);
    const auto one = [&](std::size_t k) {
      const catena_point at{0.0, q[k].data(), v[k].data(), nullptr, nullptr, nullptr, p[k].data()};
      model.table().acceleration(&at, a.data());
    };
    const auto eight = [&](auto function) {
      return [&, function] {
        if (function(n, model.parameters(), all_q[0].set, all_v[0].set, all_p[0].set,
                     all_a[0].set) != 0)
          std::abort();
      };
    };
    const auto same_bits = [&] {
      for (std::size_t k = 0; k < 8; ++k) {
        one(k);
        for (int i = 0; i < n; ++i)
          if (std::memcmp(&a[i], &all_a[k / 4 * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)].set[k % 4], sizeof(double)) != 0)
            return false;
      }
      return true;
    };
    eight(b::eight_sets_baseline)();
    bool same = same_bits();
    if (avx2) {
      eight(b::eight_sets_avx2)();
      same = same && same_bits();
    }
    if (!same) {
      std::fprintf(stderr, "%d links: eight sets at once differ from one at a time\n", n);
      return 1;
    }
    std::printf("%d,%.1f,%.1f,", n, nanoseconds([&] { one(0); }),
                nanoseconds(eight(b::eight_sets_baseline)) / 8);
    avx2 ? std::printf("%.1f\n", nanoseconds(eight(b::eight_sets_avx2)) / 8)
         : std::printf("not measured\n");
  }
  return 0;
}
