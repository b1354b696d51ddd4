// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/noise_model.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kLags = 30;  // of the whitening: a smoothed track needs more than an autoregression
/// Robust standard deviations from what the neighbours say: 1 of 10^9 values of normal noise.
constexpr double kOutlier = 6;
/// Largest power of a misfit, over its noise, at a frequency that shows the noise.
constexpr double kMisfitInBand = 0.1;
/// A misfit has the spectrum of the motion, up to so many times more at some frequencies.
constexpr double kMisfitElsewhere = 10;
/// Smallest share of the frequencies from which the others are extrapolated.
constexpr double kFewestFrequencies = 0.25;
/// Of the power at other frequencies: there is more of what leaks than of noise.
constexpr double kFaint = 0.05;
/// Squared coherence of channels, beyond chance: a third of their power is misfit.
constexpr double kCoherent = 0.1;
/// Channels of a direction, from which on their coherence tells.
constexpr Index kFewestCompared = 4;
/// Shape, sizes and what is filled in need each other.
constexpr int kRounds = 3;
/// With which frames that were not seen are filled in first: slightly smoothed. Filled in as for white
/// noise, smoothed tracks would look rough.
const NoiseShape kFirstShape = {1, {}};
/// Standard deviations, from which on a common mode is believed.
constexpr double kCommonSeen = 4;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Numbers of frames, in steps of the frame rate. Where time has no such steps: 0, 1, 2, ...
std::vector<int> frame_numbers(const std::vector<double>& time) {
  std::vector<int> numbers(time.size());
  std::vector<double> gaps;
  for (std::size_t k = 1; k < time.size(); ++k) gaps.push_back(time[k] - time[k - 1]);
  const double step = gaps.empty() ? 1 : median(gaps);
  bool regular = true;
  for (std::size_t k = 1; k < time.size(); ++k) {
    const double steps = std::round((time[k] - time[k - 1]) / step);
    regular = regular && steps >= 1 && steps < 1000;
    numbers[k] = numbers[k - 1] + (regular ? static_cast<int>(steps) : 0);
  }
  if (!regular)
    for (std::size_t k = 0; k < time.size(); ++k) numbers[k] = static_cast<int>(k);
  return numbers;
}

/// The columns at their frames; NaN in frames that are missing.
MatrixXd on_grid(const MatrixXd& matrix, const std::vector<int>& frame) {
  if (matrix.cols() == 0) return matrix;
  const int last = frame[static_cast<std::size_t>(matrix.cols() - 1)];
  MatrixXd grid = MatrixXd::Constant(matrix.rows(), last + 1, kNaN);
  for (Index k = 0; k < matrix.cols(); ++k)
    grid.col(frame[static_cast<std::size_t>(k)]) = matrix.col(k);
  return grid;
}

/// What the two values seen before and the two seen after a frame say of it: the cubic through them.
/// `weight` is the root of one and the sum of the squared weights. NaN where there are not as many
/// close by.
double interpolated(const VectorXd& values, Index at, double* weight = nullptr) {
  constexpr Index kReach = 4;
  Index places[4] = {-1, -1, -1, -1};
  int before = 0, after = 0;
  for (Index k = at - 1; k >= std::max<Index>(0, at - kReach) && before < 2; --k)
    if (!std::isnan(values[k])) places[before++] = k;
  for (Index k = at + 1; k < std::min(values.size(), at + kReach + 1) && after < 2; ++k)
    if (!std::isnan(values[k])) places[2 + after++] = k;
  if (before < 2 || after < 2) return kNaN;
  double sum = 0, squares = 1;
  for (const Index i : places) {
    double w = 1;
    for (const Index j : places)
      if (j != i) w *= static_cast<double>(at - j) / static_cast<double>(i - j);
    sum += w * values[i];
    squares += w * w;
  }
  if (weight) *weight = std::sqrt(squares);
  return sum;
}

/// Distance of a value from what its neighbours say, over that of white noise of variance 1.
double roughness(const VectorXd& values, Index at) {
  double weight = 1;
  return (values[at] - interpolated(values, at, &weight)) / weight;
}

