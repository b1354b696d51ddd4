// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/estimate_noise.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "identify/noise/drawn_noise.hpp"
#include "tests/support/near.hpp"

namespace {

using catena::NoiseModel;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSigma = 1e-3;
const double kNan = std::nan("");

MatrixXd white(Index channels, Index frames, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> gauss(0, kSigma);
  return MatrixXd::NullaryExpr(channels, frames, [&] { return gauss(random); });
}

/// Of every channel: a moving average, or an autoregression of order 1.
MatrixXd smoothed(const MatrixXd& noise, Index frames) {
  MatrixXd out(noise.rows(), noise.cols() - frames + 1);
  for (Index k = 0; k < out.cols(); ++k) out.col(k) = noise.middleCols(k, frames).rowwise().mean();
  return out;
}
MatrixXd regressed(MatrixXd noise, double a) {
  for (Index k = 1; k < noise.cols(); ++k)
    noise.col(k) = a * noise.col(k - 1) + std::sqrt(1 - a * a) * noise.col(k);
  return noise;
}

MatrixXd swing(Index channels, Index frames, double size, double hertz) {
  MatrixXd motion(channels, frames);
  for (Index c = 0; c < channels; ++c)
    for (Index k = 0; k < frames; ++k)
      motion(c, k) = size * std::sin(2 * std::numbers::pi * hertz * static_cast<double>(k) / 60 +
                                     static_cast<double>(c) / 24);
  return motion;
}

/// Recorded at 60 frames per second, side and down in turns, the motion at 1.5 Hz.
NoiseModel estimated(const MatrixXd& residual, double hertz = 1.5) {
  const Index frames = residual.cols();
  catena::NoiseWindow window{
      residual, swing(residual.rows(), frames, 0.1, hertz), {}, frames, frames};
  for (Index k = 0; k < frames; ++k) window.time.push_back(static_cast<double>(k) / 60);
  std::vector<int> direction;
  for (Index c = 0; c < residual.rows(); ++c) direction.push_back(static_cast<int>(c % 2));
  return catena::estimate_noise({window}, direction)[0];
}

bool says(const NoiseModel& noise, const std::string& what) {
  const auto words = noise.words();
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& each) { return each.find(what) != std::string::npos; });
}

}  // namespace

TEST_CASE("the noise level is found under a smooth misfit of ten times its size") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const MatrixXd noise = white(24, 240, seed);
    CHECK(estimated(noise).level == catena::near(kSigma, 0.05));
    const NoiseModel under = estimated(noise + swing(24, 240, 1e-2, 1.5));
    CHECK(under.level == catena::near(kSigma, 0.05));
    CHECK(under.shape.white());
    CHECK(under.words().empty());
  }
}

TEST_CASE("lost markers do not disturb the noise level") {
  MatrixXd noise = white(24, 240, 6);
  for (Index k = 0; k < 240; k += 13)
    for (Index c = 0; c < 24; c += 5) noise(c, k) = kNan;
  CHECK(estimated(noise).level == catena::near(kSigma, 0.06));
}

TEST_CASE("smoothed tracks are told from white noise, and over how many frames") {
  const NoiseModel noise = estimated(smoothed(white(24, 246, 7), 5));
  CHECK(noise.shape.smoothing().frames() == 5);
  CHECK(says(noise, "smoothed over 5 frames (moving average)"));
}

TEST_CASE("correlated noise is found and made white, with missing frames too") {
  for (const double lost : {0.0, 0.1}) {
    CAPTURE(lost);
    MatrixXd residual = regressed(white(24, 400, 8), 0.6);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform;
    for (double& value : residual.reshaped())
      if (uniform(random) < lost) value = kNan;
    const NoiseModel noise = estimated(residual);
    CHECK(noise.level == catena::near(kSigma, 0.08));
    CHECK(noise.shape.autocorrelation(1)[1] == catena::near(0.6, 0.12));
    const MatrixXd z = noise.whitened(residual);
    double squares = 0, count = 0;
    for (const double value : z.reshaped())
      if (!std::isnan(value)) squares += value * value, count += 1;
    CHECK(squares / count == catena::near(1, 0.05));
    for (const Index lag : {1, 2, 3}) {
      double products = 0, pairs = 0;
      for (Index c = 0; c < z.rows(); ++c)
        for (Index k = 0; k + lag < z.cols(); ++k)
          if (const double p = z(c, k) * z(c, k + lag); !std::isnan(p)) products += p, pairs += 1;
      CHECK(std::abs(products / pairs) < 0.06);
    }
  }
}

TEST_CASE("noise as slow as motion is said to be so") {
  const std::string slow = "may as well be a motion that the model lacks";
  CHECK(says(estimated(regressed(white(24, 400, 8), 0.95)), slow));
  CHECK_FALSE(says(estimated(regressed(white(24, 400, 8), 0.6)), slow));
}

