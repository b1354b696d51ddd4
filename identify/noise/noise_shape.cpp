// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/noise_shape.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "identify/noise/tapers.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr std::size_t kHighestOrder = 3;  // of the autoregression
constexpr double kMostCorrelated = 0.97;  // partial autocorrelations: a longer memory is motion
/// Smallest over largest power of smoothed noise. Digits, or values that were filled in, add white
/// noise to smoothed tracks.
constexpr double kFloors[] = {1e-4, 1e-2};
/// Smallest power at frequency 0 over the mean: what makes noise takes no slow noise away.
constexpr double kSlow = 0.5;
/// Fall of twice the logarithm of the likelihood, up to which data do not decide: three standard
/// deviations.
constexpr double kLeftOpen = 9;
/// The same where no autoregression explains them best, of the Bayesian information criterion: odds of 50. A gap that
/// noise may explain with more probability than one in 50 is none.
constexpr double kLeftOpenByWhite = 7.8;
/// Largest power at frequency 0, over the mean, of noise that these frequencies do not show: that of an
/// autocorrelation of 0.6. Slower noise looks like motion.
constexpr double kSlowestUnseen = 4;
/// Or so many times that of the noise that they show: from an autocorrelation of 0.65 to 0.8.
constexpr double kSlowerUnseen = 2;

VectorXd moving_average(int frames) { return VectorXd::Constant(frames, 1.0 / frames); }

VectorXd binomial(int frames) {
  VectorXd weights = VectorXd::Ones(1);
  while (weights.size() < frames) {
    VectorXd next = VectorXd::Zero(weights.size() + 1);
    next.head(weights.size()) += weights / 2;
    next.tail(weights.size()) += weights / 2;
    weights.swap(next);  // Eigen frees the old one twice if a larger copy gets no memory
  }
  return weights;
}

/// The middle of a parabola (or cubic) fitted to so many frames.
VectorXd savitzky_golay(int frames) {
  const int half = frames / 2;
  double s2 = 0, s4 = 0;
  for (int k = -half; k <= half; ++k) s2 += k * k, s4 += std::pow(k, 4);
  VectorXd weights(frames);
  for (int k = -half; k <= half; ++k)
    weights[k + half] = (s4 - s2 * k * k) / (frames * s4 - s2 * s2);
  return weights;
}

double power_at(const VectorXd& weights, double angle) {
  std::complex<double> sum = 0;
  for (Index k = 0; k < weights.size(); ++k)
    sum += weights[k] * std::polar(1.0, -angle * static_cast<double>(k));
  return std::norm(sum);
}

VectorXd smoothed_power(const SmoothingKernel& kernel, int frequencies) {
  VectorXd power(frequencies + 1);
  for (int i = 0; i <= frequencies; ++i)
    power[i] = power_at(kernel.weights, std::numbers::pi * i / frequencies);
  return power.array() + kernel.floor * power.maxCoeff();
}

/// Power of the autoregression over that of its innovations, at i / (2 frequencies) per frame.
VectorXd regressed_power(const NoiseShape& shape, int frequencies) {
  VectorXd filter(shape.partial.size() + 1);
  filter << 1, -shape.autoregression();
  VectorXd power(frequencies + 1);
  for (int i = 0; i <= frequencies; ++i)
    power[i] = 1 / power_at(filter, std::numbers::pi * i / frequencies);
  return power;
}

/// Mean of a spectrum given from frequency 0 to the highest.
double mean_power(const VectorXd& power) {
  const Index n = power.size() - 1;
  return (power.sum() - (power[0] + power[n]) / 2) / static_cast<double>(n);
}

/// Power, its mean being 1.
VectorXd spectrum(const NoiseShape& shape) {
  constexpr int kFrequencies = 1024;  // a memory of as many frames
  const VectorXd power = smoothed_power(shape.smoothing(), kFrequencies)
                             .cwiseProduct(regressed_power(shape, kFrequencies));
  return power / mean_power(power);
}

}  // namespace