/// Takes out single values far from what their neighbours say, the farthest first: it makes its
/// neighbours look wrong.
long take_out_outliers(MatrixXd& grid) {
  long count = 0;
  for (Index c = 0; c < grid.rows(); ++c) {
    VectorXd values = grid.row(c);
    VectorXd rough(values.size());
    std::vector<double> sizes;
    for (Index k = 0; k < values.size(); ++k) {
      rough[k] = std::abs(roughness(values, k));
      if (std::isnan(rough[k]))
        rough[k] = 0;
      else
        sizes.push_back(rough[k]);
    }
    if (sizes.size() < 20) continue;
    const double limit = kOutlier * median(sizes) / 0.6745;
    if (!(limit > 0)) continue;
    Index worst = 0;
    while (rough.maxCoeff(&worst) > limit) {
      values[worst] = kNaN;
      rough[worst] = 0;
      ++count;
      for (Index k = std::max<Index>(0, worst - 5); k < std::min(values.size(), worst + 6); ++k)
        if (const double r = std::abs(roughness(values, k)); rough[k] > 0)
          rough[k] = std::isnan(r) ? 0 : r;
    }
    grid.row(c) = values;
  }
  return count;
}

/// Fills what was not seen: with the best linear estimate from the frames around it, for noise of a
/// shape on top of any cubic; linearly where too few are seen around it.
class Filler {
 public:
  explicit Filler(const NoiseShape& shape) : correlation_(shape.autocorrelation(2 * kReach)) {}

  VectorXd operator()(const VectorXd& values) {
    VectorXd full = values;
    Index before = -1;
    for (Index k = 0; k < values.size(); ++k) {
      if (!std::isnan(values[k])) {
        before = k;
        continue;
      }
      unsigned seen = 0;
      for (int i = 0; i <= 2 * kReach; ++i)
        if (const Index at = k + i - kReach;
            at >= 0 && at < values.size() && !std::isnan(values[at]))
          seen |= 1u << i;
      if (const VectorXd& weights = weights_for(seen); weights.size() > 0) {
        full[k] = 0;
        for (int i = 0; i <= 2 * kReach; ++i)
          if (seen >> i & 1u) full[k] += weights[i] * values[k + i - kReach];
        continue;
      }
      Index after = k;
      while (after < values.size() && std::isnan(values[after])) ++after;
      const bool first = before < 0, last = after == values.size();
      if (first && last) return VectorXd::Zero(values.size());
      const double share =
          first || last ? 0 : static_cast<double>(k - before) / static_cast<double>(after - before);
      full[k] = first  ? values[after]
                : last ? values[before]
                       : (1 - share) * values[before] + share * values[after];
    }
    return full;
  }

 private:
  static constexpr int kReach = 7;  // frames on each side

  const VectorXd& weights_for(unsigned seen) {
    const auto [place, added] = weights_.try_emplace(seen);
    std::vector<int> at;
    for (int i = 0; i <= 2 * kReach; ++i)
      if (seen >> i & 1u) at.push_back(i);
    if (!added || at.size() < 8 || at.front() >= kReach || at.back() <= kReach)
      return place->second;
    const auto n = static_cast<Index>(at.size());
    MatrixXd matrix = MatrixXd::Zero(n + 4, n + 4);
    VectorXd right = VectorXd::Zero(n + 4);
    right[n] = 1;
    for (Index a = 0; a < n; ++a) {
      const int i = at[static_cast<std::size_t>(a)];
      right[a] = correlation_[std::abs(i - kReach)];
      for (Index b = 0; b < n; ++b)
        matrix(a, b) = correlation_[std::abs(i - at[static_cast<std::size_t>(b)])];
      for (int power = 0; power < 4; ++power)
        matrix(a, n + power) = matrix(n + power, a) =
            std::pow(static_cast<double>(i - kReach) / kReach, power);
    }
    const VectorXd solved = matrix.fullPivLu().solve(right);
    place->second = VectorXd::Zero(2 * kReach + 1);
    for (Index a = 0; a < n; ++a) place->second[at[static_cast<std::size_t>(a)]] = solved[a];
    return place->second;
  }

