// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace catena::checking {

/// Working precision of evaluate_at, decimal digits.
inline constexpr int kStateDigits = 60;

/// Relative difference below which values count as equal at a state: it allows for cancellation.
const GiNaC::numeric& closeness();

/// Number of states at which two sides must agree to count as numerically equal.
inline constexpr int kStates = 24;

/// Values for symbols at which two expressions are compared.
struct NumericState {
  GiNaC::exmap values;
  std::vector<std::string> assignments;  ///< "theta_1 = 0.73", in reading order
};

/// Symbols in the expressions, in reading order.
std::vector<GiNaC::ex> symbols_in(const std::vector<GiNaC::ex>& expressions);

/// Seeded values with two decimals: positive symbols within 0.1..3, others within -3..3. The same
/// seed and symbols give the same state.
NumericState random_state(const std::vector<GiNaC::ex>& symbols, std::uint64_t seed);

/// Values of expressions at one point. Each distinct part is computed once. Rational operations of
/// rational values are exact; functions have kStateDigits digits.
class Evaluation {
 public:
  explicit Evaluation(GiNaC::exmap values) : values_(std::move(values)) {}
  /// The value; nothing at a pole, outside a domain, and for symbols without a value.
  std::optional<GiNaC::numeric> operator()(const GiNaC::ex& expression);

 private:
  GiNaC::numeric value_of(const GiNaC::ex& expression);
  GiNaC::exmap values_;
};

/// The value with kStateDigits digits; nothing if it is not a real number.
std::optional<GiNaC::numeric> evaluate_at(const GiNaC::ex& expression, const NumericState& state);

/// For messages.
std::string twelve_digits(const GiNaC::numeric& value);

}  // namespace catena::checking
