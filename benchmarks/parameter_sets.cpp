// SPDX-License-Identifier: BSD-3-Clause
//
// Forward dynamics of eight parameter sets at once, per set, against one call each: as BatchDynamics
// has it on this processor, with states put in before and accelerations taken out after each
// evaluation or without, and the emitted text for each kind of processor that this one can be.
// Results are compared bit for bit first.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <vector>

#include "benchmarks/interleaved.hpp"
#include "benchmarks/table_6_1_cable.hpp"
#include "generated/chain_12.hpp"
#include "generated/chain_2.hpp"
#include "generated/chain_3.hpp"
#include "generated/chain_4.hpp"
#include "generated/chain_60.hpp"
#include "runtime/batch_dynamics.hpp"
#include "runtime/state.hpp"

namespace {

using catena::Batch;
using catena::BatchDynamics;
using catena::Point;

struct Arrays {
  const double *q, *v, *p;
  double* a;
};

template <int sets>
inline int evaluate(int links, int parameters, const Arrays& arrays) {
  using Number = Batch<sets>;
  int failed = 0;
  for (int first = 0; first < BatchDynamics::kBatch; first += sets) {
    const auto group = [&](const double* of, int entries) {
      return reinterpret_cast<const Number*>(of + first * entries);
    };
    const Point<Number> at{
        Number(0), group(arrays.q, links),     group(arrays.v, links), nullptr, nullptr,
        nullptr,   group(arrays.p, parameters)};
    auto* a = reinterpret_cast<Number*>(arrays.a + first * links);
    switch (links) {
      case 2:
        failed += catena::chain_2::acceleration(at, a);
        break;
      case 3:
        failed += catena::chain_3::acceleration(at, a);
        break;
      case 4:
        failed += catena::chain_4::acceleration(at, a);
        break;
      case 12:
        failed += catena::chain_12::accelerations(at, a);
        break;
      default:
        failed += catena::chain_60::accelerations(at, a);
    }
  }
  return failed;
}

using Evaluate = int(int links, int parameters, const Arrays& arrays);
__attribute__((target("arch=x86-64-v3"), flatten)) int avx2(int links, int parameters,
                                                            const Arrays& arrays) {
  return evaluate<4>(links, parameters, arrays);
}
__attribute__((target("arch=x86-64-v4"), flatten)) int avx512(int links, int parameters,
                                                              const Arrays& arrays) {
  return evaluate<8>(links, parameters, arrays);
}

/// Arrays of all sets in the order that a function for `sets` at once reads.
class Packed {
 public:
  explicit Packed(int sets) : sets_(sets) {}

  int place(int set, int i, int entries) const {
    return set / sets_ * sets_ * entries + i * sets_ + set % sets_;
  }
  /// value(set, i) of `entries` numbers of each set.
  double* pack(int entries, const std::function<double(std::size_t, int)>& value) {
    arrays_.emplace_back(static_cast<std::size_t>(entries));
    double* to = reinterpret_cast<double*>(arrays_.back().data());
    for (int k = 0; k < BatchDynamics::kBatch; ++k)
      for (int i = 0; i < entries; ++i)
        to[place(k, i, entries)] = value(static_cast<std::size_t>(k), i);
    return to;
  }

 private:
  struct alignas(64) Block {
    double value[BatchDynamics::kBatch];
  };
  int sets_;
  std::vector<std::vector<Block>> arrays_;
};

}  // namespace

int main() {
  const std::vector<std::pair<int, Evaluate*>> processors{{4, avx2}, {8, avx512}};
  std::printf(
      "links,one_ns,batch_ns_per_set,with_states_ns_per_set,avx2_ns_per_set,"
      "avx512_ns_per_set\n");
  for (const int n : {2, 3, 4, 12, 60}) {
    const auto model = catena::Model::built_in(n);
    const catena::benchmark::Cable cable(n);
    BatchDynamics eight(model);
    std::vector<catena::State> states;
    std::vector<Eigen::VectorXd> parameters;
    for (int k = 0; k < BatchDynamics::kBatch; ++k) {
      catena::State state = catena::State::zero(model);
      state.q = cable.start() * (1.0 + 0.1 * k);
      state.v = cable.start() * (0.1 * k);
      states.push_back(state);
      parameters.push_back(cable.parameters(model) * (1.0 + 0.01 * k));
      eight.set_parameters(k, parameters.back());
      for (int i = 0; i < n; ++i) {
        eight.q(k, i) = state.q[i];
        eight.v(k, i) = state.v[i];
      }
    }
    Eigen::VectorXd a(n);
    Eigen::MatrixXd all(n, BatchDynamics::kBatch);
    const auto one = [&](std::size_t k) {
      const catena_point at{0.0,     states[k].q.data(),  states[k].v.data(), nullptr, nullptr,
                            nullptr, parameters[k].data()};
      if (model.acceleration(at, a.data()) != 0) std::abort();
    };
    const auto same = [&](int i, double together) {
      return std::memcmp(&a[i], &together, sizeof together) == 0;
    };
    const auto fail = [&](const char* what) {
      std::fprintf(stderr, "%d links: %s differs from one set at a time\n", n, what);
      return 1;
    };

    std::vector<std::function<void()>> calls;
    calls.push_back([&] {
      for (std::size_t k = 0; k < BatchDynamics::kBatch; ++k) one(k);
    });
    calls.push_back([&] {
      if (eight.evaluate(0.0) != 0) std::abort();
    });
    calls.push_back([&] {
      for (int k = 0; k < BatchDynamics::kBatch; ++k)
        for (int i = 0; i < n; ++i) {
          eight.q(k, i) = states[static_cast<std::size_t>(k)].q[i];
          eight.v(k, i) = states[static_cast<std::size_t>(k)].v[i];
        }
      if (eight.evaluate(0.0) != 0) std::abort();
      for (int k = 0; k < BatchDynamics::kBatch; ++k)
        for (int i = 0; i < n; ++i) all(i, k) = eight.acceleration(k, i);
    });
    calls[1]();
    for (std::size_t k = 0; k < BatchDynamics::kBatch; ++k) {
      one(k);
      for (int i = 0; i < n; ++i)
        if (!same(i, eight.acceleration(static_cast<int>(k), i))) return fail("BatchDynamics");
    }

    std::vector<Packed> kept;  // while they are measured
    for (const auto& [sets, function] : processors) {
      if (sets > catena::Model::built_in(2).table().batch) continue;
      Packed& arrays = kept.emplace_back(sets);
      const Arrays packed{
          arrays.pack(n, [&](std::size_t k, int i) { return states[k].q[i]; }),
          arrays.pack(n, [&](std::size_t k, int i) { return states[k].v[i]; }),
          arrays.pack(model.parameters(), [&](std::size_t k, int i) { return parameters[k][i]; }),
          arrays.pack(n, [](std::size_t, int) { return 0.0; })};
      calls.push_back([packed, function = function, n, size = model.parameters()] {
        if (function(n, size, packed) != 0) std::abort();
      });
      calls.back()();
      for (std::size_t k = 0; k < BatchDynamics::kBatch; ++k) {
        one(k);
        for (int i = 0; i < n; ++i)
          if (!same(i, packed.a[arrays.place(static_cast<int>(k), i, n)]))
            return fail("eight at once");
      }
    }
    std::printf("%d", n);
    for (const double time : catena::benchmark::nanoseconds(calls))
      std::printf(",%.1f", time / BatchDynamics::kBatch);
    for (std::size_t c = calls.size(); c < 5; ++c) std::printf(",not measured");
    std::printf("\n");
  }
  return 0;
}