  VectorXd correlation_;
  std::map<unsigned, VectorXd> weights_;
};

/// Tapered segments of all windows.
class Segments {
 public:
  Segments(const std::vector<MatrixXd>& residuals, const std::vector<MatrixXd>& predictions,
           const NoiseShape& shape, const VectorXd& taper) {
    const auto length = static_cast<int>(taper.size());
    Filler filled(shape);
    double all = 0;
    const int bins = length / 2 + 1;
    waves_.resize(length, bins);
    for (int k = 0; k < length; ++k)
      for (int j = 0; j < bins; ++j)
        waves_(k, j) = taper[k] * std::polar(1.0, -2 * std::numbers::pi * j * k / length);
    for (std::size_t w = 0; w < residuals.size(); ++w) {
      const Index frames = residuals[w].cols();
      if (frames < length) continue;
      const Index steps = (3 * (frames - length) + length - 1) / length;
      MatrixXd full(residuals[w].rows(), frames), motion = full;
      for (Index c = 0; c < full.rows(); ++c) {
        full.row(c) = filled(residuals[w].row(c));
        motion.row(c) = filled(predictions[w].row(c));
        seen += static_cast<double>(
            (residuals[w].row(c).array() == residuals[w].row(c).array()).count());
      }
      all += static_cast<double>(full.size());
      for (Index s = 0; s <= steps; ++s) {
        const Index first = steps > 0 ? s * (frames - length) / steps : 0;
        residual.push_back(transformed(full.middleCols(first, length)));
        const MatrixXd p = transformed(motion.middleCols(first, length)).cwiseAbs2();
        if (motion_power.size() == 0) motion_power = MatrixXd::Zero(p.rows(), p.cols());
        motion_power += p;
      }
    }
    motion_power /= static_cast<double>(residual.size());
    // What was filled lacks what its neighbours do not tell.
    const double lacks = (1 - seen / all) * shape.unpredictable();
    for (MatrixXcd& x : residual) x /= std::sqrt(1 - lacks);
  }

  std::vector<MatrixXcd> residual;  ///< channels x frequencies
  MatrixXd motion_power;            ///< channels x frequencies
  double seen = 0;                  ///< residuals

  /// Mean power of the residuals, channels x frequencies.
  MatrixXd power() const {
    MatrixXd sum = MatrixXd::Zero(motion_power.rows(), motion_power.cols());
    for (const MatrixXcd& x : residual) sum += x.cwiseAbs2();
    return sum / static_cast<double>(residual.size());
  }

 private:
  MatrixXcd transformed(MatrixXd values) const {
    const Index n = values.cols();
    const VectorXd slope = VectorXd::LinSpaced(n, -1, 1);
    for (Index c = 0; c < values.rows(); ++c) {
      VectorXd row = values.row(c);
      row.array() -= row.mean();
      row -= row.dot(slope) / slope.squaredNorm() * slope;
      values.row(c) = row;
    }
    return values * waves_;
  }
  MatrixXcd waves_;
};

/// The frequencies at which a misfit has little power beside the noise. A misfit has the spectrum of
/// the motion, and no more power than the residuals.
std::vector<bool> free_of_motion(const VectorXd& power, const VectorXd& motion) {
  const Index bins = power.size();
  const double part =
      motion.sum() > 0 ? std::min(1.0, kMisfitElsewhere * power.sum() / motion.sum()) : 0;
  std::vector<bool> use(static_cast<std::size_t>(bins), true);
  use[0] = use[1] = use[2] = use.back() = false;  // what the taper leaks of a drift
  double sum = 0;
  for (Index j = 0; j < bins; ++j) {
    const bool main = sum < 0.99 * motion.sum();
    sum += motion[j];
    const double level =
        power.segment(std::max<Index>(0, j - 1), std::min<Index>(3, bins - j)).mean();
    if (!main && part * motion[j] < kMisfitInBand * level) continue;
    for (Index i = std::max<Index>(0, j - 1); i <= std::min(bins - 1, j + 1); ++i)
      use[static_cast<std::size_t>(i)] = false;
  }
  return use;
}

