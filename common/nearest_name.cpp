// SPDX-License-Identifier: BSD-3-Clause
#include "common/nearest_name.hpp"

#include <algorithm>

#include "common/in_quotes.hpp"

namespace catena {
namespace {

constexpr std::size_t kMostNames = 60;  // that a message lists: all effects are fewer

// Optimal string alignment distance.
std::size_t edits(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      const std::size_t changed = a[i - 1] == b[j - 1] ? 0 : 1;
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + changed});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates) {
  std::string nearest;
  if (word.size() > kMostQuoted)
    return nearest;  // no name, and edits() takes the product of lengths
  std::size_t fewest = std::max<std::size_t>(1, word.size() * 2 / 5) + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() >= word.size() + fewest) continue;  // so many letters are to be inserted
    const std::size_t distance = edits(word, candidate);
    const bool something_in_common = distance < std::max(word.size(), candidate.size());
    if (distance < fewest && something_in_common) {
      fewest = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  if (const std::string near = nearest_name(word, candidates); !near.empty()) {
    return "; did you mean " + in_quotes(near) + "?";
  }
  if (candidates.empty()) return "; none is known here";
  std::vector<std::string> known = candidates;
  std::sort(known.begin(), known.end());
  const std::size_t count = known.size();
  if (count > kMostNames) known.resize(kMostNames);
  for (std::string& name : known) name = shortened(name);
  return count > kMostNames
             ? "; some of the " + std::to_string(count) + " known are " + listed(known)
             : "; known are " + listed(known);
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " and " : ", ";
    text += words[i];
  }
  return text;
}

}  // namespace catena
