// SPDX-License-Identifier: BSD-3-Clause
//
// The model for any number of links compared with those compiled for one number: its functions, and
// 3 s of the cable from the smooth start at tolerance 1e-6. Results must first agree bit for bit.
//
//   any_links [--model N library.so]...  >  file.csv
#include "runtime/any_links.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "benchmarks/interleaved.hpp"
#include "benchmarks/table_6_1_cable.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/simulation.hpp"

namespace {

using catena::Model;
using catena::benchmark::Cable;
using catena::benchmark::nanoseconds;
using Eigen::VectorXd;

constexpr const char* kFunctions[] = {"residual", "forward dynamics", "Newton factor",
                                      "Newton solve"};

/// Calls of one model's functions; each writes `result`.
struct Calls {
  explicit Calls(const Model& model)
      : model(model),
        q(Cable(model.links()).start()),
        v(0.5 * q),
        a(q),
        p(Cable(model.links()).parameters(model, 0.6)),
        result(q),
        work(VectorXd::Zero(model.table().newton_work)) {}

  void call(std::size_t function) {
    const catena_point at{0.0, q.data(), v.data(), a.data(), nullptr, nullptr, p.data()};
    switch (function) {
      case 0:
        return model.residual(at, result.data());
      case 1:
        if (model.acceleration(at, result.data()) != 0) std::abort();
        return;
      case 2:
        if (model.newton_factor(at, 1.0, 1e-3, 1e-6, work.data()) != 0) std::abort();
        return;
      case 3:
        result = a;
        return model.newton_solve(work.data(), result.data());
    }
  }

  Model model;
  VectorXd q, v, a, p, result, work;
};

catena::Simulation simulation(const Model& model) {
  const Cable cable(model.links());
  catena::SimulationOptions options;
  options.relative_tolerance = 1e-6;
  options.absolute_tolerance_position = 1e-8;
  options.absolute_tolerance_velocity = 1e-7;
  options.energy = false;
  return catena::simulate(model, cable.parameters(model, 0.6),
                          catena::from_angles(model, cable.start()), {0.0, 3.0}, options);
}

bool same(const VectorXd& a, const VectorXd& b) {
  return std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(double)) == 0;
}

void print(int links, const char* what, double one, double any) {
  std::printf("%d,%s,%.4g,%.4g,%.3f\n", links, what, one, any, any / one);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Model> models{Model::built_in(12), Model::built_in(60)};
  for (int i = 1; i + 2 < argc; i += 3) models.push_back(Model::load(argv[i + 2]));
  std::printf("links,what,one_number_us,any_number_us,ratio\n");
  for (const Model& one : models) {
    const int links = one.links();
    const Model any = catena::any_links_model(links);
    Calls calls_of_one(one), calls_of_any(any);
    for (std::size_t function = 0; function < std::size(kFunctions); ++function) {
      const auto times =
          nanoseconds({[&] { calls_of_one.call(function); }, [&] { calls_of_any.call(function); }});
      if (!same(calls_of_one.result, calls_of_any.result)) std::abort();
      print(links, kFunctions[function], 1e-3 * times[0], 1e-3 * times[1]);
    }
    std::vector<double> seconds[2];
    VectorXd last[2];
    for (int repetition = 0; repetition < 9; ++repetition)
      for (int k = 0; k < 2; ++k) {
        const auto run = simulation(k == 0 ? one : any);
        if (run.status != catena::Status::kSuccess) std::abort();
        last[k] = run.trajectory.q.col(1);
        seconds[k].push_back(run.statistics.cpu_seconds);
      }
    if (!same(last[0], last[1])) std::abort();
    for (auto& times : seconds) std::nth_element(times.begin(), times.begin() + 4, times.end());
    print(links, "3 s simulated", 1e6 * seconds[0][4], 1e6 * seconds[1][4]);
  }
  return 0;
}