/// x of one frame and direction with unit own noise and loadings a: (1 + a a^T)^(-1/2) x.
template <class Vector>
void take_out_common(Vector& x, const VectorXd& a) {
  const double square = a.squaredNorm();
  if (square > 0) x -= (1 - 1 / std::sqrt(1 + square)) / square * a.dot(x) * a;
}

/// Variance of white noise from differences of orders 2 to 6, which wipe out what is smooth: the
/// smallest, for a higher order wipes out more and a lower one is surer. The median over blocks of
/// frames keeps short events from counting as noise.
double difference_variance(const std::vector<MatrixXd>& grids) {
  constexpr int kBlock = 40;
  double smallest = kNaN;
  for (int order = 2; order <= 6; ++order) {
    VectorXd weights = VectorXd::Ones(1);
    for (int i = 0; i < order; ++i) {
      VectorXd next = VectorXd::Zero(weights.size() + 1);
      next.head(weights.size()) += weights;
      next.tail(weights.size()) -= weights;
      weights = next;
    }
    weights.normalize();
    double correlations = 0;  // sum of the squared correlations of differences
    for (int lag = -order; lag <= order; ++lag) {
      const int n = order + 1 - std::abs(lag);
      correlations += std::pow(weights.head(n).dot(weights.tail(n)), 2);
    }
    std::vector<double> blocks;
    double all = 0, count = 0;
    for (const MatrixXd& grid : grids)
      for (Index c = 0; c < grid.rows(); ++c) {
        double sum = 0;
        int in_block = 0;
        for (Index k = 0; k + order < grid.cols(); ++k) {
          const double difference = grid.row(c).segment(k, order + 1).dot(weights);
          if (std::isnan(difference)) continue;
          sum += difference * difference;
          all += difference * difference;
          count += 1;
          if (++in_block < kBlock) continue;
          blocks.push_back(sum / kBlock);
          sum = 0;
          in_block = 0;
        }
      }
    if (count < 20) continue;
    // The median of chi-square(nu)/nu is (1 - 2/(9 nu))^3.
    const double variance = blocks.size() < 5
                                ? all / count
                                : median(blocks) / std::pow(1 - 2 * correlations / (9 * kBlock), 3);
    if (!(smallest <= variance)) smallest = variance;
  }
  return smallest;
}

/// Towards their mean, as far as their scatter is that of estimates from `count` values each.
VectorXd shrunk(const VectorXd& variances, double count) {
  const VectorXd logarithms = variances.array().log();
  const double mean = logarithms.mean(), error = 2 / count;
  const double scatter = (logarithms.array() - mean).square().sum() /
                         static_cast<double>(std::max<Index>(1, logarithms.size() - 1));
  const double real = std::max(0.0, 1 - error / scatter);
  return (mean + real * (logarithms.array() - mean)).exp();
}

class Estimate {
 public:
  Estimate(const Segments& segments, const ExpectedPower& expected,
           const std::vector<int>& direction)
      : segments_(segments), direction_(direction), expected_(expected) {}

  /// Shape, then sizes, of noise whose sizes were known roughly; the first time, not at all. False
  /// if the motion fills the band.
  bool into(NoiseModel& noise) {
    const MatrixXd power = segments_.power();
    const Index channels = power.rows(), bins = power.cols();
    const VectorXd variance = power.rightCols(bins / 2).rowwise().mean();
    if (!(variance.minCoeff() > 0)) return false;
    const VectorXd per_channel = variance.cwiseInverse() / static_cast<double>(channels);
    use_ = free_of_motion(power.transpose() * per_channel,
                          segments_.motion_power.transpose() * per_channel);
    const bool compared = leave_out_coherent(variance.cwiseSqrt());
    double used = 0;
    for (const bool u : use_) used += u;
    if (used < kFewestFrequencies * static_cast<double>(bins)) return false;
    share_ = used / static_cast<double>(bins);
    if (noise.sigma.size() == 0) {
      noise.sigma = variance.cwiseSqrt();
      noise.common = VectorXd::Zero(channels);
    }
    noise.shape = fit_noise_shape(expected_, whitened_power(noise), use_, segments_.seen, compared);
    find_sizes(noise);
    return true;
  }

