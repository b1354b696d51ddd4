// SPDX-License-Identifier: BSD-3-Clause
//
// MoorDyn beside catena: the jumper of Lowe and Langley (2006) without its bending stiffness, in still water, with
// and without added mass. Its lower end is held; its upper end, at rest 10 m to one side, swings to the other and
// back in 27 s. Both cut the line into the same number of pieces: catena into rigid links, MoorDyn into springs with
// masses between them.
//
// Error: the largest difference of any coordinate of any node from the program's own motion with small steps;
// difference: the same from catena's motion with small steps.
//
//   moordyn MODEL.so...  >  file.csv
#include <moordyn/MoorDyn2.h>
#include <stdlib.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "benchmarks/interleaved.hpp"
#include "runtime/internal_forces.hpp"
#include "runtime/positions.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/simulation.hpp"

namespace {

using catena::Model;
using Eigen::VectorXd;

constexpr double kLength = 170.0, kDensity = 165.0, kDiameter = 0.396;  // m, kg/m, m
constexpr double kWater = 1000.0, kGravity = 9.807, kDrag = 1.0;        // kg/m^3, m/s^2
constexpr double kDisplaced = kWater * std::numbers::pi / 4 * kDiameter * kDiameter;  // kg/m
constexpr double kSide = 100.0,
                 kDown = 50.0;  // of the lower end from the middle of the upper one's motion, m
constexpr double kAmplitude = 10.0, kPeriod = 27.0;  // m, s
constexpr double kDepth = 5.0;                       // of the upper end below the surface, m

/// Of the upper end, to the side.
double moved(double t) { return -kAmplitude * std::cos(2 * std::numbers::pi / kPeriod * t); }

/// Force on the upper end at rest by the catenary.
double closed_form() {
  const double span = kSide - moved(0), chord = std::sqrt(kLength * kLength - kDown * kDown);
  double low = 1.0, high = 1e4;  // of the catenary's parameter, m
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (2 * middle * std::sinh(span / 2 / middle) > chord ? low : high) = middle;
  }
  const double down = (kLength + kDown / std::tanh(span / 2 / low)) / 2;
  return (kDensity - kDisplaced) * kGravity * std::hypot(low, down);
}

std::vector<double> times() {
  std::vector<double> list;
  for (int i = 0; i <= 54; ++i) list.push_back(0.5 * i);
  return list;
}

struct Motion {
  double cpu_seconds = 0.0;
  double force = 0.0;     ///< on the upper end at rest, N
  Eigen::MatrixXd nodes;  ///< side, down and across of one after the other, m; one column a time
};

VectorXd parameters(const Model& model, double added_mass) {
  const int n = model.links();
  const double length = kLength / n, mass = kDensity * length;
  VectorXd p = model.default_parameters();
  const auto each = [&](const char* name) { return p.segment(model.parameter_index(name), n); };
  each("length_1").setConstant(length);
  each("mass_1").setConstant(mass);
  each("inertia_1").setConstant(mass * length * length / 12);
  each("stiffness_1").setZero();
  each("damping_1").setZero();
  const auto set = [&](const char* name, double value) { p[model.parameter_index(name)] = value; };
  set("load_mass", 0.0);
  set("gravity", kGravity);
  set("anchor.to_side", kSide);
  set("anchor.to_down", kDown);
  set("support_motion.side_amplitude", kAmplitude);
  set("support_motion.side_phase", -std::numbers::pi / 2);
  set("support_motion.frequency", 1 / kPeriod);
  set("buoyancy.displaced", kDisplaced);
  set("added_mass.normal", added_mass * kDisplaced);
  set("current.normal", kWater * kDiameter / 2 * kDrag);
  return p;
}

