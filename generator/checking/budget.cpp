// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/budget.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "common/nesting.hpp"
#include "common/number_text.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// Of each distinct part, once.
class Extent {
 public:
  struct Of {
    double written = 1;
    double factors = 1;  // that GiNaC asks whether they commute: all, but of the first term only
    int depth = 0;
    double bits = 0;  // of the longest number
  };

  Of operator()(const ex& e) {
    if (GiNaC::is_a<numeric>(e)) return {1, 1, 0, bits_of(GiNaC::ex_to<numeric>(e))};
    if (e.nops() == 0) return {};
    const auto known = known_.find(e);
    if (known != known_.end()) return known->second;
    Budget::spend(1);
    Of result;
    for (std::size_t i = 0; i < e.nops(); ++i) {
      const Of part = (*this)(e.op(i));
      result.written += part.written;
      if (i == 0 || GiNaC::is_a<GiNaC::mul>(e)) result.factors += part.factors;
      result.depth = std::max(result.depth, part.depth + 1);
      result.bits = std::max(result.bits, part.bits);
    }
    return known_[e] = result;
  }

 private:
  std::map<ex, Of, GiNaC::ex_is_less> known_;
};

}  // namespace

thread_local Budget* Budget::current_ = nullptr;

void Budget::spend(double operations) {
  for (Budget* account = current_; account != nullptr; account = account->outer_) {
    account->left_ -= operations;
    if (!(account->left_ >= 0))
      throw Overlong("it needs more than " + number_text(account->most_ / 1e6) +
                     " million operations");
  }
}

void require_short_number(double bits) {
  if (bits > kMostBits) throw Overlong("a number in it has more than 30 000 digits");
}

double bits_of(const numeric& number) {
  return number.is_rational() ? number.numer().int_length() + number.denom().int_length() : 0;
}

void require_moderate(const ex& value) {
  const Extent::Of extent = Extent()(value);
  if (extent.depth > kDeepestNesting)
    throw Overlong("functions, powers, sums and products are nested more than " +
                   std::to_string(kDeepestNesting) + " deep");
  Budget::spend(extent.factors);
  require_short_number(extent.bits);
}

ex moderate_power(const ex& base, const ex& exponent) {
  if (GiNaC::is_a<numeric>(exponent)) {
    const double size = GiNaC::abs(GiNaC::ex_to<numeric>(exponent)).to_double();
    require_short_number(size * Extent()(base).bits);
  }
  return GiNaC::pow(base, exponent);
}

int integer_exponent(const ex& factor) {
  if (!GiNaC::is_a<GiNaC::power>(factor) || !factor.op(1).info(GiNaC::info_flags::integer))
    return 1;
  const numeric exponent = GiNaC::ex_to<numeric>(factor.op(1));
  if (GiNaC::abs(exponent) > kGreatestExponent)
    throw Overlong("an exponent in it is beyond " + std::to_string(kGreatestExponent));
  return exponent.to_int();
}

double written_size(const ex& expression) { return Extent()(expression).written; }

double products_in(const ex& e) {
  if (GiNaC::is_a<GiNaC::add>(e)) {
    double sum = 0;
    for (std::size_t i = 0; i < e.nops(); ++i) sum += products_in(e.op(i));
    return sum;
  }
  if (GiNaC::is_a<GiNaC::mul>(e)) {
    double product = 1;
    for (std::size_t i = 0; i < e.nops(); ++i) product *= products_in(e.op(i));
    return product;
  }
  if (!GiNaC::is_a<GiNaC::power>(e) || !GiNaC::is_a<GiNaC::add>(e.op(0)) ||
      !e.op(1).info(GiNaC::info_flags::integer))
    return 1;
  // (a_1 + ... + a_k)^n has (n + k - 1 over n) terms, each of them a product of up to k powers, two of which are as
  // much work as one product.
  const double terms = products_in(e.op(0));
  const double times = std::abs(GiNaC::ex_to<numeric>(e.op(1)).to_double());
  return std::max(1.0, std::min(terms, times) / 2) *
         std::exp(std::lgamma(times + terms) - std::lgamma(times + 1) - std::lgamma(terms));
}

}  // namespace catena::checking