 private:
  /// Noise of different channels has nothing in common but a common mode. Where they do have, there is
  /// misfit: what is below such a frequency is no noise to learn from. False where no direction has
  /// enough channels to compare.
  bool leave_out_coherent(const VectorXd& sigma) {
    bool compared = false;
    Index first = 0;
    for (const int d : {-1, 0, 1}) {
      std::vector<Index> group;
      for (Index c = 0; c < sigma.size(); ++c)
        if (direction_[static_cast<std::size_t>(c)] == d) group.push_back(c);
      const auto n = static_cast<Index>(group.size());
      if (n < kFewestCompared) continue;
      compared = true;
      const auto bins = static_cast<Index>(use_.size());
      std::vector<MatrixXcd> products(use_.size(), MatrixXcd::Zero(n, n));
      for (const MatrixXcd& x : segments_.residual)
        for (Index j = 0; j < bins; ++j) {
          VectorXcd y = x.col(j)(group).cwiseQuotient(sigma(group));
          y.array() -= y.mean();
          products[static_cast<std::size_t>(j)] += y * y.adjoint();
        }
      // Independent values in five neighbouring frequencies.
      const double count = 5 * segments_.seen / static_cast<double>(sigma.size()) /
                           (2 * static_cast<double>(bins - 1));
      // From below: there is misfit beside the motion, and between the lobes of a smoothing what leaks.
      for (Index j = 2; j + 2 < bins; ++j) {
        if (!use_[static_cast<std::size_t>(j)]) continue;
        MatrixXcd sum = MatrixXcd::Zero(n, n);
        for (Index i = j - 2; i <= j + 2; ++i) sum += products[static_cast<std::size_t>(i)];
        double coherence = 0;
        for (Index a = 0; a < n; ++a)
          for (Index b = 0; b < a; ++b)
            coherence += std::norm(sum(a, b)) / (sum(a, a).real() * sum(b, b).real());
        coherence /= static_cast<double>(n * (n - 1) / 2);
        if (coherence < 1 / count + kCoherent) break;
        first = std::max(first, j + 1);
      }
    }
    for (Index j = 0; j < first; ++j) use_[static_cast<std::size_t>(j)] = false;
    return compared;
  }

  /// Over the channels, once their sizes and what they share are taken out.
  VectorXd whitened_power(const NoiseModel& noise) const {
    VectorXd sum = VectorXd::Zero(segments_.motion_power.cols());
    for (const MatrixXcd& x : segments_.residual)
      for (Index j = 0; j < x.cols(); ++j) {
        VectorXcd y = x.col(j).cwiseQuotient(noise.sigma);
        for (const int d : {0, 1}) {
          const VectorXd a = loadings(noise, d);
          const VectorXd real = y.real(), imaginary = y.imag();
          VectorXd parts[2] = {real, imaginary};
          for (VectorXd& part : parts) take_out_common(part, a);
          y.real() = parts[0];
          y.imag() = parts[1];
        }
        sum[j] += y.squaredNorm() / static_cast<double>(y.size());
      }
    return sum / static_cast<double>(segments_.residual.size());
  }

  VectorXd loadings(const NoiseModel& noise, int direction) const {
    VectorXd a = VectorXd::Zero(noise.sigma.size());
    for (Index c = 0; c < a.size(); ++c)
      if (direction_[static_cast<std::size_t>(c)] == direction)
        a[c] = noise.common[c] / noise.sigma[c];
    return a;
  }

