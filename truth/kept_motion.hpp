// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>

#include "truth/film_camera.hpp"

namespace truth {

/// A number that differs where any of the values differ (FNV-1a, 64 bits).
class Fingerprint {
 public:
  /// Takes in the bits of a value; the number of all so far.
  void add(double value);
  std::uint64_t number() const { return number_; }

 private:
  std::uint64_t number_ = 0xcbf29ce484222325ULL;
};

/// All that decides how a cable moves: the cable, what is hidden but for the camera's own errors.
Fingerprint fingerprint(const Cable& cable, const Hidden& hidden, const Integration& integration);

/// `moves`, but a motion that was computed before is read from a file in `folder`, and a new one is kept
/// there. So a cable is simulated once and filmed often, with other noise. `what`: of everything that
/// decides the motion but the points and times. Several programs may use a folder at once.
///
/// The result throws std::runtime_error if a file in the folder cannot be read or written.
Moves kept(Moves moves, const Fingerprint& what, const std::filesystem::path& folder);

}  // namespace truth
