// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/shared_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "generator/checking/budget.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;

/// Whether the expression is a function or a root.
bool is_transcendental(const ex& e) {
  return GiNaC::is_a<GiNaC::function>(e) ||
         (GiNaC::is_a<GiNaC::power>(e) && !e.op(1).info(GiNaC::info_flags::integer));
}

class Size {
 public:
  double operator()(const ex& e) {
    if (e.nops() == 0) return 1;
    const auto [known, is_new] = known_.try_emplace(e, 1);
    if (!is_new) return known->second;
    double size = 1;
    if (GiNaC::is_a<GiNaC::add>(e)) {
      size = 0;
      for (const ex& term : e) size += (*this)(term);
    } else if (GiNaC::is_a<GiNaC::mul>(e)) {
      for (const ex& factor : e) size *= (*this)(factor);
    } else if (GiNaC::is_a<GiNaC::power>(e) && GiNaC::is_a<GiNaC::numeric>(e.op(1))) {
      const double exponent = GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_double();
      size = std::pow((*this)(e.op(0)), std::abs(exponent));
    } else if (GiNaC::is_a<GiNaC::function>(e) && GiNaC::is_a<GiNaC::add>(e.op(0))) {
      size = std::exp2(static_cast<double>(e.op(0).nops()) - 1);  // cos(a + b) is two products
    }
    return known_[e] = size;
  }

 private:
  std::map<ex, double, GiNaC::ex_is_less> known_;
};

class Clearing {
 public:
  struct Parts {
    ex numerator;
    std::map<ex, int, GiNaC::ex_is_less> denominator;  // exponents of its factors
  };

  const Parts& operator()(const ex& e) {
    const auto known = known_.find(e);
    if (known != known_.end()) return known->second;
    Parts result{e, {}};
    if (GiNaC::is_a<GiNaC::add>(e)) {
      result = sum(e);
    } else if (GiNaC::is_a<GiNaC::mul>(e)) {
      GiNaC::exvector numerators;
      for (const ex& factor : e) {
        const Parts& parts = (*this)(factor);
        numerators.push_back(parts.numerator);
        for (const auto& [base, exponent] : parts.denominator) result.denominator[base] += exponent;
      }
      result.numerator = GiNaC::mul(numerators);
    } else if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::integer)) {
      result = power((*this)(e.op(0)), integer_exponent(e));
    }
    return known_[e] = std::move(result);
  }

  static ex product(const std::map<ex, int, GiNaC::ex_is_less>& factors) {
    GiNaC::exvector powers;
    for (const auto& [base, exponent] : factors) powers.push_back(GiNaC::pow(base, exponent));
    return GiNaC::mul(powers);
  }

 private:
  Parts sum(const ex& e) {
    std::vector<const Parts*> terms;
    Parts result;
    for (const ex& term : e) {
      terms.push_back(&(*this)(term));
      for (const auto& [base, exponent] : terms.back()->denominator) {
        int& most = result.denominator[base];
        most = std::max(most, exponent);
      }
    }
    GiNaC::exvector numerators;
    for (const Parts* term : terms) {
      std::map<ex, int, GiNaC::ex_is_less> missing = result.denominator;
      for (const auto& [base, exponent] : term->denominator) missing[base] -= exponent;
      numerators.push_back(term->numerator * product(missing));
    }
    result.numerator = GiNaC::add(numerators);
    return result;
  }

  static Parts power(const Parts& base, int exponent) {
    const int times = std::abs(exponent);
    Parts result{GiNaC::pow(exponent > 0 ? base.numerator : product(base.denominator), times), {}};
    if (exponent > 0) {
      result.denominator = base.denominator;
    } else if (GiNaC::is_a<GiNaC::mul>(base.numerator)) {
      for (const ex& factor : base.numerator) ++result.denominator[factor];
    } else {
      ++result.denominator[base.numerator];
    }
    for (auto& [factor, count] : result.denominator) count *= times;
    return result;
  }

  std::map<ex, Parts, GiNaC::ex_is_less> known_;
};

}  // namespace

Quotient cleared(const ex& expression) {
  const Clearing::Parts parts = Clearing()(expression);
  return {parts.numerator, Clearing::product(parts.denominator)};
}

std::vector<ex> transcendental_parts(const std::vector<ex>& expressions) {
  GiNaC::exset found;
  for (const ex& expression : expressions)
    for_each_part(expression, [&](const ex& part) {
      if (is_transcendental(part)) found.insert(part);
      return !is_transcendental(part);
    });
  return {found.begin(), found.end()};
}

void for_each_part(const ex& expression, const std::function<bool(const ex&)>& visit) {
  GiNaC::exset seen;
  const std::function<void(const ex&)> enter = [&](const ex& e) {
    if (!seen.insert(e).second || !visit(e)) return;
    for (std::size_t i = 0; i < e.nops(); ++i) enter(e.op(i));
  };
  enter(expression);
}

ex Replacement::operator()(const ex& e) {
  const auto known = known_.find(e);
  if (known != known_.end()) return known->second;
  if (e.nops() == 0) return e;
  struct Inner : GiNaC::map_function {
    explicit Inner(Replacement& replacement) : replacement_(replacement) {}
    ex operator()(const ex& part) override { return replacement_(part); }
    Replacement& replacement_;
  } inner(*this);
  return known_[e] = e.map(inner);
}

double expanded_size(const ex& expression) { return Size()(expression); }

}  // namespace catena::checking
