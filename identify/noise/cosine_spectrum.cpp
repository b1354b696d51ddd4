// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/cosine_spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

/// The frequencies around one over which the spectrum is averaged.
struct Neighbours {
  Index first, count;
};
Neighbours neighbours(Index j, Index frequencies) {
  constexpr Index kOnEachSide = 2;
  const Index first = std::max<Index>(0, j - kOnEachSide);
  return {first, std::min(frequencies - 1, j + kOnEachSide) - first + 1};
}

/// The next number with no prime factor above 5: Fourier transforms of such lengths are fast.
Index fast_length(Index length) {
  for (;; ++length) {
    Index rest = length;
    for (const Index prime : {2, 3, 5})
      while (rest % prime == 0) rest /= prime;
    if (rest <= 1) return length;
  }
}

/// exp(i pi j / (2 length)): the shift of half a frame in the cosine transform.
std::complex<double> half_frame(Index j, Index length) {
  return std::polar(1.0,
                    std::numbers::pi * static_cast<double>(j) / (2 * static_cast<double>(length)));
}

/// sqrt(2/n) sum_k x_k cos(pi j (k + 1/2) / n), and sqrt(1/n) at j = 0: orthonormal. By a Fourier
/// transform of x and its mirror image.
VectorXd cosine_transform(const VectorXd& x) {
  const Index n = x.size();
  VectorXcd mirrored(2 * n), bins;
  mirrored << x, x.reverse();
  Eigen::FFT<double> fourier;
  fourier.fwd(bins, mirrored);
  VectorXd result(n);
  for (Index j = 0; j < n; ++j)
    result[j] = (bins[j] * std::conj(half_frame(j, n))).real() /
                std::sqrt((j == 0 ? 4.0 : 2.0) * static_cast<double>(n));
  return result;
}

/// The inverse of cosine_transform.
VectorXd inverse_cosine_transform(const VectorXd& transformed) {
  const Index n = transformed.size();
  VectorXcd bins = VectorXcd::Zero(2 * n), mirrored;
  for (Index j = 0; j < n; ++j) {
    bins[j] = transformed[j] * std::sqrt((j == 0 ? 4.0 : 2.0) * static_cast<double>(n)) *
              half_frame(j, n);
    if (j > 0) bins[2 * n - j] = std::conj(bins[j]);
  }
  Eigen::FFT<double> fourier;
  fourier.inv(mirrored, bins);
  return mirrored.head(n).real();
}

}  // namespace

double normal_number(std::mt19937_64& random) {
  // Of the standard library's generators only the engine is the same everywhere.
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  const double size = std::sqrt(-2 * std::log(uniform()));
  return size * std::cos(2 * std::numbers::pi * uniform());
}

MatrixXd cosine_spectrum(const MatrixXd& series) {
  MatrixXd spectrum(fast_length(series.cols()), series.rows());
  for (Index c = 0; c < series.rows(); ++c) {
    VectorXd channel = VectorXd::Zero(spectrum.rows());
    for (Index k = 0; k < series.cols(); ++k)
      if (!std::isnan(series(c, k))) channel[k] = series(c, k);
    spectrum.col(c) = cosine_transform(channel);
  }
  return spectrum;
}

MatrixXd random_series(const MatrixXd& spectrum, Index frames, std::mt19937_64& random) {
  MatrixXd drawn = MatrixXd::Zero(spectrum.rows(), spectrum.cols());
  for (Index j = 0; j < drawn.rows(); ++j) {
    const auto [first, count] = neighbours(j, drawn.rows());
    for (Index i = first; i < first + count; ++i)
      drawn.row(j) +=
          normal_number(random) / std::sqrt(static_cast<double>(count)) * spectrum.row(i);
  }
  MatrixXd series(drawn.cols(), frames);
  for (Index c = 0; c < drawn.cols(); ++c)
    series.row(c) = inverse_cosine_transform(drawn.col(c)).head(frames);
  return series;
}

double variance_along(const MatrixXd& spectrum, const MatrixXd& other) {
  double variance = 0;
  for (Index j = 0; j < spectrum.rows(); ++j) {
    const auto [first, count] = neighbours(j, spectrum.rows());
    variance += (spectrum.middleRows(first, count) * other.row(j).transpose()).squaredNorm() /
                static_cast<double>(count);
  }
  return variance;
}

}  // namespace catena
