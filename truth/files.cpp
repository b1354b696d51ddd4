// SPDX-License-Identifier: BSD-3-Clause
#include "truth/files.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "truth/random.hpp"

namespace truth {
namespace {

/// The shortest text that is read back to the same double, with a point or exponent.
std::string number(double value) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  std::string result(text, end);
  if (result.find_first_of(".en") == std::string::npos) result += ".0";
  return result;
}

}  // namespace

Cable as_stated(Cable cable, double off, std::uint64_t seed) {
  Random random(seed ^ 0x0ff5e7);
  const auto wrong = [&](double value, double share) {
    return value * (1 + (random.uniform() < 0.5 ? -share : share));
  };
  cable.density = wrong(cable.density, off);
  cable.load_mass = wrong(cable.load_mass, off);
  cable.length = wrong(cable.length, off / 5);
  return cable;
}

void write_text(const std::string& text, const std::filesystem::path& path) {
  std::ofstream file(path);
  file << text;
  file.close();
  if (!file) throw std::runtime_error("cannot write " + path.string());
}

void write_markers(const Recording& recording, const std::filesystem::path& path) {
  std::string text = "time_s";
  for (std::size_t k = 1; k <= recording.arc.size(); ++k)
    text += ",side_" + std::to_string(k) + "_m,down_" + std::to_string(k) + "_m";
  text += '\n';
  char field[64];
  for (std::size_t i = 0; i < recording.time.size(); ++i) {
    std::snprintf(field, sizeof field, "%.6f", recording.time[i]);
    text += field;
    for (std::size_t k = 0; k < recording.arc.size(); ++k) {
      if (std::isnan(recording.side[i][k])) {
        text += ",,";
        continue;
      }
      std::snprintf(field, sizeof field, ",%.6f,%.6f", recording.side[i][k], recording.down[i][k]);
      text += field;
    }
    text += '\n';
  }
  write_text(text, path);
}

std::string case_text(const Cable& cable, const Camera& camera, int case_links) {
  // Starting values: three times the stiffness, half the damping.
  return "format = 1\nkind = \"case\"\ntitle = \"A filmed cable\"\n\n"
         "[model]\nlinks = " +
         std::to_string(case_links) +
         "\n\n"
         "[cable]\nlength = " +
         number(cable.length) + "\ndensity = " + number(cable.density) +
         "\nload_mass = " + number(cable.load_mass) + "\ngravity = " + number(cable.gravity) +
         "\n\n"
         "[[parameter]]\nname = \"EI\"\nsets = \"bending_stiffness\"\nunit = \"N m^2\"\nvalue = " +
         number(3 * cable.bending_stiffness) +
         "\nfree = true\nlower = 1e-4\nupper = 10.0\n\n"
         "[[parameter]]\nname = \"damping\"\nsets = \"damping_length\"\nunit = \"N m^2 "
         "s/rad\"\nvalue = " +
         number(0.5 * cable.bending_damping) +
         "\nfree = true\nlower = 1e-5\nupper = 1.0\n\n"
         "[initial]\nshape = \"smooth\"\nterms = 6\nfree = true\n\n"
         "[[experiment]]\nname = \"recording\"\ndata = \"markers.csv\"\nkind = \"markers\"\n"
         "fit_until = " +
         number(std::round(camera.duration * 0.7 * 10) / 10) +
         "\n\n"
         "[error]\nmeasure = \"least_squares\"\n\n[optimiser]\nmethod = \"least_squares\"\n\n"
         "[diagnosis]\npossible = [\"steady_wind\"]\n";
}

std::string truth_text(const Cable& cable, const Hidden& hidden, const Camera& camera,
                       const std::vector<double>& held) {
  const Hidden nothing;
  std::string text =
      "# The truth behind markers.csv. Nothing that explains the recording reads this.\n"
      "format = 1\nkind = \"truth\"\n\n[cable]\nlinks = " +
      std::to_string(cable.links) + "\nlength = " + number(cable.length) +
      "\ndensity = " + number(cable.density) +
      "\nbending_stiffness = " + number(cable.bending_stiffness) +
      "\nbending_damping = " + number(cable.bending_damping) +
      "\nload_mass = " + number(cable.load_mass) + "\nheld = [" + number(held.at(0)) + ", " +
      number(held.at(1)) + "]\n\n[camera]\nrate = " + number(camera.rate) +
      "\nduration = " + number(camera.duration) + "\nnoise = " + number(camera.noise) +
      "\nlens = " + number(camera.lens) + "\nshutter = " + number(camera.shutter) +
      "\nmisplaced = " + number(camera.misplaced) + "\ndrift = " + number(camera.drift) +
      "\nslip = " + number(camera.slip) + "\nslipping = " + std::to_string(camera.slipping) +
      "\nlost = " + number(camera.lost) + "\npixel = " + number(camera.pixel) +
      "\nautocorrelation = " + number(camera.kind.autocorrelation) +
      "\nshaking = " + number(camera.kind.shaking) +
      "\nnoisy_marker = " + number(camera.kind.noisy_marker) +
      "\ntails = " + std::to_string(camera.kind.tails) +
      "\nsmoothed = " + (camera.kind.smoothed ? "true" : "false") +
      "\noutliers = " + number(camera.kind.outliers) + "\nseed = " + std::to_string(camera.seed) +
      "\n\n[hidden]\n";
  for (const HiddenParameter& parameter : hidden_parameters())
    if (hidden.*parameter.value != nothing.*parameter.value)
      text.append("\"")
          .append(parameter.name)
          .append("\" = ")
          .append(number(hidden.*parameter.value))
          .append("\n");
  return text;
}

}  // namespace truth
