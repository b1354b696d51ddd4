// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/shares.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "common/parallel.hpp"
#include "identify/diagnosis/diagnosis_state.hpp"
#include "identify/diagnosis/variant.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kResamples = 400;
constexpr Index kScatterBlocks = 12;  // of a recording: fewer would say too little of their scatter
// Half the width of an interval in standard deviations of the bootstrap: Student's t of eleven degrees
// of freedom, times sqrt(12 / 11) for the mean that the blocks share. Percentiles of so few blocks
// cover 83 to 88 % only.
constexpr double kHalfWidth = 2.3;

/// Of every frame of all recordings in which something was measured: the sum of the squares over the noise
/// less the number of values, and that number.
struct FrameSums {
  VectorXd excess, count;
};

FrameSums frame_sums(const std::vector<MatrixXd>& residuals, const std::vector<double>& sigmas) {
  Index frames = 0;
  for (const MatrixXd& residual : residuals) frames += residual.cols();
  FrameSums sums{VectorXd::Zero(frames), VectorXd::Zero(frames)};
  Index frame = 0;
  for (std::size_t e = 0; e < residuals.size(); ++e)
    for (Index k = 0; k < residuals[e].cols(); ++k) {
      for (const double value : residuals[e].col(k)) {
        if (std::isnan(value)) continue;
        sums.excess[frame] += value * value / (sigmas[e] * sigmas[e]) - 1;
        sums.count[frame] += 1;
      }
      if (sums.count[frame] > 0) ++frame;
    }
  sums.excess.conservativeResize(frame);
  sums.count.conservativeResize(frame);
  return sums;
}

/// Mean over all orders of what each effect removes, then what is left, from the misfit with every
/// subset; all over the misfit without effects.
VectorXd shares(const VectorXd& misfit) {
  const auto subsets = static_cast<unsigned>(misfit.size());
  const int effects = std::countr_zero(subsets);
  VectorXd factorial = VectorXd::Ones(effects + 1);
  for (int k = 1; k <= effects; ++k) factorial[k] = k * factorial[k - 1];
  VectorXd share = VectorXd::Zero(effects + 1);
  for (int i = 0; i < effects; ++i)
    for (unsigned subset = 0; subset < subsets; ++subset) {
      if (subset >> i & 1u) continue;
      const int size = std::popcount(subset);
      const double orders = factorial[size] * factorial[effects - 1 - size] / factorial[effects];
      share[i] += orders * (misfit[subset] - misfit[subset | 1u << i]);
    }
  share[effects] = misfit[subsets - 1];
  return share / misfit[0];
}

}  // namespace

std::vector<ShareInterval> share_intervals(const SubsetResiduals& residuals,
                                           const std::vector<double>& sigmas, unsigned seed) {
  std::vector<FrameSums> sums;
  for (const auto& subset : residuals) sums.push_back(frame_sums(subset, sigmas));
  const Index frames = sums.front().count.size();
  const auto subsets = static_cast<Index>(sums.size());
  const auto misfits = [&](const VectorXd& times) {
    VectorXd misfit(subsets);
    for (Index s = 0; s < subsets; ++s) {
      const FrameSums& sum = sums[static_cast<std::size_t>(s)];
      misfit[s] = std::max(0.0, sum.excess.dot(times) / sum.count.dot(times));
    }
    return misfit;
  };
  const VectorXd estimate = shares(misfits(VectorXd::Ones(frames)));

  const Index length = std::max<Index>(1, frames / kScatterBlocks);
  std::mt19937_64 random(seed);
  VectorXd sum = VectorXd::Zero(estimate.size()), squares = sum;
  int count = 0;
  for (int resample = 0; resample < kResamples; ++resample) {
    VectorXd times = VectorXd::Zero(frames);
    for (Index block = 0; block < kScatterBlocks; ++block) {
      const auto begin = static_cast<Index>(random() % static_cast<std::uint64_t>(frames));
      for (Index k = 0; k < length; ++k) times[(begin + k) % frames] += 1;
    }
    const VectorXd share = shares(misfits(times));
    if (!share.allFinite()) continue;
    sum += share;
    squares += share.cwiseAbs2();
    ++count;
  }
  if (count < kResamples / 2 || !estimate.allFinite()) return {};
  const VectorXd mean = sum / count;
  const VectorXd half = kHalfWidth * (squares / count - mean.cwiseAbs2()).cwiseMax(0).cwiseSqrt();
  std::vector<ShareInterval> intervals;
  for (Index i = 0; i < estimate.size(); ++i)
    intervals.push_back({estimate[i], estimate[i] - half[i], estimate[i] + half[i]});
  return intervals;
}