const std::vector<SmoothingKernel>& smoothing_kernels() {
  static const std::vector<SmoothingKernel> kernels = [] {
    std::vector<SmoothingKernel> all = {{"", VectorXd::Ones(1), 0}};
    for (const double floor : kFloors) {
      for (const int n : {3, 5, 7}) all.push_back({"moving average", moving_average(n), floor});
      for (const int n : {3, 5, 7}) all.push_back({"binomial", binomial(n), floor});
      for (const int n : {5, 7, 9, 11}) all.push_back({"Savitzky-Golay", savitzky_golay(n), floor});
    }
    return all;
  }();
  return kernels;
}

const SmoothingKernel& NoiseShape::smoothing() const {
  return smoothing_kernels()[static_cast<std::size_t>(kernel)];
}

VectorXd NoiseShape::autoregression() const {
  VectorXd a(0);  // Durbin and Levinson
  for (const double p : partial) {
    VectorXd next(a.size() + 1);
    next << a - p * a.reverse(), p;
    a.swap(next);
  }
  return a;
}

VectorXd NoiseShape::autocorrelation(int lags) const {
  const VectorXd power = spectrum(*this);
  const int frequencies = static_cast<int>(power.size()) - 1;
  VectorXd correlation(lags + 1);
  for (int lag = 0; lag <= lags; ++lag) {
    VectorXd term = power;
    for (int i = 0; i <= frequencies; ++i)
      term[i] *= std::cos(std::numbers::pi * i * lag / frequencies);
    correlation[lag] = mean_power(term);
  }
  return correlation / correlation[0];
}

ExpectedPower::ExpectedPower(int length)
    : tapers_(slepian_tapers(length)), leakage_(length / 2 + 1, length + 1) {
  // On a grid of half the spacing the sum over frequencies is exact: the tapers end.
  for (int j = 0; j <= length / 2; ++j)
    for (int i = 0; i <= length; ++i) {
      const auto window = [&](int sign) {
        double power = 0;
        for (const auto& taper : tapers_.colwise())
          power += power_at(taper, 2 * std::numbers::pi * (j - sign * i / 2.0) / length);
        return power / static_cast<double>(tapers_.cols());
      };
      leakage_(j, i) =
          (i == 0 || i == length ? window(1) : window(1) + window(-1)) / (2.0 * length);
    }
  for (const SmoothingKernel& kernel : smoothing_kernels())
    smoothed_.push_back(smoothed_power(kernel, length));
}

VectorXd ExpectedPower::operator()(const NoiseShape& shape) const {
  const VectorXd& smoothed = smoothed_[static_cast<std::size_t>(shape.kernel)];
  const VectorXd power =
      smoothed.cwiseProduct(regressed_power(shape, static_cast<int>(smoothed.size()) - 1));
  return leakage_ * power / mean_power(power);
}

namespace {

/// Of the autoregression: power at frequency 0 over the mean.
double power_of_slow(const NoiseShape& shape) {
  double power = 1;
  for (const double p : shape.partial) power *= (1 + p) / (1 - p);
  return power;
}

}  // namespace

double NoiseShape::unpredictable() const { return 1 / mean_power(spectrum(*this).cwiseInverse()); }

namespace {

/// Whittle's likelihood of a power spectrum, `count` residuals behind it, at frequencies in `use`.
class Whittle {
 public:
  Whittle(const ExpectedPower& expected, const VectorXd& power, const std::vector<bool>& use,
          double count)
      : expected_(expected),
        power_(power),
        use_(use),
        // Complex values behind the power at one frequency.
        weight_(count / (2.0 * static_cast<double>(power.size() - 1))) {
    for (const bool u : use) used_ += u;
  }

  double count() const { return 2 * weight_ * used_; }

  /// Minus twice the logarithm of the likelihood, at the best scale.
  double operator()(const NoiseShape& shape) const {
    const VectorXd e = expected_(shape);
    if (e[0] < kSlow) return std::numeric_limits<double>::infinity();
    double logarithms = 0, ratios = 0;
    for (Index j = 0; j < power_.size(); ++j)
      if (use_[static_cast<std::size_t>(j)])
        logarithms += std::log(e[j]), ratios += power_[j] / e[j];
    return 2 * weight_ * (logarithms + used_ * std::log(ratios / used_));
  }

