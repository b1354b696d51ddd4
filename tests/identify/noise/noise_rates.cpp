// SPDX-License-Identifier: BSD-3-Clause
//
// noise_rates [--trials N] [--first SEED] [--misfit SIZE] [--markers M] [--frames F] [--recordings R]: how
// often a gap is found in noise of many kinds, as it is left by a right model and by one that misses something
// smooth of SIZE times the noise (default 0.55). Ends with status 1 if gaps are found where nothing is missing
// more often than in one of 50 recordings, beyond chance, or not found in white noise where something is.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <random>

#include "identify/diagnosis/gap_test.hpp"
#include "identify/noise/estimate_noise.hpp"
#include "linear_algebra/decompositions.hpp"

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kRate = 30, kSigma = 1e-3;
constexpr double kModes[] = {0.6, 1.5, 2.6, 3.8, 5.0};  // Hz

/// What is filmed.
struct Film {
  Index markers = 12, frames = 168;
  int recordings = 1;
  Index channels() const { return 2 * markers; }
};

struct Kind {
  const char* name;
  double autoregression = 0;
  int smoothed = 1;  // frames, Savitzky-Golay
  bool one_noisy_marker = false, shaking = false, student = false, outliers = false,
       missing = false;
};

const Kind kKinds[] = {
    {.name = "white"},
    {.name = "AR(1) 0.3", .autoregression = 0.3},
    {.name = "AR(1) 0.6", .autoregression = 0.6},
    {.name = "AR(1) 0.8", .autoregression = 0.8},
    {.name = "smoothed, 5 frames", .smoothed = 5},
    {.name = "smoothed, 9 frames", .smoothed = 9},
    {.name = "one marker, 3 times", .one_noisy_marker = true},
    {.name = "common mode", .shaking = true},
    {.name = "Student t, 4", .student = true},
    {.name = "outliers", .outliers = true},
    {.name = "5 % not seen", .missing = true},
    {.name = "all of them",
     .autoregression = 0.6,
     .smoothed = 5,
     .one_noisy_marker = true,
     .shaking = true,
     .student = true,
     .outliers = true,
     .missing = true},
};

using Random = std::mt19937_64;

VectorXd series(const Kind& kind, Index frames, Random& random) {
  std::normal_distribution<double> normal;
  std::student_t_distribution<double> student(4);
  VectorXd weights = VectorXd::Ones(1);
  for (const catena::SmoothingKernel& kernel : catena::smoothing_kernels())
    if (kernel.name == "Savitzky-Golay" && kernel.frames() == kind.smoothed)
      weights = kernel.weights;
  const double a = kind.autoregression;
  constexpr Index kBefore = 100;
  VectorXd before(kBefore + frames + weights.size());
  double value = 0;
  for (double& x : before) {
    const double draw = kind.student ? student(random) / std::numbers::sqrt2 : normal(random);
    x = value = a * value + std::sqrt(1 - a * a) * draw;
  }
  VectorXd smoothed(frames);
  for (Index k = 0; k < frames; ++k)
    smoothed[k] = before.segment(kBefore + k, weights.size()).dot(weights);
  return smoothed;
}

MatrixXd noise_of(const Kind& kind, const Film& film, Random& random) {
  MatrixXd noise(film.channels(), film.frames);
  for (Index c = 0; c < noise.rows(); ++c)
    noise.row(c) = (kind.one_noisy_marker && c / 2 == film.markers / 4 ? 3 : 1) *
                   series(kind, film.frames, random);
  if (kind.shaking)
    for (Index direction = 0; direction < 2; ++direction) {
      const VectorXd shared = series(kind, film.frames, random);
      for (Index c = direction; c < noise.rows(); c += 2) noise.row(c) += shared;
    }
  std::uniform_real_distribution<double> uniform;
  for (double& value : noise.reshaped()) {
    if (kind.outliers && uniform(random) < 1e-3) value += uniform(random) < 0.5 ? 20 : -20;
    if (kind.missing && uniform(random) < 0.05) value = std::nan("");
  }
  return kSigma * noise;
}

/// Decaying modes, and as `derivatives` what a fit may change of each: size and phase.
MatrixXd motion(const Film& film, Random& random, MatrixXd& derivatives) {
  std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
  MatrixXd sum = MatrixXd::Zero(film.channels(), film.frames);
  derivatives.resize(sum.size(), 0);
  for (int mode = 0; mode < 5; ++mode) {
    const double shift = phase(random);
    MatrixXd parts[2] = {sum, sum};
    for (Index c = 0; c < sum.rows(); ++c)
      for (Index k = 0; k < sum.cols(); ++k) {
        const double t = static_cast<double>(k) / kRate;
        const double angle = 2 * std::numbers::pi * kModes[mode] * t + shift;
        const double along = std::sin((mode + 1) * 0.13 * static_cast<double>(c / 2 + 1)) *
                             std::exp(-0.1 * (mode + 1) * t) * (c % 2 ? 0.4 : 1);
        parts[0](c, k) = along * std::cos(angle);
        parts[1](c, k) = along * std::sin(angle);
      }
    derivatives.conservativeResize(Eigen::NoChange, derivatives.cols() + 2);
    for (int p = 0; p < 2; ++p) derivatives.col(derivatives.cols() - 2 + p) = parts[p].reshaped();
    sum = sum + 0.2 / (1 + 2 * mode) * parts[0];
  }
  return sum;
}