namespace {

/// Fitted anew.
FittedModel fitted_with_effects(DiagnosisState& state, const std::vector<std::string>& kept) {
  DiagnosisContext& context = state.context;
  const FittedModel& whole = state.found.final;
  Case the_case = whole.problem->the_case();
  for (const std::string& id : state.found.effects)
    if (std::find(kept.begin(), kept.end(), id) == kept.end())
      the_case = without_effect(the_case, id);
  const auto problem =
      std::make_shared<const Problem>(the_case, context.model_with(kept, the_case.links));
  const auto fit_from = [&](const FittedModel& model) {
    return fit_model(problem, transfer(*model.problem, model.x, *problem), state.found.noise,
                     context.least_squares, context.stop);
  };
  FittedModel best = fit_from(whole);
  // From a far start a fit may end in a minimum of its own. The model without effects was fitted
  // before, from several starts.
  for (const Stage& stage : state.found.stages)
    if (stage.effects == kept && stage.links == the_case.links) {
      FittedModel other = fit_from(stage.model);
      if (other.ok && (!best.ok || state.squares(other) < state.squares(best)))
        best = std::move(other);
    }
  return best;
}

}  // namespace

FittedModel fit_with_effects(DiagnosisState& state, const std::vector<std::string>& kept) {
  const auto known = state.fits_with_effects.find(kept);
  if (known != state.fits_with_effects.end()) return known->second;
  return state.fits_with_effects[kept] = fitted_with_effects(state, kept);
}

Shares shares_of(DiagnosisState& state) {
  const std::vector<std::string>& effects = state.found.effects;
  if (effects.empty()) return {};
  const std::size_t subsets = std::size_t{1} << effects.size();
  SubsetResiduals fitted(subsets), held_out(subsets);
  state.context.begin("dividing the misfit among the effects", subsets - 1);
  std::vector<FittedModel> fits(subsets);
  const auto kept_of = [&](std::size_t subset) {
    std::vector<std::string> kept;
    for (std::size_t i = 0; i < effects.size(); ++i)
      if (subset >> i & 1u) kept.push_back(effects[i]);
    return kept;
  };
  fits.back() = state.found.final;
  in_parallel(subsets - 1, state.context.threads, [&](std::size_t subset) {
    fits[subset] = fitted_with_effects(state, kept_of(subset));
    state.context.end_task();
  });
  state.context.stop_if_asked();
  state.fits_with_effects.clear();
  for (std::size_t subset = 0; subset < subsets; ++subset)
    state.fits_with_effects[kept_of(subset)] = fits[subset];
  for (std::size_t subset = 0; subset < subsets; ++subset) {
    if (!fits[subset].ok) return {};
    fitted[subset] = fits[subset].fit_residual;
    held_out[subset] = fits[subset].held_out_residual;
  }
  constexpr unsigned kSeed = 1;
  Shares result;
  const std::vector<ShareInterval> in_fit =
      share_intervals(fitted, levels(state.found.noise), kSeed);
  if (in_fit.empty()) return {};
  result.has_held_out = state.found.final_held_out.count > 0;
  const std::vector<ShareInterval> later =
      result.has_held_out ? share_intervals(held_out, levels(state.found.noise), kSeed)
                          : std::vector<ShareInterval>(in_fit.size());
  if (later.empty()) return {};
  for (std::size_t i = 0; i < effects.size(); ++i)
    result.effects.push_back({effects[i], in_fit[i], later[i]});
  result.left_fitted = in_fit.back();
  result.left_held_out = later.back();
  return result;
}

}  // namespace catena
