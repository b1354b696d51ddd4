// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/explanation.hpp"

#include <algorithm>

namespace catena {

std::vector<Explanation> best_effects(const std::vector<Explanation>& explanations,
                                      const std::vector<NoiseModel>& noise, std::size_t count,
                                      const std::string& except) {
  std::vector<Explanation> best;
  for (const Explanation& each : explanations)
    if (each.refitted && each.is_effect() && each.id != except) best.push_back(each);
  std::stable_sort(best.begin(), best.end(), [&](const Explanation& a, const Explanation& b) {
    return sum_of_squares(a.model, noise) < sum_of_squares(b.model, noise);
  });
  best.resize(std::min(best.size(), count));
  return best;
}

}  // namespace catena
