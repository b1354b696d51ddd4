// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <random>

namespace catena {

/// A normally distributed number, mean 0 and variance 1; the same everywhere for the same engine.
double normal_number(std::mt19937_64& random);

/// The cosine transform of a series: frequencies x channels. It is orthonormal: sums of products of two
/// series are those of their spectra. `series`: channels x frames, in equal steps; NaN counts as 0.
/// There may be more frequencies than frames, so that the transform is fast.
Eigen::MatrixXd cosine_spectrum(const Eigen::MatrixXd& series);

/// As many frequencies as a series of so many frames has, each with the row of `spectrum` at the same frequency.
Eigen::MatrixXd stretched(const Eigen::MatrixXd& spectrum, Eigen::Index frames);

/// A random series of the same power at every frequency, and with the same correlations between its
/// channels, but with other phases: a Gaussian process that has the spectrum, averaged over
/// neighbouring frequencies. With such series a test asks whether one goes with something else by
/// chance only. channels x frames.
Eigen::MatrixXd random_series(const Eigen::MatrixXd& spectrum, Eigen::Index frames,
                              std::mt19937_64& random);

/// How many such series a test draws. The least probability of chance that it can tell is then 1 in 200,
/// half of what a diagnosis asks for (thresholds.hpp, `chance`).
inline constexpr int kRandomSeries = 199;

/// Variance of the sum of products of such a random series with the series of spectrum `other` (of
/// the same size).
double variance_along(const Eigen::MatrixXd& spectrum, const Eigen::MatrixXd& other);

}  // namespace catena
