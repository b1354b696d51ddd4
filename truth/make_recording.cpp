// SPDX-License-Identifier: BSD-3-Clause
//
// Makes recordings of a cable with hidden effects: markers.csv (or markers_1.csv, ...) and case.toml for
// catena, and truth.toml, which catena never reads, for comparison with what was found.
#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <utility>

#include "truth/files.hpp"
#include "truth/film_camera.hpp"
#include "truth/kept_motion.hpp"
#include "truth/rod.hpp"

namespace {

constexpr std::array kTurns = {1.0, -0.7, 0.4,
                               -0.9};  // of the angle of the held point, by recordings
constexpr std::uint64_t kOtherSeed = 0x9e3779b97f4a7c15ULL;  // of the next recording's noise

/// NAME and VALUE of NAME=VALUE.
std::pair<std::string, double> split(const std::string& option, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw std::invalid_argument(option + " " + text + ": NAME=VALUE is expected");
  return {text.substr(0, equals), std::stod(text.substr(equals + 1))};
}

/// What the command line says.
struct Options {
  truth::Cable cable;
  truth::Camera camera;
  truth::Integration integration;
  std::vector<double> held = {1.2, 2.0};
  std::vector<std::string> effects;
  std::filesystem::path output;
  truth::CaseOptions case_options;
  int recordings = 1;
  bool rod = false;
  std::vector<std::string> stated;
  std::filesystem::path films;
  bool forces = false;
};

void add_options(CLI::App& app, Options& said) {
  app.add_option("--output", said.output, "folder to write to")->required();
  app.add_option("--effect", said.effects,
                 "NAME=VALUE, e.g. air_drag_quadratic.normal=0.05; repeatable");
  app.add_option("--links", said.cable.links, "links of the hidden chain")
      ->check(CLI::Range(1, 500));
  app.add_option("--case-links", said.case_options.links, "links of the case's model; 1: a bob")
      ->check(CLI::Range(1, 500));
  app.add_flag("--rod", said.rod,
               "an elastic rod of finite elements, as many as --links; no chain");
  app.add_option(
      "--stated", said.stated,
      "NAME=SHARE, e.g. length=0.01: by how much the case states length, density or load "
      "too large; repeatable");
  app.add_option("--recordings", said.recordings, "of releases from other points as far away")
      ->check(CLI::Range(1, static_cast<int>(kTurns.size())));
  app.add_option("--films", said.films,
                 "folder that keeps motions, to film them again with other noise");
  app.add_flag("--forces", said.forces,
               "also write forces.csv: what effects that are in no library do, frame by frame");
  app.add_option("--length", said.cable.length, "m")->check(CLI::PositiveNumber);
  app.add_option("--density", said.cable.density, "kg/m")->check(CLI::PositiveNumber);
  app.add_option("--bending-stiffness", said.cable.bending_stiffness, "N m^2");
  app.add_option("--bending-damping", said.cable.bending_damping, "N m^2 s");
  app.add_option("--load", said.cable.load_mass, "kg")->check(CLI::NonNegativeNumber);
  app.add_option("--held", said.held, "side and down of the point the end is released from, m")
      ->expected(2);
  app.add_option("--rate", said.camera.rate, "frames/s")->check(CLI::PositiveNumber);
  app.add_option("--duration", said.camera.duration, "s")->check(CLI::PositiveNumber);
  app.add_option("--markers", said.camera.markers, "marks on the cable")
      ->check(CLI::Range(1, 1000));
  app.add_option("--noise", said.camera.noise, "m")->check(CLI::NonNegativeNumber);
  app.add_option("--autocorrelation", said.camera.kind.autocorrelation,
                 "of the noise, frame by frame")
      ->check(CLI::Range(0.0, 0.99));
  app.add_option("--shaking", said.camera.kind.shaking, "noise that all marks share, over --noise")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--noisy-marker", said.camera.kind.noisy_marker, "how much noisier one mark is")
      ->check(CLI::PositiveNumber);
  app.add_option("--tails", said.camera.kind.tails, "degrees of freedom of Student's t; 0: normal")
      ->check(CLI::Range(3, 100) | CLI::IsMember({0}));
  app.add_flag("--smoothed", said.camera.kind.smoothed, "over five frames, Savitzky-Golay");
  app.add_option("--outliers", said.camera.kind.outliers,
                 "share of coordinates 20 times --noise off")
      ->check(CLI::Range(0.0, 0.1));
  app.add_option("--lost", said.camera.lost, "share of marks not seen")
      ->check(CLI::Range(0.0, 0.9));
  app.add_option("--lens", said.camera.lens,
                 "share by which marks a cable's length from the middle are "
                 "seen farther out")
      ->check(CLI::Range(-0.1, 0.1));
  app.add_option("--shutter", said.camera.shutter,
                 "s in which a picture is read, from the support down")
      ->check(CLI::Range(0.0, 0.03));
  app.add_option("--misplaced", said.camera.misplaced, "m, of marks along the cable")
      ->check(CLI::Range(0.0, 0.05));
  app.add_option("--drift", said.camera.drift, "m by which the camera drifts to the side");
  app.add_option("--slip", said.camera.slip, "m by which one mark slides along the cable");
  app.add_option("--slipping", said.camera.slipping, "which mark")->check(CLI::Range(1, 1000));
  app.add_option("--pixel", said.camera.pixel, "m")->check(CLI::NonNegativeNumber);
  app.add_option("--seed", said.camera.seed, "of noise and losses");
  app.add_option("--step", said.integration.step, "of the integrator, s")
      ->check(CLI::PositiveNumber);
}

/// The points that the end is held at before its releases, as far away as the first.
std::vector<std::vector<double>> held_points(const Options& said) {
  const double reach = std::hypot(said.held.at(0), said.held.at(1));
  const double angle = std::atan2(said.held[0], said.held[1]);
  std::vector<std::vector<double>> points = {said.held};
  for (int k = 1; k < said.recordings; ++k) {
    const double turned = kTurns.at(static_cast<std::size_t>(k)) * angle;
    points.push_back({reach * std::sin(turned), reach * std::cos(turned)});
  }
  return points;
}

/// Films recording k and writes its files.
void write_recording(const Options& said, const truth::Hidden& hidden,
                     const std::vector<double>& point, int k, const std::string& file) {
  const auto start = truth::catenary_angles(said.cable, point[0], point[1]);
  truth::Moves moves = [&](const std::vector<double>& arc, const std::vector<double>& time) {
    return said.rod ? truth::move_rod(said.cable, hidden, point, arc, time, said.integration)
                    : truth::move(said.cable, hidden, start, arc, time, said.integration);
  };
  if (!said.films.empty()) {
    truth::Fingerprint what = truth::fingerprint(said.cable, hidden, said.integration);
    for (const double value : {point[0], point[1], said.rod ? 1.0 : 0.0}) what.add(value);
    moves = truth::kept(moves, what, said.films);
  }
  truth::Camera camera = said.camera;
  camera.seed += kOtherSeed * static_cast<std::uint64_t>(k);
  const truth::Recording recording = truth::film(said.cable, hidden, moves, camera);
  truth::write_markers(recording, said.output / file);
  if (said.forces)
    truth::write_outside_forces(
        truth::outside_forces(said.cable, hidden, start, recording.time, said.integration),
        said.output / "forces.csv");
}

void make_recordings(Options said) {
  truth::Hidden hidden;
  for (const std::string& effect : said.effects) {
    const auto [name, value] = split("--effect", effect);
    truth::set_hidden(hidden, name, value);
  }
  truth::Stated stated;
  for (const std::string& text : said.stated) {
    const auto [name, share] = split("--stated", text);
    stated.set(name, share);
  }
  if (said.forces && (said.rod || said.recordings > 1))
    throw std::invalid_argument("--forces: of one recording of a chain of links only");
  std::filesystem::create_directories(said.output);
  const std::vector<std::vector<double>> points = held_points(said);
  said.case_options.recordings.clear();
  for (int k = 0; k < said.recordings; ++k) {
    const std::string file =
        said.recordings == 1 ? "markers.csv" : "markers_" + std::to_string(k + 1) + ".csv";
    write_recording(said, hidden, points[static_cast<std::size_t>(k)], k, file);
    said.case_options.recordings.push_back(file);
  }
  truth::write_text(
      truth::case_text(truth::as_stated(said.cable, stated), said.camera, said.case_options),
      said.output / "case.toml");
  truth::write_text(truth::truth_text(said.cable, hidden, said.camera, stated, points),
                    said.output / "truth.toml");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    CLI::App app(
        "Films a simulated cable with a hidden effect; the truth is sealed in truth.toml.");
    Options said;
    add_options(app, said);
    CLI11_PARSE(app, argc, argv);
    make_recordings(said);
  } catch (const std::invalid_argument& error) {
    std::cerr << "make_recording: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "make_recording: " << error.what() << '\n';
    return 1;
  }
}
