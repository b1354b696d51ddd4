// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/fitted_errors.hpp"

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/stacking.hpp"
#include "identify/noise/cosine_spectrum.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;

double mean_square(const MatrixXd& residual) {
  double squares = 0, count = 0;
  for (const double value : residual.reshaped()) {
    if (std::isnan(value)) continue;
    squares += value * value;
    count += 1;
  }
  return squares / std::max(1.0, count);
}

FittedErrors::FittedErrors(const MatrixXd& left, Index frames, double stretch)
    : frames_(frames), spectrum_(stretched(cosine_spectrum(left), frames)) {
  const double of_spectrum = spectrum_.norm() / std::sqrt(static_cast<double>(spectrum_.size()));
  if (of_spectrum > 0) spectrum_ *= stretch * std::sqrt(mean_square(left)) / of_spectrum;
}

MatrixXd FittedErrors::draw(std::mt19937_64& random) const {
  return random_series(spectrum_, frames_, random);
}

std::vector<FittedErrors> fitted_errors(const FittedModel& model,
                                        const std::vector<NoiseModel>& noise, double stretch) {
  std::vector<FittedErrors> errors;
  for (std::size_t e = 0; e < model.predicted.size(); ++e) {
    const Index channels = model.predicted[e].rows();
    const std::size_t other = errs_like(model.fit_residual, e, channels);
    const double size = noise[e].level > 0 ? noise[e].level / noise[other].level : 1;
    errors.emplace_back(channels_in_turn(model.fit_residual[other], channels),
                        model.predicted[e].cols(), stretch * (other == e ? 1 : size));
  }
  return errors;
}

}  // namespace catena