Motion catena_motion(const Model& model, double added_mass, double tolerance) {
  const VectorXd p = parameters(model, added_mass);
  VectorXd still = p;
  still[model.parameter_index("support_motion.frequency")] = 0.0;
  const auto start = hanging_equilibrium(model, still);
  if (start.status != catena::Status::kSuccess) throw std::runtime_error(start.message);
  catena::SimulationOptions options;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance_position = 1e-2 * tolerance;
  options.absolute_tolerance_velocity = 1e-1 * tolerance;
  options.energy = false;
  const auto run = simulate(model, p, start.state, times(), options);
  if (run.status != catena::Status::kSuccess) throw std::runtime_error(run.message);
  Motion result;
  result.cpu_seconds = run.statistics.cpu_seconds;
  const Eigen::Index count = model.links() + 1, columns = run.trajectory.q.cols();
  result.nodes.resize(3 * count, columns);
  for (Eigen::Index k = 0; k < columns; ++k) {
    const double t = run.trajectory.time[static_cast<std::size_t>(k)];
    const auto at = positions(model, p, t, run.trajectory.q.col(k));
    Eigen::Map<Eigen::Matrix3Xd> nodes(result.nodes.col(k).data(), 3, count);
    nodes.row(0) = at.side.head(count);
    nodes.row(1) = at.down.head(count);
    nodes.row(2) = at.across.head(count);
  }
  const catena::Trajectory rest{{0.0}, start.state.q, start.state.v, Eigen::MatrixXd(0, 1), {}};
  result.force = internal_forces(model, still, rest).support.force.col(0).norm();
  return result;
}

/// MoorDyn's line, and how it is integrated.
struct Line {
  int segments;
  double added_mass;  ///< over that of the displaced water
  double stiffness;   ///< EA, N
  std::string scheme;
  double step;  ///< at most, s
};

/// Half of the critical damping of the springs is what MoorDyn's own case of this jumper has.
std::string input(const Line& line) {
  std::ostringstream text;
  text
      << "--- LINE TYPES ---\n"
         "TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx\n"
         "(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)\n"
      << "main " << kDiameter << " " << kDensity << " " << line.stiffness << " -0.5 0 " << kDrag
      << " " << line.added_mass << " 0 0\n"
      << "--- POINTS ---\n"
         "ID Type X Y Z Mass Volume CdA Ca\n"
         "(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)\n"
      << "1 Fixed " << kSide << " 0 " << -kDepth - kDown << " 0 0 0 0\n"
      << "2 Coupled " << moved(0) << " 0 " << -kDepth << " 0 0 0 0\n"
      << "--- LINES ---\n"
         "ID LineType AttachA AttachB UnstrLen NumSegs LineOutputs\n"
         "(#) (name) (#) (#) (m) (-) (-)\n"
      << "1 main 1 2 " << kLength << " " << line.segments << " -\n"
      << "--- OPTIONS ---\n"
      << 1.01 * line.step << " dtM\n"  // each call is one step, whatever its rounding
      << line.scheme << " tScheme\n"
      << kWater << " WtrDnsty\n"
      << kGravity << " g\n"
      << "200 WtrDpth\n0 writeLog\n1 disableOutput\n1 disableOutTime\n"
         "1 ICgenDynamic\n1000 CdScaleIC\n60 TmaxIC\n0 threshIC\n"  // 60 s in thick water bring it to rest
      << "--- END ---\n";
  return text.str();
}

void check(int error) {
  if (error != MOORDYN_SUCCESS)
    throw std::runtime_error("MoorDyn's error " + std::to_string(error));
}

/// MoorDyn counts nodes from the lower end; its third axis points upwards from the surface.
void put_nodes(MoorDynLine line, double* nodes) {
  unsigned count;
  check(MoorDyn_GetLineNumberNodes(line, &count));
  for (unsigned i = 0; i < count; ++i, nodes += 3) {
    double at[3];
    check(MoorDyn_GetLineNodePos(line, count - 1 - i, at));
    nodes[0] = at[0];
    nodes[1] = -kDepth - at[2];
    nodes[2] = at[1];
  }
}