  void find_sizes(NoiseModel& noise) const {
    const VectorXd e = expected_(noise.shape);
    const Index channels = noise.sigma.size();
    MatrixXd covariance = MatrixXd::Zero(channels, channels);
    double terms = 0;
    double largest = 0;
    for (Index j = 0; j < e.size(); ++j)
      if (use_[static_cast<std::size_t>(j)]) largest = std::max(largest, e[j]);
    for (const MatrixXcd& x : segments_.residual)
      for (Index j = 0; j < e.size(); ++j)
        if (use_[static_cast<std::size_t>(j)] && e[j] > kFaint * largest) {
          covariance += (x.col(j) * x.col(j).adjoint()).real() / e[j];
          terms += 1;
        }
    covariance /= terms;
    // Real values that stand behind each variance.
    const double count = share_ * segments_.seen / static_cast<double>(channels);
    VectorXd variance = covariance.diagonal();
    noise.common.setZero();
    for (const int d : {0, 1}) {
      double weights = 0, sum = 0;
      for (Index a = 0; a < channels; ++a)
        for (Index b = 0; b < a; ++b) {
          if (direction_[static_cast<std::size_t>(a)] != d ||
              direction_[static_cast<std::size_t>(b)] != d)
            continue;
          const double weight = 1 / (covariance(a, a) * covariance(b, b));
          weights += weight;
          sum += weight * covariance(a, b);
        }
      const double shared = weights > 0 ? sum / weights : 0;
      if (!(shared * std::sqrt(weights * count) > kCommonSeen)) continue;
      for (Index c = 0; c < channels; ++c)
        if (direction_[static_cast<std::size_t>(c)] == d) {
          noise.common[c] = std::sqrt(shared);
          variance[c] = std::max(variance[c] - shared, 0.05 * variance[c]);
        }
    }
    noise.sigma = shrunk(variance, count).cwiseSqrt();
  }

  const Segments& segments_;
  const std::vector<int>& direction_;
  const ExpectedPower& expected_;
  std::vector<bool> use_;
  double share_ = 0;
};

/// The best linear predictions of a frame from those seen before it.
class Filters {
 public:
  explicit Filters(const NoiseShape& shape)
      : lags_(shape.white() ? 0 : kLags), correlation_(shape.autocorrelation(kLags)) {}

  /// NoiseModel::pattern of a window whose columns are at `frame` in `grid`. What is held out is
  /// predicted from itself only.
  Eigen::MatrixXi patterns(const MatrixXd& grid, const std::vector<int>& frame, Index fitted,
                           std::vector<NoiseModel::Filter>& filters) const {
    std::map<unsigned, int> numbers;
    Eigen::MatrixXi pattern =
        Eigen::MatrixXi::Constant(grid.rows(), static_cast<Index>(frame.size()), -1);
    for (Index c = 0; c < pattern.rows(); ++c) {
      unsigned before = 0;  // bit i: the frame i frames before was seen
      int last = 0;
      for (Index k = 0; k < pattern.cols(); ++k) {
        const int number = frame[static_cast<std::size_t>(k)], steps = number - last;
        before = steps > kLags || k == fitted ? 0 : before << steps;
        last = number;
        if (std::isnan(grid(c, number))) continue;
        const unsigned known = before >> 1 & ((1u << lags_) - 1);
        const auto [place, added] = numbers.try_emplace(known, static_cast<int>(filters.size()));
        if (added) filters.push_back(filter_of(known));
        pattern(c, k) = place->second;
        before |= 1;
      }
    }
    return pattern;
  }

 private:
  NoiseModel::Filter filter_of(unsigned known) const {
    std::vector<int> lags;
    for (int lag = 1; lag <= lags_; ++lag)
      if (known >> (lag - 1) & 1u) lags.push_back(lag);
    const auto n = static_cast<Index>(lags.size());
    MatrixXd matrix(n, n);
    VectorXd right(n);
    for (Index a = 0; a < n; ++a) {
      const int lag = lags[static_cast<std::size_t>(a)];
      right[a] = correlation_[lag];
      for (Index b = 0; b < n; ++b)
        matrix(a, b) = correlation_[std::abs(lag - lags[static_cast<std::size_t>(b)])];
    }
    NoiseModel::Filter filter{VectorXd::Zero(lags_), 1};
    if (n == 0) return filter;
    const VectorXd solved = matrix.ldlt().solve(right);
    for (Index a = 0; a < n; ++a)
      filter.coefficients[lags[static_cast<std::size_t>(a)] - 1] = solved[a];
    filter.deviation = std::sqrt(std::max(1e-6, 1 - solved.dot(right)));
    return filter;
  }

