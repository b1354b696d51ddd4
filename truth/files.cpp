// SPDX-License-Identifier: BSD-3-Clause
#include "truth/files.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <initializer_list>
#include <stdexcept>
#include <utility>

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

void Stated::set(std::string_view name, double share) {
  for (const auto& [known, value] :
       {std::pair{"length", &length}, {"density", &density}, {"load", &load}})
    if (name == known) {
      *value = share;
      return;
    }
  throw std::invalid_argument("no known is called '" + std::string(name) +
                              "': length, density or load");
}

Cable as_stated(Cable cable, const Stated& stated) {
  cable.length *= 1 + stated.length;
  cable.density *= 1 + stated.density;
  cable.load_mass *= 1 + stated.load;
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

void write_outside_forces(const std::vector<OutsideForces>& forces,
                          const std::filesystem::path& path) {
  std::string text = "time_s";
  for (const char* where : {"middle_", "load_"})
    for (const char* what : {"side", "down", "velocity_side", "velocity_down", "acceleration_side",
                             "acceleration_down", "angle", "force_side", "force_down"})
      text.append(",").append(where).append(what);
  text += ",joint_angle,joint_rate,joint_moment,tie_distance,tie_distance_rate,tie_force";
  for (std::size_t i = 0; !forces.empty() && i < forces.front().joints.size(); ++i)
    for (const char* what : {"angle", "rate", "friction"})
      text += ",joint_" + std::to_string(i + 1) + "_" + what;
  text += '\n';
  for (const OutsideForces& row : forces) {
    text += number(row.time);
    const auto add = [&](std::initializer_list<double> values) {
      for (const double value : values) text.append(",").append(number(value));
    };
    for (const OutsideForces::AtPoint* at : {&row.middle, &row.load})
      add({at->position.side, at->position.down, at->velocity.side, at->velocity.down,
           at->acceleration.side, at->acceleration.down, at->angle, at->force.side,
           at->force.down});
    add({row.joint_angle, row.joint_rate, row.joint_moment, row.tie.distance, row.tie.rate,
         row.tie.force});
    for (const OutsideForces::Joint& joint : row.joints)
      add({joint.angle, joint.rate, joint.friction});
    text += '\n';
  }
  write_text(text, path);
}

namespace {

std::string parameter(const std::string& name, const std::string& sets, const std::string& unit,
                      double value, const std::string& lower, const std::string& upper) {
  return "[[parameter]]\nname = \"" + name + "\"\nsets = \"" + sets + "\"\nunit = \"" + unit +
         "\"\nvalue = " + number(value) + "\nfree = true\nlower = " + lower + "\nupper = " + upper +
         "\n\n";
}

/// Starting values: three times the stiffness, half the damping.
std::string unknowns(const Cable& cable, int links, int markers) {
  if (links == 1) {
    const double clamp = cable.bending_damping * 2 * cable.links / cable.length;  // joint 1
    return "[[parameter]]\nname = \"spring\"\nsets = \"stiffness\"\nunit = \"N "
           "m/rad\"\nvalue = 0.0\n\n" +
           parameter("damping", "damping", "N m s/rad", 0.5 * clamp, "1e-9", "1.0") +
           "[initial]\nshape = \"straight\"\nfree = true\n\n";
  }
  return parameter("EI", "bending_stiffness", "N m^2", 3 * cable.bending_stiffness, "1e-4",
                   "10.0") +
         parameter("damping", "damping_length", "N m^2 s/rad", 0.5 * cable.bending_damping, "1e-5",
                   "1.0") +
         "[initial]\nshape = \"smooth\"\nterms = " + std::to_string(std::min(6, markers)) +
         "\nfree = true\n\n";
}

std::string experiments(const Camera& camera, const CaseOptions& options) {
  std::string text;
  for (const std::string& file : options.recordings) {
    const std::string name =
        options.recordings.size() == 1 ? "recording" : std::filesystem::path(file).stem().string();
    text.append("[[experiment]]\nname = \"").append(name).append("\"\ndata = \"").append(file);
    text.append("\"\nkind = \"markers\"\nfit_until = ");
    text.append(number(std::round(camera.duration * 0.7 * 10) / 10)).append("\n");
    if (options.links == 1) {
      const std::string last = std::to_string(camera.markers);
      text.append("markers = [{name = \"bob\", side = \"side_").append(last);
      text.append("_m\", down = \"down_").append(last).append("_m\", load = true}]\n");
    }
    text += '\n';
  }
  return text;
}

}  // namespace

std::string case_text(const Cable& cable, const Camera& camera, const CaseOptions& options) {
  const std::string density =
      options.links == 1 ? "link_masses = [0.0]" : "density = " + number(cable.density);
  return "format = 1\nkind = \"case\"\ntitle = \"A filmed cable\"\n\n"
         "[model]\nlinks = " +
         std::to_string(options.links) +
         "\n\n"
         "[cable]\nlength = " +
         number(cable.length) + "\n" + density + "\nload_mass = " + number(cable.load_mass) +
         "\ngravity = " + number(cable.gravity) + "\n\n" +
         unknowns(cable, options.links, camera.markers) + experiments(camera, options) +
         "[error]\nmeasure = \"least_squares\"\n\n[optimiser]\nmethod = \"least_squares\"\n\n"
         "[diagnosis]\npossible = [\"steady_wind\"]\n";
}

std::string truth_text(const Cable& cable, const Hidden& hidden, const Camera& camera,
                       const Stated& stated, const std::vector<std::vector<double>>& held) {
  const Hidden nothing;
  std::string points;
  for (const std::vector<double>& point : held)
    points +=
        (points.empty() ? "[" : ", [") + number(point.at(0)) + ", " + number(point.at(1)) + "]";
  std::string text =
      "# The truth behind markers.csv. Nothing that explains the recording reads this.\n"
      "format = 1\nkind = \"truth\"\n\n[cable]\nlinks = " +
      std::to_string(cable.links) + "\nlength = " + number(cable.length) +
      "\ndensity = " + number(cable.density) +
      "\nbending_stiffness = " + number(cable.bending_stiffness) +
      "\nbending_damping = " + number(cable.bending_damping) +
      "\nload_mass = " + number(cable.load_mass) + "\nheld = [" + points +
      "]\n\n[case]\nlength_off = " + number(stated.length) +
      "\ndensity_off = " + number(stated.density) + "\nload_off = " + number(stated.load) +
      "\n\n[camera]\nrate = " + number(camera.rate) + "\nduration = " + number(camera.duration) +
      "\nnoise = " + number(camera.noise) + "\nlens = " + number(camera.lens) +
      "\nshutter = " + number(camera.shutter) + "\nmisplaced = " + number(camera.misplaced) +
      "\ndrift = " + number(camera.drift) + "\nslip = " + number(camera.slip) +
      "\nslipping = " + std::to_string(camera.slipping) + "\nlost = " + number(camera.lost) +
      "\npixel = " + number(camera.pixel) +
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