Motion moordyn_motion(const std::filesystem::path& folder, const Line& line) {
  const std::filesystem::path file = folder / "jumper.txt";
  std::ofstream(file) << input(line);
  const std::unique_ptr<std::remove_pointer_t<MoorDyn>, decltype(&MoorDyn_Close)> system(
      MoorDyn_Create(file.c_str()), &MoorDyn_Close);
  if (!system) throw std::runtime_error("MoorDyn does not read its file");
  double at[3] = {moved(0), 0, -kDepth}, rate[3] = {0, 0, 0}, force[3], t = 0, dt = 0;
  check(MoorDyn_SetVerbosity(system.get(), MOORDYN_ERR_LEVEL));
  check(MoorDyn_Init(system.get(), at, rate));
  check(MoorDyn_Step(system.get(), at, rate, force, &t, &dt));
  Motion result;
  result.force = Eigen::Vector3d(force).norm();
  const std::vector<double> list = times();
  result.nodes.resize(3 * (line.segments + 1), static_cast<Eigen::Index>(list.size()));
  const MoorDynLine moving = MoorDyn_GetLine(system.get(), 1);
  put_nodes(moving, result.nodes.data());
  const double begin = catena::benchmark::now();
  for (std::size_t k = 1; k < list.size(); ++k) {
    const int steps = static_cast<int>(std::ceil((list[k] - list[k - 1]) / line.step));
    for (int i = 0; i < steps; ++i) {  // during a step the upper end keeps its velocity
      dt = (list[k] - list[k - 1]) / steps;
      t = list[k - 1] + i * dt;
      at[0] = moved(t);
      rate[0] = (moved(t + dt) - at[0]) / dt;
      check(MoorDyn_Step(system.get(), at, rate, force, &t, &dt));
    }
    put_nodes(moving, result.nodes.col(static_cast<Eigen::Index>(k)).data());
  }
  result.cpu_seconds = 1e-9 * (catena::benchmark::now() - begin);
  return result;
}

double largest_difference(const Motion& one, const Motion& other) {
  return (one.nodes - other.nodes).cwiseAbs().maxCoeff();
}

/// One row: the median time of three runs.
void measure(const std::string& what, double setting, const Motion& own, const Motion& catenas,
             const std::function<Motion()>& run) {
  Motion runs[3];
  std::vector<double> seconds;
  for (Motion& one : runs) {
    one = run();
    seconds.push_back(one.cpu_seconds);
  }
  std::sort(seconds.begin(), seconds.end());
  std::printf("%s,%.3g,%.4g,%.2g,%.3g,%.3g,%.7g\n", what.c_str(), setting, seconds[1],
              largest_difference(runs[0], own), largest_difference(runs[0], catenas),
              (runs[0].nodes.col(0) - catenas.nodes.col(0)).cwiseAbs().maxCoeff(), runs[0].force);
  std::fflush(stdout);
}

void compare(const Model& model, double added_mass, const std::filesystem::path& folder) {
  const int n = model.links();
  const std::string with = std::to_string(n) + "," + (added_mass > 0 ? "with" : "without");
  const Motion reference = catena_motion(model, added_mass, 1e-11);
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8})
    measure(with + ",catena,,", tolerance, reference, reference,
            [&] { return catena_motion(model, added_mass, tolerance); });
  for (const double stiffness : {5e8, 5e9}) {
    // Of the fastest motion that the springs have: neighbours against each other.
    const double frequency = 2 * n / kLength * std::sqrt(stiffness / kDensity);  // rad/s
    const auto run = [&](const std::string& scheme, double step) {
      return moordyn_motion(folder, {n, added_mass, stiffness, scheme, step / frequency});
    };
    const Motion own = run("rk4", 1.2);
    // Close to the largest steps at which these schemes are stable
    for (const auto& [scheme, step] :
         {std::pair{"rk2", 1.9}, std::pair{"rk4", 2.4}, std::pair{"midpoint5", 3.4}})
      measure(with + ",MoorDyn " + scheme + "," + (std::ostringstream() << stiffness).str(),
              step / frequency, own, reference, [&] { return run(scheme, step); });
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::string folder = std::filesystem::temp_directory_path() / "moordyn.XXXXXX";
  if (!mkdtemp(folder.data())) return 1;
  std::cout.setstate(std::ios::failbit);  // MoorDyn writes there what it reads
  std::printf("force at rest by the catenary,%.7g\n", closed_form());
  std::printf(
      "links,added mass,program,EA_N,tolerance or step_s,seconds,error_m,difference_m,"
      "difference at rest_m,force at rest_N\n");
  for (int i = 1; i < argc; ++i)
    for (const double added_mass : {0.0, 1.0}) compare(Model::load(argv[i]), added_mass, folder);
  std::filesystem::remove_all(folder);
  return 0;
}