  int lags_;
  VectorXd correlation_;
};

/// Excess kurtosis of the values behind whitened residuals, from their roughness: what is smooth has
/// none. A value, its two neighbours and the next two stand in it with 1, -2/3 and 1/6.
double tails_of(const std::vector<MatrixXd>& whitened) {
  constexpr double kOfSum = 0.369;  // sum of the 4th powers over the square of the sum of squares
  double squares = 0, fourth = 0, count = 0;
  for (const MatrixXd& z : whitened)
    for (Index c = 0; c < z.rows(); ++c) {
      const VectorXd row = z.row(c);
      for (Index k = 0; k < row.size(); ++k)
        if (const double rough = roughness(row, k); !std::isnan(rough))
          squares += rough * rough, fourth += std::pow(rough, 4), count += 1;
    }
  if (count < 100 || squares == 0) return 0;
  const double excess = fourth * count / (squares * squares) - 3;
  return excess > 4 * std::sqrt(24 / count) ? excess / kOfSum : 0;
}

}  // namespace

double NoiseModel::degrees_of_freedom() const {
  return excess_kurtosis > 0 ? 4 + 6 / excess_kurtosis : std::numeric_limits<double>::infinity();
}

std::vector<std::string> NoiseModel::words() const {
  std::vector<std::string> words;
  if (!told)
    words.emplace_back(
        "the motion fills the frequencies that were recorded; noise cannot be told from what the "
        "model misses");
  const SmoothingKernel& smoothing = shape.smoothing();
  if (smoothing.frames() > 1)
    words.push_back(fmt::format("the tracks look smoothed over {} frames ({})", smoothing.frames(),
                                smoothing.name));
  const double correlation = shape.autocorrelation(1)[1];
  if (smoothing.frames() == 1 && std::abs(correlation) > 0.1)
    words.push_back(
        fmt::format("the noise of neighbouring frames is correlated by {:.2g}", correlation));
  if (sigma.size() > 0 && sigma.maxCoeff() > 1.5 * sigma.minCoeff())
    words.push_back(fmt::format("the noisiest channel has {:.2g} times the noise of the quietest",
                                sigma.maxCoeff() / sigma.minCoeff()));
  if (common.size() > 0 && common.maxCoeff() > 0)
    words.push_back(fmt::format("all channels of a direction move together by {:.2g} of the noise",
                                common.maxCoeff() / level));
  if (excess_kurtosis > 0)
    words.push_back(fmt::format("heavy tails, like Student's t with {:.2g} degrees of freedom",
                                degrees_of_freedom()));
  if (outliers > 0)
    words.push_back(fmt::format("{} value{} far off", outliers, outliers == 1 ? " is" : "s are"));
  return words;
}

MatrixXd NoiseModel::whitened(const MatrixXd& matrix, Index first) const {
  MatrixXd white = MatrixXd::Constant(matrix.rows(), matrix.cols(), kNaN);
  const auto number = [&](Index k) { return frame[static_cast<std::size_t>(first + k)]; };
  for (Index c = 0; c < matrix.rows(); ++c)
    for (Index k = 0; k < matrix.cols(); ++k) {
      if (pattern(c, first + k) < 0) continue;
      const Filter& filter = filters[static_cast<std::size_t>(pattern(c, first + k))];
      double value = matrix(c, k);
      for (Index l = k - 1; l >= 0; --l) {
        const int lag = number(k) - number(l);
        if (lag > filter.coefficients.size()) break;
        if (const double b = filter.coefficients[lag - 1]; b != 0) value -= b * matrix(c, l);
      }
      white(c, k) = value / (sigma[c] * filter.deviation);
    }
  if (common.maxCoeff() == 0) return white;
  for (Index k = 0; k < white.cols(); ++k) {
    const VectorXd seen = white.col(k);
    for (const int d : {0, 1}) {
      VectorXd x = VectorXd::Zero(seen.size()), a = x;
      for (Index c = 0; c < x.size(); ++c)
        if (direction[static_cast<std::size_t>(c)] == d && !std::isnan(seen[c]))
          x[c] = seen[c], a[c] = common[c] / sigma[c];
      VectorXd rest = x;
      take_out_common(rest, a);
      white.col(k) += rest - x;
    }
  }
  return white;
}

