// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// Result files made up for the tests: motions by formula, noise by a seeded generator. Their
/// numbers mean nothing; their shape is that of docs/file-formats.md.
namespace catena::report {

/// A cable of `links` links and 2.5 m for `duration` s at `rate` 1/s, no data.
nlohmann::json made_simulation(int links, double duration, double rate);

/// The same fitted to 12 markers with 1 mm of noise, one of them lost for a while, and a second
/// experiment that only validates; with everything an identification can say.
nlohmann::json made_identification(int links, double duration, double rate);

/// The same motion in a vertical plane in space, at an azimuth of 30 degrees.
nlohmann::json made_identification_in_space(int links, double duration, double rate);

/// A double pendulum with measured angles.
nlohmann::json made_pendulum();

/// Two rounds, the results inside: drag is named.
nlohmann::json made_diagnosis();

}  // namespace catena::report
