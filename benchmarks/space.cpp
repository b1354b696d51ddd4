// SPDX-License-Identifier: BSD-3-Clause
//
// The cable in space beside the same cable in the plane, hinged at its support: calls of the models at one
// state, whose links leave the plane in space, and motions of 3 s at tolerance 1e-6 from the smooth start,
// in a vertical plane and askew. Their error is the largest difference of any coordinate of any joint at any of
// thirty times from a motion at a tolerance of 1e-11. Beside them general engines with ball joints: the same
// accelerations, with their difference, and with 60 links Simbody's motion askew.
//
//   space plane.so space.so  >  file.csv
#include <Eigen/Core>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "benchmarks/interleaved.hpp"
#include "benchmarks/spatial_peer.hpp"
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

/// A motion at the times of times(): joints() in the columns of q.
struct Motion : catena::benchmark::Solution {
  long steps = 0;
};

std::vector<double> times() {
  std::vector<double> list;
  for (int i = 0; i <= 30; ++i) list.push_back(0.1 * i);
  return list;
}

Motion motion(const Model& model, bool askew, double tolerance) {
  catena::SimulationOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance_position = 1e-2 * tolerance;
  options.absolute_tolerance_velocity = 1e-1 * tolerance;
  options.energy = false;
  const VectorXd p = parameters(model);
  const auto run = simulate(model, p, start(model, askew), times(), options);
  if (run.status != catena::Status::kSuccess) {
    std::fprintf(stderr, "%s\n", run.message.c_str());
    std::exit(1);
  }
  const Eigen::Index links = model.links();
  Motion result;
  result.cpu_seconds = run.statistics.cpu_seconds;
  result.steps = run.statistics.steps;
  result.q.setZero(3 * links, 31);
  for (Eigen::Index k = 0; k < 31; ++k) {
    const auto at = positions(model, p, 0.1 * static_cast<double>(k), run.trajectory.q.col(k));
    Eigen::Map<Eigen::Matrix3Xd> joints(result.q.col(k).data(), 3, links);
    joints.row(0) = at.side.segment(1, links);
    if (model.in_space()) joints.row(1) = at.across.segment(1, links);
    joints.row(2) = -at.down.segment(1, links);
  }
  return result;
}

/// By the program simbody_simulation beside this one: askew, 60 links.
Motion simbody_motion(const std::string& folder, double accuracy) {
  const std::string command =
      folder + "/simbody_simulation askew " + (std::ostringstream() << accuracy).str();
  FILE* output = popen(command.c_str(), "r");
  Motion result;
  result.q.resize(180, 31);
  bool complete = std::fscanf(output, "%lf", &result.cpu_seconds) == 1;
  for (double& number : result.q.reshaped())
    complete = complete && std::fscanf(output, "%lf", &number) == 1;
  if (pclose(output) != 0 || !complete) throw std::runtime_error(command + " failed");
  return result;
}

/// The largest difference of a peer's accelerations from the model's, over the largest of them.
double disagreement(catena::benchmark::SpatialPeer& peer, const Model& model, const VectorXd& p,
                    const catena::State& state) {
  const catena::benchmark::Cable cable(model.links());
  const auto bodies = catena::benchmark::spatial_state(state.q, state.v);
  peer.set(bodies);
  peer.accelerate(catena::benchmark::moments(cable, bodies));
  VectorXd a(model.coordinates());
  model.acceleration({0, state.q.data(), state.v.data(), nullptr, nullptr, nullptr, p.data()},
                     a.data());
  const VectorXd other = catena::benchmark::second_derivatives(
      bodies, catena::benchmark::angular_accelerations(bodies, peer));
  return (other - a).cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff();
}

/// A state at random near the start, out of the plane.
catena::State random_state(const Model& model, std::mt19937& random) {
  const int n = model.links();
  std::uniform_real_distribution<double> angle(-0.3, 0.3), rate(-2.0, 2.0);
  const auto drawn = [&](auto& from) {
    return VectorXd::NullaryExpr(n, [&] { return from(random); });
  };
  return from_directions(
      model, {catena::benchmark::Cable(n).start() + VectorXd(drawn(angle)) / n, drawn(angle),
              VectorXd(drawn(rate)) / n, VectorXd(drawn(rate)) / n});
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
  std::printf("engine,us,times_catena,differs\n");
  const catena::benchmark::Cable cable(models[1].links());
  std::vector<std::unique_ptr<catena::benchmark::SpatialPeer>> peers;
  peers.push_back(catena::benchmark::make_mujoco_in_space(cable));
  peers.push_back(catena::benchmark::make_simbody_in_space(cable));
#ifdef CATENA_BENCHMARK_RBDL
  peers.push_back(catena::benchmark::make_rbdl_in_space(cable));
#endif
#ifdef CATENA_BENCHMARK_PINOCCHIO
  peers.push_back(catena::benchmark::make_pinocchio_in_space(cable));
#endif
  const auto bodies = catena::benchmark::spatial_state(states[1].start.q, states[1].start.v);
  for (const auto& peer : peers) {
    double differs = 0;
    std::mt19937 random(1);
    for (int k = 0; k < 8; ++k)
      differs = std::max(
          differs, disagreement(*peer, models[1], states[1].p, random_state(models[1], random)));
    peer->set(bodies);
    const std::vector<double> both = catena::benchmark::nanoseconds(
        {calls[4], [&] { peer->accelerate(catena::benchmark::moments(cable, bodies)); }});
    std::printf("%s,%.4g,%.3g,%.2g\n", peer->name(), both[1] / 1e3, both[1] / both[0], differs);
  }
  std::printf("motion,tolerance,seconds,steps,error_m\n");
  const auto row = [](const char* name, double tolerance, int repetitions, const Motion& reference,
                      const std::function<Motion()>& run) {
    std::vector<double> seconds;
    Motion one;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      one = run();
      seconds.push_back(one.cpu_seconds);
    }
    std::sort(seconds.begin(), seconds.end());
    std::printf("%s,%g,%.4g,%ld,%.2g\n", name, tolerance, seconds[seconds.size() / 2], one.steps,
                (one.q - reference.q).cwiseAbs().maxCoeff());
    std::fflush(stdout);
  };
  for (std::size_t k = 0; k < 2; ++k) {
    const Motion reference = motion(models[k], false, 1e-11);
    row(k == 0 ? "plane" : "space", 1e-6, 5, reference,
        [&] { return motion(models[k], false, 1e-6); });
  }
  const Motion reference = motion(models[1], true, 1e-11);
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8})
    row("space askew", tolerance, 5, reference, [&] { return motion(models[1], true, tolerance); });
  if (models[1].links() != 60) return 0;
  const std::string folder = std::filesystem::path(argv[0]).parent_path().string();
  for (const double accuracy : {1e-3, 1e-4, 1e-5, 1e-6})
    row("Simbody askew", accuracy, 1, reference, [&] { return simbody_motion(folder, accuracy); });
  return 0;
}
