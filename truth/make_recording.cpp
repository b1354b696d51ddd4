// SPDX-License-Identifier: BSD-3-Clause
//
// Makes a recording of a cable with hidden effects: markers.csv and case.toml for catena, and
// truth.toml, which catena never reads, for comparison with what was found.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "truth/camera.hpp"
#include "truth/files.hpp"
#include "truth/rod.hpp"

int main(int argc, char** argv) {
  truth::Cable cable;
  truth::Camera camera;
  truth::Integration integration;
  std::vector<double> held = {1.2, 2.0};
  std::vector<std::string> effects;
  std::filesystem::path output;
  int case_links = 24;
  bool rod = false;
  double knowns_off = 0;

  CLI::App app("Films a simulated cable with a hidden effect; the truth is sealed in truth.toml.");
  app.add_option("--output", output, "folder to write to")->required();
  app.add_option("--effect", effects,
                 "NAME=VALUE, e.g. air_drag_quadratic.normal=0.05; repeatable");
  app.add_option("--links", cable.links, "links of the hidden chain")->check(CLI::Range(1, 500));
  app.add_option("--case-links", case_links, "links of the case's model")
      ->check(CLI::Range(1, 500));
  app.add_flag("--rod", rod, "an elastic rod of finite elements, as many as --links; no chain");
  app.add_option(
         "--knowns-off", knowns_off,
         "share by which the case's density and load are wrong, a fifth of it for the length")
      ->check(CLI::Range(0.0, 0.1));
  app.add_option("--length", cable.length, "m")->check(CLI::PositiveNumber);
  app.add_option("--density", cable.density, "kg/m")->check(CLI::PositiveNumber);
  app.add_option("--bending-stiffness", cable.bending_stiffness, "N m^2");
  app.add_option("--bending-damping", cable.bending_damping, "N m^2 s");
  app.add_option("--load", cable.load_mass, "kg")->check(CLI::NonNegativeNumber);
  app.add_option("--held", held, "side and down of the point the end is released from, m")
      ->expected(2);
  app.add_option("--rate", camera.rate, "frames/s")->check(CLI::PositiveNumber);
  app.add_option("--duration", camera.duration, "s")->check(CLI::PositiveNumber);
  app.add_option("--markers", camera.markers, "marks on the cable")->check(CLI::Range(1, 1000));
  app.add_option("--noise", camera.noise, "m")->check(CLI::NonNegativeNumber);
  app.add_option("--autocorrelation", camera.kind.autocorrelation, "of the noise, frame by frame")
      ->check(CLI::Range(0.0, 0.99));
  app.add_option("--shaking", camera.kind.shaking, "noise that all marks share, over --noise")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--noisy-marker", camera.kind.noisy_marker, "how much noisier one mark is")
      ->check(CLI::PositiveNumber);
  app.add_option("--tails", camera.kind.tails, "degrees of freedom of Student's t; 0: normal")
      ->check(CLI::Range(3, 100) | CLI::IsMember({0}));
  app.add_flag("--smoothed", camera.kind.smoothed, "over five frames, Savitzky-Golay");
  app.add_option("--outliers", camera.kind.outliers, "share of coordinates 20 times --noise off")
      ->check(CLI::Range(0.0, 0.1));
  app.add_option("--lost", camera.lost, "share of marks not seen")->check(CLI::Range(0.0, 0.9));
  app.add_option("--lens", camera.lens,
                 "share by which marks a cable's length from the middle are "
                 "seen farther out")
      ->check(CLI::Range(-0.1, 0.1));
  app.add_option("--shutter", camera.shutter, "s in which a picture is read, from the support down")
      ->check(CLI::Range(0.0, 0.03));
  app.add_option("--misplaced", camera.misplaced, "m, of marks along the cable")
      ->check(CLI::Range(0.0, 0.05));
  app.add_option("--drift", camera.drift, "m by which the camera drifts to the side");
  app.add_option("--slip", camera.slip, "m by which one mark slides along the cable");
  app.add_option("--slipping", camera.slipping, "which mark")->check(CLI::Range(1, 1000));
  app.add_option("--pixel", camera.pixel, "m")->check(CLI::NonNegativeNumber);
  app.add_option("--seed", camera.seed, "of noise and losses");
  app.add_option("--step", integration.step, "of the integrator, s")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);

  try {
    truth::Hidden hidden;
    for (const std::string& effect : effects) {
      const std::size_t equals = effect.find('=');
      if (equals == std::string::npos)
        throw std::invalid_argument("--effect " + effect + ": NAME=VALUE is expected");
      truth::set_hidden(hidden, effect.substr(0, equals), std::stod(effect.substr(equals + 1)));
    }
    const auto start = truth::catenary_angles(cable, held[0], held[1]);
    const truth::Moves moves = [&](const std::vector<double>& arc,
                                   const std::vector<double>& time) {
      return rod ? truth::move_rod(cable, hidden, held, arc, time, integration)
                 : truth::move(cable, hidden, start, arc, time, integration);
    };
    const truth::Recording recording = truth::film(cable, hidden, moves, camera);
    std::filesystem::create_directories(output);
    truth::write_markers(recording, output / "markers.csv");
    truth::write_text(
        truth::case_text(truth::as_stated(cable, knowns_off, camera.seed), camera, case_links),
        output / "case.toml");
    truth::write_text(truth::truth_text(cable, hidden, camera, held), output / "truth.toml");
  } catch (const std::invalid_argument& error) {
    std::cerr << "make_recording: " << error.what() << '\n';
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "make_recording: " << error.what() << '\n';
    return 1;
  }
}
