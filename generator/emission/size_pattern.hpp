// SPDX-License-Identifier: GPL-3.0-or-later
//
// Emitted text that reads the same for every number of links but for integers: bounds of loops,
// sizes of arrays, places in them.
#pragma once

#include <string>
#include <vector>

namespace catena {

/// Integers that differ between the texts for n and n + 1 links are taken as affine in the number
/// of links. Whether that holds for others is for the caller to compare (at, written_out).
class SizePattern {
 public:
  /// Throws std::logic_error if the texts differ in more than integers.
  SizePattern(const std::string& at_links, const std::string& at_one_more, int links);

  /// What the text is for that many links.
  std::string at(int links) const;

  /// The text with expressions in `links` for such integers. A template argument becomes the first
  /// argument of the function: f<12>(x) is f(links, x).
  std::string text() const;

 private:
  struct Piece {
    std::string before;  // what stands before the integer
    long slope = 0, constant = 0;
  };
  std::vector<Piece> pieces_;
  std::string end_;
};

/// The statements of a function's body one a line without loops, blocks and indentation: what is
/// computed, in which order.
std::string written_out(const std::string& statements);

}  // namespace catena