/// One recording as a fit leaves it: residuals, and their noise as it is estimated.
std::pair<MatrixXd, catena::NoiseModel> left_by_fit(const Kind& kind, const Film& film,
                                                    Random& random, double misfit) {
  MatrixXd residual = noise_of(kind, film, random), derivatives;
  const MatrixXd predicted = motion(film, random, derivatives);
  for (Index c = 0; c < residual.rows(); ++c)
    for (Index k = 0; k < residual.cols(); ++k)
      residual(c, k) += misfit * kSigma * std::numbers::sqrt2 *
                        std::sin(2 * std::numbers::pi * static_cast<double>(k) / kRate +
                                 static_cast<double>(c) / 24);
  // What a fit would take away.
  std::vector<Index> seen;
  for (Index i = 0; i < residual.size(); ++i)
    if (!std::isnan(residual.reshaped()[i])) seen.push_back(i);
  const MatrixXd columns = derivatives(seen, Eigen::all);
  const VectorXd values = residual.reshaped()(seen);
  const VectorXd rest = values - columns * catena::least_squares(columns, values);
  for (std::size_t i = 0; i < seen.size(); ++i)
    residual.data()[seen[i]] = rest[static_cast<Index>(i)];

  catena::NoiseWindow window{residual, predicted, {}, film.frames, film.frames};
  for (Index k = 0; k < film.frames; ++k) window.time.push_back(static_cast<double>(k) / kRate);
  std::vector<int> direction;
  for (Index c = 0; c < residual.rows(); ++c) direction.push_back(static_cast<int>(c % 2));
  return {residual, catena::estimate_noise({window}, direction)[0]};
}

bool gap_found(const Kind& kind, const Film& film, std::uint64_t seed, double misfit) {
  Random random(seed);
  std::vector<MatrixXd> residuals;
  std::vector<catena::NoiseModel> noise;
  for (int recording = 0; recording < film.recordings; ++recording) {
    auto [residual, of_it] = left_by_fit(kind, film, random, misfit);
    residuals.push_back(std::move(residual));
    noise.push_back(std::move(of_it));
  }
  return catena::test_gap(residuals, noise).present;
}

/// Upper end of the 95 % interval of a rate: where so few would be found in one of 20 studies.
double upper_bound(int found, int trials) {
  double low = static_cast<double>(found) / trials, high = 1;
  while (high - low > 1e-5) {
    const double rate = (low + high) / 2;
    double as_few = 0;
    for (int k = 0; k <= found; ++k)
      as_few += std::exp(std::lgamma(trials + 1.0) - std::lgamma(k + 1.0) -
                         std::lgamma(trials - k + 1.0) + k * std::log(rate) +
                         (trials - k) * std::log1p(-rate));
    (as_few > 0.05 ? low : high) = rate;
  }
  return high;
}

}  // namespace

int main(int count, char** words) {
  int trials = 100;
  std::uint64_t first = 1;
  double misfit = 0.55;
  Film film;
  CLI::App app("how often a gap is found in noise of many kinds");
  app.add_option("--trials", trials, "recordings of each kind")->check(CLI::PositiveNumber);
  app.add_option("--first", first, "first seed");
  app.add_option("--misfit", misfit, "size of what is missing, over the noise");
  app.add_option("--markers", film.markers, "in a recording")->check(CLI::PositiveNumber);
  app.add_option("--frames", film.frames, "of a recording")->check(CLI::PositiveNumber);
  app.add_option("--recordings", film.recordings, "of one case")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, count, words);
  fmt::print("{:22}{:>12}{:>18}{:>24}\n", "noise", "false gaps", "at most (95 %)",
             fmt::format("{:g} noises found", misfit));
  bool good = true;
  for (const Kind& kind : kKinds) {
    int false_gaps = 0, found = 0;
    for (int trial = 0; trial < trials; ++trial) {
      const std::uint64_t seed = first + static_cast<std::uint64_t>(trial);
      false_gaps += gap_found(kind, film, seed, 0);
      found += gap_found(kind, film, seed, misfit);
    }
    fmt::print("{:22}{:>12}{:>16.2f} %{:>24}\n", kind.name,
               fmt::format("{} of {}", false_gaps, trials), 100 * upper_bound(false_gaps, trials),
               fmt::format("{} of {}", found, trials));
    std::fflush(stdout);
    // With all at once there are more, up to a quarter.
    if (kind.shaking && kind.smoothed > 1) continue;
    // Beyond chance: more than so many in one study of 1000, were the rate 2 %.
    const double mean = 0.02 * trials;
    good = good && false_gaps <= mean + 3.1 * std::sqrt(mean) + 1;
    if (&kind == kKinds) good = good && found >= 0.9 * trials;
  }
  return good ? 0 : 1;
}