  /// The best autoregression of the order that `shape` has, and its value.
  double minimise(NoiseShape& shape) const {
    double here = (*this)(shape);
    for (double step = 0.4; step > 0.004; step /= 2)
      for (bool moved = true; moved;) {
        moved = false;
        for (std::size_t p = 0; p < shape.partial.size(); ++p)
          for (const double change : {step, -step}) {
            NoiseShape there = shape;
            there.partial[p] =
                std::clamp(there.partial[p] + change, -kMostCorrelated, kMostCorrelated);
            const double value = (*this)(there);
            if (value >= here) continue;
            here = value;
            shape = there;
            moved = true;
          }
      }
    return here;
  }

 private:
  const ExpectedPower& expected_;
  const VectorXd& power_;
  const std::vector<bool>& use_;
  double weight_, used_ = 0;
};

}  // namespace

NoiseShape fit_noise_shape(const ExpectedPower& expected, const VectorXd& power,
                           const std::vector<bool>& use, double count) {
  const Whittle whittle(expected, power, use, count);
  struct Fit {
    double criterion, misfit;
    NoiseShape shape;
  };
  std::vector<Fit> fits;
  const auto fit = [&](NoiseShape shape) {
    const double misfit = whittle.minimise(shape);
    const double unknowns = static_cast<double>(shape.partial.size()) + (shape.kernel > 0 ? 1 : 0);
    fits.push_back({misfit + unknowns * std::log(whittle.count()), misfit, shape});
  };
  const auto better = [](const Fit& a, const Fit& b) { return a.criterion < b.criterion; };
  for (std::size_t k = 0; k < smoothing_kernels().size(); ++k) {
    fit({static_cast<int>(k), {}});
    fit({static_cast<int>(k), {0.0}});
  }
  // More than that beside a smoothing would imitate any spectrum.
  for (NoiseShape shape = fits[1].shape; shape.partial.size() < kHighestOrder;) {
    shape.partial.push_back(0);
    fit(shape);
    shape = fits.back().shape;
  }
  const Fit chosen = *std::min_element(fits.begin(), fits.end(), better);
  // The other frequencies are extrapolated to, from noise that is not the same at all of these. As far
  // as these leave it open, it is noise that explains what is at the others, and no misfit.
  std::vector<bool> all(use.size(), true);
  all[0] = all[1] = all[2] = all.back() = false;
  const Whittle everywhere(expected, power, all, count);
  NoiseShape best = chosen.shape;
  double best_everywhere = std::numeric_limits<double>::infinity();
  for (const Fit& each : fits) {
    const double open = kLeftOpen - (each.criterion - chosen.criterion);
    const bool unseen_smoothing = chosen.shape.white() && each.shape.kernel != 0;
    if (open < 0 || unseen_smoothing) continue;
    NoiseShape furthest = each.shape;
    everywhere.minimise(furthest);
    const double slowest = std::max(kSlowestUnseen, kSlowerUnseen * power_of_slow(each.shape));
    const auto part_of = [&](double part) {
      NoiseShape between = each.shape;
      for (std::size_t p = 0; p < between.partial.size(); ++p)
        between.partial[p] += part * (furthest.partial[p] - between.partial[p]);
      return between;
    };
    double part = 1;
    while (part > 0.05 && power_of_slow(part_of(part)) > slowest) part -= 0.1;
    if (chosen.shape.partial.empty()) {  // all of it or nothing
      if (whittle(part_of(part)) - each.misfit + each.criterion - chosen.criterion >
          kLeftOpenByWhite)
        continue;
    } else {
      while (part > 0.05 && whittle(part_of(part)) - each.misfit > open) part -= 0.1;
    }
    const NoiseShape shape = part_of(std::max(0.0, part));
    const double value = everywhere(shape);
    if (value >= best_everywhere) continue;
    best_everywhere = value;
    best = shape;
  }
  return best;
}

}  // namespace catena