TEST_CASE("a misfit with kinks is no slow noise, as neighbouring markers share it") {
  // As of a string that pulls on one side only: modes of the cable, cut off where it is slack.
  const Index frames = 240;
  MatrixXd residual = white(24, frames, 16);
  for (Index c = 0; c < 24; ++c)
    for (Index k = 0; k < frames; ++k)
      for (int mode = 0; mode < 6; ++mode) {
        const Index marker = c / 2 + 1;
        const double place = static_cast<double>(marker) / 12;
        const double angle =
            (0.7 + 1.6 * mode) * 2 * std::numbers::pi * static_cast<double>(k) / 60;
        residual(c, k) += 8e-3 / (1 + mode) * std::sin((mode + 0.5) * std::numbers::pi * place) *
                          std::max(0.0, std::sin(angle + mode + 0.3 * static_cast<double>(c % 2)));
      }
  const NoiseModel noise = estimated(residual);
  CHECK_FALSE(noise.told);
  CHECK(noise.level < 1.5 * kSigma);
  // Noise as slow as that is none of the mechanics: every marker has its own.
  const NoiseModel slow = estimated(regressed(white(24, frames, 16), 0.95));
  CHECK(slow.told);
  CHECK(slow.shape.autocorrelation(1)[1] > 0.8);
}

TEST_CASE("every channel has noise of its own") {
  MatrixXd residual = white(24, 240, 9);
  residual.row(5) *= 3;
  const NoiseModel noise = estimated(residual);
  CHECK(noise.sigma[5] == catena::near(3e-3, 0.15));
  CHECK(noise.sigma[6] == catena::near(1e-3, 0.15));
  CHECK(says(noise, "the noisiest channel"));
}

TEST_CASE("a camera that shakes is found, and taken out") {
  MatrixXd residual = white(24, 240, 10);
  const MatrixXd shake = white(1, 240, 11);
  for (Index c = 0; c < 24; c += 2) residual.row(c) += shake;
  const NoiseModel noise = estimated(residual);
  CHECK(noise.common[0] == catena::near(kSigma, 0.2));
  CHECK(noise.common[1] == 0);
  CHECK(noise.sigma[0] == catena::near(kSigma, 0.15));
  const MatrixXd z = noise.whitened(residual);
  double between = 0;
  for (Index a = 0; a < 24; a += 2)
    for (Index b = 0; b < a; b += 2) between += z.row(a).dot(z.row(b)) / 240.0 / 66;
  CHECK(std::abs(between) < 0.03);
}

TEST_CASE(
    "a short film does not make channels differ that are alike, nor those of a camera that "
    "shakes") {
  for (unsigned seed = 20; seed < 30; ++seed) {
    MatrixXd residual = white(24, 42, seed);
    const MatrixXd shake = white(1, 42, seed + 100);
    for (Index c = 0; c < 24; c += 2) residual.row(c) += shake;
    const NoiseModel noise = estimated(residual);
    REQUIRE(noise.told);
    CHECK(noise.sigma.maxCoeff() < 2 * noise.sigma.minCoeff());
    CHECK(noise.level < 1.6 * kSigma);
  }
}

TEST_CASE("noise that is drawn is that of the model") {
  NoiseModel model;
  model.sigma = VectorXd::Constant(24, kSigma);
  model.sigma[5] = 3 * kSigma;
  model.common = VectorXd::Zero(24);
  for (int c = 0; c < 24; ++c) {
    model.direction.push_back(c % 2);
    if (c % 2 == 0) model.common[c] = kSigma;
  }
  model.shape.partial = {0.6};
  std::mt19937_64 random(19);
  const NoiseModel noise = estimated(catena::drawn_noise(model, 24, 600, random));
  CHECK(noise.shape.autocorrelation(1)[1] == catena::near(0.6, 0.12));
  CHECK(noise.sigma[5] == catena::near(3 * kSigma, 0.2));
  CHECK(noise.sigma[6] == catena::near(kSigma, 0.2));
  CHECK(noise.common[0] == catena::near(kSigma, 0.3));
  CHECK(noise.common[1] == 0);
}

TEST_CASE("values far off are left out and counted, heavy tails are seen") {
  MatrixXd residual = white(24, 240, 12);
  for (const Index k : {30, 90, 95, 200}) residual(7, k) += 0.02;
  const NoiseModel noise = estimated(residual);
  CHECK(noise.outliers == 4);
  CHECK(std::isnan(noise.whitened(residual)(7, 90)));
  CHECK(noise.level == catena::near(kSigma, 0.05));
  CHECK(noise.excess_kurtosis == 0);
  std::mt19937_64 random(13);
  std::student_t_distribution<double> student(5);
  const MatrixXd heavy = MatrixXd::NullaryExpr(24, 240, [&] { return kSigma * student(random); });
  CHECK(estimated(heavy).degrees_of_freedom() < 15);
}

TEST_CASE("where the motion has all frequencies the noise cannot be told") {
  MatrixXd residual = white(24, 240, 14);
  MatrixXd rough = white(24, 240, 15) * 100;  // what was predicted
  catena::NoiseWindow window{residual + rough, rough, {}, 240, 240};
  for (int k = 0; k < 240; ++k) window.time.push_back(k / 60.0);
  const NoiseModel noise = catena::estimate_noise({window}, std::vector<int>(24, -1))[0];
  CHECK_FALSE(noise.told);
  CHECK(says(noise, "cannot be told"));
}
