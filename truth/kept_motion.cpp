// SPDX-License-Identifier: BSD-3-Clause
#include "truth/kept_motion.hpp"

#include <unistd.h>

#include <array>
#include <bit>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>

namespace truth {
namespace {

/// The tables of a motion, one after the other; points and times are known to the reader.
template <class Action>
void for_each_row(Motion& motion, Action&& action) {
  for (auto* table : {&motion.side, &motion.down, &motion.angle}) {
    table->resize(motion.time.size());
    for (std::vector<double>& row : *table) {
      row.resize(motion.arc.size());
      action(row);
    }
  }
}

std::streamsize bytes(const std::vector<double>& row) {
  return static_cast<std::streamsize>(row.size() * sizeof(double));
}

Motion read_motion(const std::filesystem::path& path, const std::vector<double>& arc,
                   const std::vector<double>& time) {
  std::ifstream file(path, std::ios::binary);
  Motion motion{.time = time, .arc = arc, .side = {}, .down = {}, .angle = {}};
  for_each_row(motion, [&](std::vector<double>& row) {
    file.read(reinterpret_cast<char*>(row.data()), bytes(row));
  });
  if (!file || file.peek() != std::ifstream::traits_type::eof())
    throw std::runtime_error(path.string() + " is no whole motion; delete it");
  return motion;
}

void write_motion(Motion motion, const std::filesystem::path& path) {
  std::filesystem::path unfinished = path;
  unfinished += "." + std::to_string(getpid());
  std::ofstream file(unfinished, std::ios::binary);
  for_each_row(motion, [&](const std::vector<double>& row) {
    file.write(reinterpret_cast<const char*>(row.data()), bytes(row));
  });
  file.close();
  if (!file) throw std::runtime_error("cannot write " + unfinished.string());
  std::filesystem::rename(unfinished, path);
}

}  // namespace

void Fingerprint::add(double value) {
  for (const unsigned char byte : std::bit_cast<std::array<unsigned char, sizeof value>>(value)) {
    number_ ^= byte;
    number_ *= 0x100000001b3ULL;
  }
}

Fingerprint fingerprint(const Cable& cable, const Hidden& hidden, const Integration& integration) {
  Hidden moving = hidden;
  const Hidden nothing;
  for (double Hidden::*of_camera :
       {&Hidden::clock_offset, &Hidden::scale, &Hidden::camera_tilt, &Hidden::marker_across,
        &Hidden::marker_along, &Hidden::origin_side, &Hidden::origin_down})
    moving.*of_camera = nothing.*of_camera;
  Fingerprint result;
  for (const double value :
       {static_cast<double>(cable.links), cable.length, cable.density, cable.bending_stiffness,
        cable.bending_damping, cable.load_mass, cable.gravity, integration.step})
    result.add(value);
  for (const HiddenParameter& parameter : hidden_parameters()) result.add(moving.*parameter.value);
  return result;
}

Moves kept(Moves moves, const Fingerprint& what, const std::filesystem::path& folder) {
  return [moves = std::move(moves), what, folder](const std::vector<double>& arc,
                                                  const std::vector<double>& time) {
    Fingerprint all = what;
    all.add(static_cast<double>(arc.size()));
    for (const auto* values : {&arc, &time})
      for (const double value : *values) all.add(value);
    char name[32];
    std::snprintf(name, sizeof name, "%016llx.motion",
                  static_cast<unsigned long long>(all.number()));
    const std::filesystem::path path = folder / name;
    if (std::filesystem::exists(path)) return read_motion(path, arc, time);
    Motion motion = moves(arc, time);
    std::filesystem::create_directories(folder);
    write_motion(motion, path);
    return motion;
  };
}

}  // namespace truth
