// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/palette.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

namespace catena::plot {
namespace {

using Rgb = std::array<int, 3>;

constexpr std::array<Rgb, 9> kSequential = {{{255, 255, 217},
                                             {237, 248, 177},
                                             {199, 233, 180},
                                             {127, 205, 187},
                                             {65, 182, 196},
                                             {29, 145, 192},
                                             {34, 94, 168},
                                             {37, 52, 148},
                                             {8, 29, 88}}};

constexpr std::array<Rgb, 9> kSigned = {{{0, 34, 78},
                                         {26, 56, 111},
                                         {67, 78, 108},
                                         {97, 101, 111},
                                         {125, 124, 120},
                                         {155, 149, 119},
                                         {187, 175, 109},
                                         {220, 202, 89},
                                         {254, 232, 56}}};

std::string between(std::span<const Rgb> anchors, double fraction) {
  const double place = std::clamp(fraction, 0.0, 1.0) * static_cast<double>(anchors.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  const double weight = place - static_cast<double>(lower);
  std::array<char, 8> text{};
  Rgb mixed{};
  for (std::size_t i = 0; i < 3; ++i) {
    mixed[i] = static_cast<int>(
        std::lround((1 - weight) * anchors[lower][i] + weight * anchors[lower + 1][i]));
  }
  std::snprintf(text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(mixed[0]) & 255U,
                static_cast<unsigned>(mixed[1]) & 255U, static_cast<unsigned>(mixed[2]) & 255U);
  return text.data();
}

}  // namespace

std::string sequential_colour(double fraction) { return between(kSequential, fraction); }
std::string signed_colour(double fraction) { return between(kSigned, fraction); }

}  // namespace catena::plot
