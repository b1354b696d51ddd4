// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/predictive_accuracy.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "identify/diagnosis/thresholds.hpp"

namespace catena {
namespace {

constexpr std::size_t kRankedBlocks = 12;  // fewer could not be beyond chance of 1 in 1000
constexpr std::size_t kRankSums = kRankedBlocks * (kRankedBlocks + 1) / 2 + 1;

/// Of every held-out frame in which something was measured: by how much less `model` leaves.
std::vector<double> leads(const FittedModel& model, const FittedModel& other,
                          const std::vector<NoiseModel>& noise) {
  std::vector<double> lead;
  for (std::size_t e = 0; e < model.held_out_residual.size(); ++e) {
    const Eigen::MatrixXd difference =
        (other.held_out_residual[e].cwiseAbs2() - model.held_out_residual[e].cwiseAbs2()) /
        (noise[e].level * noise[e].level);
    for (Eigen::Index k = 0; k < difference.cols(); ++k) {
      if (difference.col(k).array().isNaN().all()) continue;
      double sum = 0;
      for (const double value : difference.col(k)) sum += std::isnan(value) ? 0 : value;
      lead.push_back(sum);
    }
  }
  return lead;
}

/// The probability that ranks 1 to 12, each counted by the toss of a coin, sum up to so much.
double chance_of(std::size_t rank_sum) {
  std::array<double, kRankSums> probability{};
  probability[0] = 1;
  for (std::size_t rank = 1; rank <= kRankedBlocks; ++rank)
    for (std::size_t sum = kRankSums; sum-- > 0;)
      probability[sum] = (probability[sum] + (sum >= rank ? probability[sum - rank] : 0)) / 2;
  double chance = 0;
  for (std::size_t sum = rank_sum; sum < kRankSums; ++sum) chance += probability[sum];
  return chance;
}

}  // namespace

double chance_of_lead(const FittedModel& model, const FittedModel& other,
                      const std::vector<NoiseModel>& noise) {
  const std::vector<double> lead = leads(model, other, noise);
  const std::size_t length = lead.size() / kRankedBlocks;
  if (lead.size() < kFewestFramesToCompare) return 1;
  std::array<double, kRankedBlocks> blocks{};
  for (std::size_t k = 0; k < kRankedBlocks * length; ++k) blocks[k / length] += lead[k];
  std::sort(blocks.begin(), blocks.end(),
            [](double a, double b) { return std::abs(a) < std::abs(b); });
  std::size_t rank_sum = 0;
  for (std::size_t rank = 1; rank <= kRankedBlocks; ++rank)
    if (blocks[rank - 1] > 0) rank_sum += rank;
  return chance_of(rank_sum);
}

bool predicts_better(const FittedModel& model, const FittedModel& other,
                     const std::vector<NoiseModel>& noise) {
  return kThresholds.as_good_held_out * held_out_gap(model, noise).rms <
             held_out_gap(other, noise).rms &&
         chance_of_lead(model, other, noise) * kThresholds.odds < 1;
}

bool predicts_as_well(const GapTest& held_out, const GapTest& other) {
  // 0 and 0 where nothing is held out
  return held_out.rms <= kThresholds.as_good_held_out * other.rms;
}

}  // namespace catena
