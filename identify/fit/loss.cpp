// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/loss.hpp"

#include <cmath>

namespace catena {

LossValue loss_of(const ErrorSpec& error, double square) {
  const double bend = error.loss_scale * error.loss_scale;
  const double sum = 1 + square / bend;
  switch (error.loss) {
    case Loss::kNone:
      break;
    case Loss::kHuber: {
      if (square <= bend) break;
      const double slope = error.loss_scale / std::sqrt(square);
      return {2 * error.loss_scale * std::sqrt(square) - bend, slope, -slope / (2 * square)};
    }
    case Loss::kSoftL1: {
      const double slope = 1 / std::sqrt(sum);
      return {2 * bend * (std::sqrt(sum) - 1), slope, -slope / (2 * bend * sum)};
    }
    case Loss::kCauchy:
      return {bend * std::log(sum), 1 / sum, -1 / (bend * sum * sum)};
  }
  return {square, 1, 0};
}

}  // namespace catena
