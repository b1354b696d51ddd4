// SPDX-License-Identifier: BSD-3-Clause
//
// Time of one call of the forward dynamics, compared with general engines on the same chain and
// states. Results are compared first; an engine that disagrees is reported and not timed.
//
//   forward_dynamics [--model N library.so]... [Google Benchmark's options]
#include <benchmark/benchmark.h>

#include <cstdio>
#include <map>
#include <random>
#include <string>

#include "benchmarks/peer.hpp"

namespace {

using catena::Model;
using catena::benchmark::absolute_angles;
using catena::benchmark::Cable;
using catena::benchmark::Peer;
using catena::benchmark::relative_angles;
using Eigen::VectorXd;

struct States {
  explicit States(int n) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> angle(-0.3, 0.3), rate(-2.0, 2.0);
    for (int k = 0; k < 8; ++k) {
      VectorXd q = Cable(n).start(), v(n);
      for (int i = 0; i < n; ++i) {
        q[i] += angle(random) / n;
        v[i] = rate(random) / n;
      }
      absolute_q.push_back(q);
      absolute_v.push_back(v);
      relative_q.push_back(relative_angles(q));
      relative_v.push_back(relative_angles(v));
    }
  }
  std::vector<VectorXd> absolute_q, absolute_v, relative_q, relative_v;
};

void accelerations(const Model& model, const VectorXd& p, const VectorXd& q, const VectorXd& v,
                   VectorXd& a) {
  const catena_point at{0.0, q.data(), v.data(), nullptr, nullptr, nullptr, p.data()};
  if (model.acceleration(at, a.data()) != 0) std::abort();
}

void time_catena(::benchmark::State& timer, const Model& model, bool relative) {
  const int n = model.links();
  const States states(n);
  const VectorXd p = Cable(n).parameters(model);
  VectorXd q(n), v(n), a(n);
  std::size_t k = 0;
  for (auto _ : timer) {
    if (relative) {
      const VectorXd &rq = states.relative_q[k % 8], &rv = states.relative_v[k % 8];
      double sum_q = 0.0, sum_v = 0.0;
      for (int i = 0; i < n; ++i) {
        q[i] = sum_q += rq[i];
        v[i] = sum_v += rv[i];
      }
      accelerations(model, p, q, v, a);
      for (int i = n - 1; i > 0; --i) a[i] -= a[i - 1];
    } else {
      accelerations(model, p, states.absolute_q[k % 8], states.absolute_v[k % 8], a);
    }
    ::benchmark::DoNotOptimize(a.data());
    ::benchmark::ClobberMemory();
    ++k;
  }
}

void time_peer(::benchmark::State& timer, Peer& peer, int n) {
  const States states(n);
  VectorXd a(n);
  std::size_t k = 0;
  for (auto _ : timer) {
    peer.accelerations(states.relative_q[k % 8], states.relative_v[k % 8], a);
    ::benchmark::DoNotOptimize(a.data());
    ::benchmark::ClobberMemory();
    ++k;
  }
}

/// Largest difference of the absolute accelerations, relative to the largest of them.
double disagreement(Peer& peer, const Model& model) {
  const int n = model.links();
  const States states(n);
  const VectorXd p = Cable(n).parameters(model);
  double worst = 0.0;
  for (std::size_t k = 0; k < 8; ++k) {
    VectorXd a(n), relative(n);
    accelerations(model, p, states.absolute_q[k], states.absolute_v[k], a);
    peer.accelerations(states.relative_q[k], states.relative_v[k], relative);
    worst = std::max(
        worst, (absolute_angles(relative) - a).cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff());
  }
  return worst;
}

}  // namespace

int main(int argc, char** argv) {
  std::map<int, Model> models;
  for (const int n : Model::built_in_links()) models.emplace(n, Model::built_in(n));
  std::vector<char*> rest{argv[0]};
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--model" && i + 2 < argc) {
      models.emplace(std::stoi(argv[i + 1]), Model::load(argv[i + 2]));
      i += 2;
    } else {
      rest.push_back(argv[i]);
    }
  }
  std::vector<std::unique_ptr<Peer> (*)(const Cable&)> makers{catena::benchmark::make_mujoco,
                                                              catena::benchmark::make_simbody,
                                                              catena::benchmark::make_dart};
#ifdef CATENA_BENCHMARK_RBDL
  makers.push_back(catena::benchmark::make_rbdl);
#endif
#ifdef CATENA_BENCHMARK_PINOCCHIO
  makers.push_back(catena::benchmark::make_pinocchio);
#endif
  std::vector<std::unique_ptr<Peer>> peers;
  for (const auto& [n, model] : models) {
    const std::string size = "/" + std::to_string(n);
    ::benchmark::RegisterBenchmark(("catena" + size).c_str(), [&model = model](auto& timer) {
      time_catena(timer, model, false);
    });
    ::benchmark::RegisterBenchmark(
        ("catena, relative angles" + size).c_str(),
        [&model = model](auto& timer) { time_catena(timer, model, true); });
    for (const auto make : makers) {
      try {
        peers.push_back(make(Cable(n)));
      } catch (const std::exception& error) {
        std::fprintf(stderr, "%4d links: not measured: %s\n", n, error.what());
        continue;
      }
      Peer& peer = *peers.back();
      const double difference = disagreement(peer, model);
      // Relative coordinates lose digits with the condition of their mass matrix, which grows with
      // n.
      const bool agrees = difference < 1e-12 * n * n * n;
      std::fprintf(stderr, "%-8s %4d links: accelerations differ by %.1e of the largest%s\n",
                   peer.name(), n, difference, agrees ? "" : "  NOT TIMED");
      if (agrees)
        ::benchmark::RegisterBenchmark((peer.name() + size).c_str(),
                                       [&peer, n = n](auto& timer) { time_peer(timer, peer, n); });
    }
  }
  int count = static_cast<int>(rest.size());
  ::benchmark::Initialize(&count, rest.data());
  ::benchmark::RunSpecifiedBenchmarks();
  return 0;
}
