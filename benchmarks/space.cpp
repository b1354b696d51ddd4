// SPDX-License-Identifier: BSD-3-Clause
//
// The cable in space beside the same cable in the plane, hinged at its support: calls of the models at one
// state, whose links leave the plane in space, and motions of 3 s at tolerance 1e-6 from the smooth start,
// in a vertical plane and askew. Their error is the largest distance of any joint at any of thirty times
// from a motion at a tolerance of 1e-11.
//
//   space plane.so space.so  >  file.csv
#include <Eigen/Core>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "benchmarks/interleaved.hpp"
#include "benchmarks/table_6_1_cable.hpp"
#include "runtime/positions.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/simulation.hpp"

namespace {

using catena::Model;
using Eigen::VectorXd;

VectorXd parameters(const Model& model) {
  return catena::benchmark::Cable(model.links()).hinged(model);
}

catena::State start(const Model& model, bool askew) {
  const int n = model.links();
  const VectorXd angles = catena::benchmark::Cable(n).start(), zero = VectorXd::Zero(n);
  if (!model.in_space()) return from_angles(model, angles);
  if (!askew) return from_directions(model, {angles, VectorXd::Constant(n, 0.4), zero, zero});
  return from_directions(
      model, {angles, VectorXd::LinSpaced(n, 0, 0.5), zero, VectorXd::Constant(n, 0.8)});
}

struct Motion {
  Eigen::MatrixXd places;
  double seconds = 0;
  long steps = 0;
};

Motion motion(const Model& model, bool askew, double tolerance) {
  std::vector<double> times;
  for (int i = 0; i <= 30; ++i) times.push_back(0.1 * i);
  catena::SimulationOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance_position = 1e-2 * tolerance;
  options.absolute_tolerance_velocity = 1e-1 * tolerance;
  options.energy = false;
  const VectorXd p = parameters(model);
  const auto run = simulate(model, p, start(model, askew), times, options);
  if (run.status != catena::Status::kSuccess) {
    std::fprintf(stderr, "%s\n", run.message.c_str());
    std::exit(1);
  }
  const Eigen::Index points = model.links() + 2;
  Motion result{Eigen::MatrixXd::Zero(3 * points, 31), run.statistics.cpu_seconds,
                run.statistics.steps};
  for (Eigen::Index k = 0; k < 31; ++k) {
    const auto at = positions(model, p, 0.1 * static_cast<double>(k), run.trajectory.q.col(k));
    result.places.col(k) << at.side, at.down,
        model.in_space() ? at.across : VectorXd(VectorXd::Zero(points));
  }
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const Model models[] = {Model::load(argv[1]), Model::load(argv[2])};
  std::vector<std::function<void()>> calls;
  struct State {
    catena::State start;
    VectorXd p, a, x;
    std::vector<double> work;
  };
  std::vector<State> states;
  for (const Model& model : models) {
    const int n = model.coordinates();
    states.push_back({start(model, true), parameters(model), VectorXd::Zero(n), VectorXd::Ones(n),
                      std::vector<double>(static_cast<std::size_t>(model.table().newton_work))});
  }
  for (std::size_t k = 0; k < 2; ++k) {
    const Model& model = models[k];
    State& s = states[k];
    const auto at = [&s] {
      return catena_point{0,       s.start.q.data(), s.start.v.data(), s.a.data(),
                          nullptr, nullptr,          s.p.data()};
    };
    calls.emplace_back([&model, &s, at] { model.acceleration(at(), s.x.data()); });
    calls.emplace_back([&model, &s, at] { model.residual(at(), s.x.data()); });
    calls.emplace_back(
        [&model, &s, at] { model.newton_factor(at(), 1.0, 2e-3, 4e-6, s.work.data()); });
    calls.emplace_back([&model, &s] { model.newton_solve(s.work.data(), s.x.data()); });
  }
  const std::vector<double> ns = catena::benchmark::nanoseconds(calls);
  const char* names[] = {"acceleration", "residual", "newton_factor", "newton_solve"};
  std::printf("call,plane_us,space_us,times\n");
  for (std::size_t c = 0; c < 4; ++c)
    std::printf("%s,%.4g,%.4g,%.3g\n", names[c], ns[c] / 1e3, ns[c + 4] / 1e3, ns[c + 4] / ns[c]);
  std::printf("motion,seconds,steps,error_m\n");
  const struct {
    const char* name;
    const Model& model;
    bool askew;
  } motions[] = {
      {"plane", models[0], false}, {"space", models[1], false}, {"space askew", models[1], true}};
  for (const auto& each : motions) {
    const Motion reference = motion(each.model, each.askew, 1e-11);
    std::vector<double> seconds;
    Motion run;
    for (int repetition = 0; repetition < 5; ++repetition) {
      run = motion(each.model, each.askew, 1e-6);
      seconds.push_back(run.seconds);
    }
    std::sort(seconds.begin(), seconds.end());
    std::printf("%s,%.4g,%ld,%.2g\n", each.name, seconds[2], run.steps,
                (run.places - reference.places).cwiseAbs().maxCoeff());
  }
  return 0;
}
