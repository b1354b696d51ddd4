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

/// sqrt(2/n) sum_k x_k cos(pi j (k + 1/2) / n), and sqrt(1/n) at j = 0: orthonormal. By a Fourier
/// transform of x and its mirror image.
class CosineTransform {
 public:
  explicit CosineTransform(Index length) : factors_(length) {
    const auto n = static_cast<double>(length);
    for (Index j = 0; j < length; ++j)  // with the shift of half a frame
      factors_[j] = std::polar(std::sqrt((j == 0 ? 4.0 : 2.0) * n),
                               std::numbers::pi * static_cast<double>(j) / (2 * n));
  }

  VectorXd transform(const VectorXd& x) {
    VectorXcd mirrored(2 * x.size()), bins;
    mirrored << x, x.reverse();
    fourier_.fwd(bins, mirrored);
    return (bins.head(x.size()).array() / factors_.array()).real();
  }

  VectorXd inverse(const VectorXd& transformed) {
    const Index n = transformed.size();
    VectorXcd bins = VectorXcd::Zero(2 * n), mirrored;
    bins.head(n) = transformed.cwiseProduct(factors_);
    bins.tail(n - 1) = bins.segment(1, n - 1).reverse().conjugate();
    fourier_.inv(mirrored, bins);
    return mirrored.head(n).real();
  }

 private:
  VectorXcd factors_;
  Eigen::FFT<double> fourier_;
};

}  // namespace

double normal_number(std::mt19937_64& random) {
  // Of the standard library's generators only the engine is the same everywhere.
  const auto uniform = [&] { return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53; };
  const double size = std::sqrt(-2 * std::log(uniform()));
  return size * std::cos(2 * std::numbers::pi * uniform());
}

MatrixXd cosine_spectrum(const MatrixXd& series) {
  MatrixXd spectrum(fast_length(series.cols()), series.rows());
  CosineTransform cosines(spectrum.rows());
  for (Index c = 0; c < series.rows(); ++c) {
    VectorXd channel = VectorXd::Zero(spectrum.rows());
    for (Index k = 0; k < series.cols(); ++k)
      if (!std::isnan(series(c, k))) channel[k] = series(c, k);
    spectrum.col(c) = cosines.transform(channel);
  }
  return spectrum;
}

MatrixXd stretched(const MatrixXd& spectrum, Index frames) {
  MatrixXd longer(fast_length(frames), spectrum.cols());
  for (Index j = 0; j < longer.rows(); ++j)
    longer.row(j) = spectrum.row(j * spectrum.rows() / longer.rows());
  return longer;
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
  CosineTransform cosines(drawn.rows());
  for (Index c = 0; c < drawn.cols(); ++c)
    series.row(c) = cosines.inverse(drawn.col(c)).head(frames);
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
