// SPDX-License-Identifier: BSD-3-Clause
//
// Several parameter sets and states in one call of the emitted text give, element by element, the bits of
// as many calls for one.
#include "generated/batch.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <vector>

#include "generated/chain_12.hpp"
#include "generated/chain_2.hpp"
#include "generated/chain_60.hpp"

namespace {

constexpr int kSets = 8;
using Eight = catena::Batch<kSets>;

struct Sets {
  explicit Sets(int n) : n(n) {
    std::mt19937 random(4);
    const auto fill = [&](int size, double low, double high) {
      std::uniform_real_distribution<double> uniform(low, high);
      std::vector<double> values(static_cast<std::size_t>(size));
      for (double& value : values) value = uniform(random);
      return values;
    };
    const auto append = [](std::vector<double>& to, const std::vector<double>& values) {
      to.insert(to.end(), values.begin(), values.end());
    };
    for (int k = 0; k < kSets; ++k) {
      q.push_back(fill(n, -7.0, 7.0));
      v.push_back(fill(n, -5.0, 5.0));
      a.push_back(fill(n, -5.0, 5.0));
      std::vector<double> set = fill(n, 0.1, 1.0);  // length
      append(set, fill(n, 0.01, 1.0));              // mass
      append(set, fill(n, 0.001, 0.1));             // inertia
      append(set, fill(n, 0.0, 300.0));             // stiffness
      append(set, fill(n, 0.0, 1.0));               // damping
      append(set, fill(n, -5.0, 5.0));              // torque
      append(set, {1.3, 9.81});
      p.push_back(set);
    }
  }

  static std::vector<Eight> pack(const std::vector<std::vector<double>>& sets) {
    std::vector<Eight> packed(sets[0].size());
    for (std::size_t i = 0; i < packed.size(); ++i)
      for (int k = 0; k < kSets; ++k) packed[i].set(k, sets[static_cast<std::size_t>(k)][i]);
    return packed;
  }

  int n;
  std::vector<std::vector<double>> q, v, a, p;
};

/// `together` and `alone` evaluate the same function for Eight and for double.
template <class Together, class Alone>
void check_bits(const Sets& sets, Together together, Alone alone) {
  const auto q = Sets::pack(sets.q), v = Sets::pack(sets.v), a = Sets::pack(sets.a),
             p = Sets::pack(sets.p);
  std::vector<Eight> result(static_cast<std::size_t>(sets.n));
  together(catena::Point<Eight>{Eight(0), q.data(), v.data(), a.data(), nullptr, nullptr, p.data()},
           result.data());
  for (std::size_t k = 0; k < kSets; ++k) {
    std::vector<double> one(static_cast<std::size_t>(sets.n));
    alone(catena::Point<double>{0.0, sets.q[k].data(), sets.v[k].data(), sets.a[k].data(), nullptr,
                                nullptr, sets.p[k].data()},
          one.data());
    for (std::size_t i = 0; i < one.size(); ++i) {
      CAPTURE(k);
      CAPTURE(i);
      const double element = result[i][static_cast<int>(k)];
      CHECK(std::memcmp(&element, &one[i], sizeof element) == 0);
    }
  }
}

#define CHECK_MODEL(n)                                                                          \
  do {                                                                                          \
    const Sets sets(n);                                                                         \
    check_bits(                                                                                 \
        sets,                                                                                   \
        [](const auto& at, Eight* a) { CHECK(catena::chain_##n::acceleration(at, a) == 0); },   \
        [](const auto& at, double* a) { CHECK(catena::chain_##n::acceleration(at, a) == 0); }); \
    check_bits(                                                                                 \
        sets, [](const auto& at, Eight* r) { catena::chain_##n::residual(at, r); },             \
        [](const auto& at, double* r) { catena::chain_##n::residual(at, r); });                 \
  } while (false)

TEST_CASE("a batch of eight numbers has the bits of one number at a time") {
  SUBCASE("2 links") { CHECK_MODEL(2); }
  SUBCASE("12 links") { CHECK_MODEL(12); }
  SUBCASE("60 links") { CHECK_MODEL(60); }
}

TEST_CASE("whole sweeps give the bits of sweeps cut for vectors of links") {
  const Sets sets(60);
  const auto together = [](const auto& at, Eight* a) {
    CHECK(catena::chain_60::accelerations(at, a) == 0);
  };
  const auto alone = [](const auto& at, double* a) {
    CHECK(catena::chain_60::acceleration(at, a) == 0);
  };
  check_bits(sets, together, alone);
}

TEST_CASE("functions go element by element") {
  volatile double step = 0.1;  // or the compiler would compute the expected values, more exactly
  Eight x;
  for (int k = 0; k < kSets; ++k) x.set(k, step * (k + 1));
  const Eight root = sqrt(x), saturated = tanh(x);
  for (int k = 0; k < kSets; ++k) {
    CHECK(root[k] == std::sqrt(x[k]));
    CHECK(saturated[k] == std::tanh(x[k]));
  }
}

template <int count>
void check_that_one_pivot_fails_all() {
  CAPTURE(count);
  for (int k = 0; k < count; ++k) {
    CAPTURE(k);
    catena::Batch<count> pivots(1.0);
    CHECK(catena::positive_pivot(pivots));
    CHECK(catena::usable_pivot(-pivots));
    for (const double bad : {0.0, std::nan("")}) {
      pivots.set(k, bad);
      CHECK_FALSE(catena::positive_pivot(pivots));
      CHECK_FALSE(catena::usable_pivot(-pivots));
    }
  }
}

TEST_CASE("a pivot that fails for one point of a batch fails for the batch") {
  check_that_one_pivot_fails_all<2>();
  check_that_one_pivot_fails_all<4>();
  check_that_one_pivot_fails_all<8>();
}

}  // namespace
