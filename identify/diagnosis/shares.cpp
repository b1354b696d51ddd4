// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/shares.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "common/parallel.hpp"
#include "identify/diagnosis/diagnosis_state.hpp"
#include "identify/diagnosis/redrawn_errors.hpp"
#include "identify/diagnosis/variant.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kDraws = 200;
constexpr double kTail = 0.025;  // at each end of an interval
constexpr int kResamples = 400;
constexpr unsigned kSeedOfShares = 1;
constexpr Index kScatterBlocks = 12;  // of a recording: fewer would say too little of their scatter
// Half the width of an interval in standard deviations of the bootstrap: Student's t of eleven degrees
// of freedom, times sqrt(12 / 11) for the mean that the blocks share. Percentiles of so few blocks
// cover 83 to 88 % only.
constexpr double kHalfWidthOfBlocks = 2.3;

/// Of every frame of all recordings in which something was measured: the sum of the squares over the noise
/// less that of noise, and the number of values.
struct FrameSums {
  VectorXd excess, count;
};

/// `noise`: its mean square that is taken off, 1 or 0.
FrameSums frame_sums(const std::vector<MatrixXd>& residuals, const std::vector<double>& sigmas,
                     double noise) {
  Index frames = 0;
  for (const MatrixXd& residual : residuals) frames += residual.cols();
  FrameSums sums{VectorXd::Zero(frames), VectorXd::Zero(frames)};
  Index frame = 0;
  for (std::size_t e = 0; e < residuals.size(); ++e)
    for (Index k = 0; k < residuals[e].cols(); ++k) {
      for (const double value : residuals[e].col(k)) {
        if (std::isnan(value)) continue;
        sums.excess[frame] += value * value / (sigmas[e] * sigmas[e]) - noise;
        sums.count[frame] += 1;
      }
      if (sums.count[frame] > 0) ++frame;
    }
  sums.excess.conservativeResize(frame);
  sums.count.conservativeResize(frame);
  return sums;
}

/// Mean over all orders of what each effect removes, then what is left, from the misfit with every
/// subset; all over the misfit without effects, if that is one.
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
  return share / (misfit[0] > 0 ? misfit[0] : std::numeric_limits<double>::quiet_NaN());
}

std::vector<FrameSums> sums_of(const SubsetResiduals& residuals, const std::vector<double>& sigmas,
                               double noise = 1) {
  std::vector<FrameSums> sums;
  for (const auto& subset : residuals) sums.push_back(frame_sums(subset, sigmas, noise));
  return sums;
}

/// With every subset; below 0 where less than noise is left. `times`: how often each frame counts.
VectorXd misfits(const std::vector<FrameSums>& sums, const VectorXd& times) {
  VectorXd misfit(static_cast<Index>(sums.size()));
  for (std::size_t s = 0; s < sums.size(); ++s)
    misfit[static_cast<Index>(s)] = sums[s].excess.dot(times) / sums[s].count.dot(times);
  return misfit;
}

VectorXd shares(const std::vector<FrameSums>& sums) {
  return shares(misfits(sums, VectorXd::Ones(sums.front().count.size())));
}

/// Shares that were drawn, one more column for every draw; without a misfit there are none.
class DrawnShares {
 public:
  void add(const VectorXd& share) {
    ++drawn_;
    if (!share.allFinite()) return;
    shares_.conservativeResize(share.size(), shares_.cols() + 1);
    shares_.rightCols(1) = share;
  }
  /// Whether fewer than half have a misfit.
  bool few() const { return 2 * shares_.cols() <= drawn_; }
  VectorXd mean() const { return shares_.rowwise().mean(); }
  VectorXd deviations() const {
    return (shares_.cwiseAbs2().rowwise().mean() - mean().cwiseAbs2()).cwiseMax(0).cwiseSqrt();
  }
  /// The share of row i that this part of them does not reach.
  double quantile(Index i, double part) const {
    VectorXd sorted = shares_.row(i);
    std::sort(sorted.begin(), sorted.end());
    return sorted[std::lround(part * static_cast<double>(sorted.size() - 1))];
  }

 private:
  Index drawn_ = 0;
  MatrixXd shares_;
};

/// In other stretches of motion.
DrawnShares shares_of_blocks(const std::vector<FrameSums>& sums) {
  const Index frames = sums.front().count.size();
  const Index length = std::max<Index>(1, frames / kScatterBlocks);
  std::mt19937_64 random(kSeedOfShares);
  DrawnShares drawn;
  for (int resample = 0; resample < kResamples; ++resample) {
    VectorXd times = VectorXd::Zero(frames);
    for (Index block = 0; block < kScatterBlocks; ++block) {
      const auto begin = static_cast<Index>(random() % static_cast<std::uint64_t>(frames));
      for (Index k = 0; k < length; ++k) times[(begin + k) % frames] += 1;
    }
    drawn.add(shares(misfits(sums, times)));
  }
  return drawn;
}

}  // namespace

std::vector<ShareInterval> share_intervals(const SubsetResiduals& residuals,
                                           const DrawnResiduals& drawn,
                                           const std::vector<double>& sigmas) {
  const std::vector<FrameSums> sums = sums_of(residuals, sigmas);
  const VectorXd estimate = shares(sums);
  DrawnShares seen, exact;
  for (const SubsetResiduals& each : drawn.with_noise) seen.add(shares(sums_of(each, sigmas)));
  for (const SubsetResiduals& each : drawn.without_noise)
    exact.add(shares(sums_of(each, sigmas, 0)));
  const DrawnShares of_blocks = shares_of_blocks(sums);
  if (seen.few() || exact.few() || of_blocks.few() || !estimate.allFinite()) return {};
  const VectorXd least = estimate - kHalfWidthOfBlocks * of_blocks.deviations();
  std::vector<ShareInterval> intervals;
  // Errors do to what is drawn what they did to the recording.
  const VectorXd both = estimate + exact.mean();
  for (Index i = 0; i < estimate.size(); ++i)
    intervals.push_back({estimate[i], both[i] - seen.quantile(i, 1 - kTail),
                         both[i] - seen.quantile(i, kTail), least[i]});
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
  const RedrawnErrors errors(fits, state.found.noise);
  DrawnResiduals fitted_again(kDraws), held_out_again(kDraws);
  state.context.begin("drawing other errors", kDraws);
  in_parallel(kDraws, state.context.threads, [&](std::size_t draw) {
    RedrawnErrors::Draw drawn = errors.draw(kSeedOfShares + draw);
    fitted_again.with_noise[draw] = std::move(drawn.with_noise.fitted);
    fitted_again.without_noise[draw] = std::move(drawn.without_noise.fitted);
    held_out_again.with_noise[draw] = std::move(drawn.with_noise.held_out);
    held_out_again.without_noise[draw] = std::move(drawn.without_noise.held_out);
    state.context.end_task();
  });
  state.context.stop_if_asked();
  const std::vector<double> sigmas = levels(state.found.noise);
  Shares result;
  const std::vector<ShareInterval> in_fit = share_intervals(fitted, fitted_again, sigmas);
  if (in_fit.empty()) return {};
  result.has_held_out = state.found.final_held_out.count > 0;
  const std::vector<ShareInterval> later = result.has_held_out
                                               ? share_intervals(held_out, held_out_again, sigmas)
                                               : std::vector<ShareInterval>(in_fit.size());
  if (later.empty()) return {};
  for (std::size_t i = 0; i < effects.size(); ++i)
    result.effects.push_back({effects[i], in_fit[i], later[i]});
  result.left_fitted = in_fit.back();
  result.left_held_out = later.back();
  return result;
}

}  // namespace catena