NoiseModel white_noise(double sigma, Index channels, Index frames) {
  NoiseModel noise;
  noise.level = sigma;
  noise.sigma = VectorXd::Constant(channels, sigma);
  noise.common = VectorXd::Zero(channels);
  noise.direction.assign(static_cast<std::size_t>(channels), -1);
  noise.frame.resize(static_cast<std::size_t>(frames));
  std::iota(noise.frame.begin(), noise.frame.end(), 0);
  noise.filters = {{VectorXd(0), 1}};
  noise.pattern = Eigen::MatrixXi::Zero(channels, frames);
  return noise;
}

NoiseModels estimate_noise(const std::vector<NoiseWindow>& windows,
                           const std::vector<int>& direction, double stated) {
  NoiseModel noise;
  noise.direction = direction;
  std::vector<std::vector<int>> frames;
  std::vector<MatrixXd> grids, residuals, predictions;
  Index longest = 0;
  for (const NoiseWindow& window : windows) {
    frames.push_back(frame_numbers(window.time));
    grids.push_back(on_grid(window.residual, frames.back()));
    noise.outliers += take_out_outliers(grids.back());
    const Index shown = window.shows_noise;
    const Index last = shown > 0 ? frames.back()[static_cast<std::size_t>(shown - 1)] + 1 : 0;
    residuals.push_back(grids.back().leftCols(last));
    predictions.push_back(on_grid(window.predicted.leftCols(shown), frames.back()));
    longest = std::max(longest, last);
  }
  const int length = longest >= 512 ? 128 : longest >= 96 ? 64 : 32;
  if (longest >= length) {
    const ExpectedPower expected(length);
    noise.shape = kFirstShape;
    for (int round = 0; round < kRounds && (round == 0 || noise.told); ++round) {
      const Segments segments(residuals, predictions, noise.shape, expected.taper());
      noise.told = Estimate(segments, expected, direction).into(noise);
    }
  }
  if (!noise.told) {
    const auto channels = static_cast<Index>(direction.size());
    noise.sigma.setConstant(channels, std::sqrt(difference_variance(residuals)));
    noise.common.setZero(channels);
    noise.shape = {};
  }
  noise.level = std::sqrt((noise.sigma.cwiseAbs2() + noise.common.cwiseAbs2()).mean());
  if (stated > 0 && !(noise.level >= stated)) {
    const bool none = !(noise.level > 0);
    if (none)
      noise.sigma.setConstant(stated);
    else
      noise.sigma *= stated / noise.level, noise.common *= stated / noise.level;
    noise.level = stated;
  }

  Filters filters(noise.shape);
  NoiseModels models(windows.size(), noise);
  std::vector<MatrixXd> whitened;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    NoiseModel& model = models[w];
    model.frame = frames[w];
    model.pattern = filters.patterns(grids[w], frames[w], windows[w].fitted, model.filters);
    whitened.push_back(model.whitened(windows[w].residual.leftCols(windows[w].fitted)));
    whitened.push_back(model.whitened(
        windows[w].residual.rightCols(windows[w].residual.cols() - windows[w].fitted),
        windows[w].fitted));
  }
  const double tails = tails_of(whitened);
  for (NoiseModel& model : models) model.excess_kurtosis = tails;
  return models;
}

}  // namespace catena
