// SPDX-License-Identifier: GPL-3.0-or-later
//
// Notation: an argument a = sum_b (k_b / d_b) b is cut into basic terms b with integers k_b; d_b is
// the common divisor with which b occurs anywhere. With s = sin(b/d), c = cos(b/d) or E = exp(b/d):
//   cos(a) + i sin(a) = prod_b (c_b + i s_b)^k_b,   exp(a) = prod_b E_b^k_b.
// sin and exp of arguments that are linearly independent over the rationals are algebraically
// independent (Ax 1971); distinct Laurent monomials b are. Products of powers p^(e/d), 0 <= e < d,
// of distinct primes are linearly independent over the rationals (Besicovitch 1940). That is why a
// non-zero numerator disproves.
#include "generator/checking/normal_form.hpp"

#include <numeric>
#include <set>
#include <stdexcept>

#include "generator/checking/budget.hpp"
#include "generator/checking/expression_text.hpp"
#include "generator/checking/shared_tree.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

// sin(k x) is a polynomial of degree k. Beyond this k it is not expanded.
constexpr int kGreatestMultiple = 64;

// Largest trial divisor: the rest of a number below its square is prime.
constexpr int kLargestTrialDivisor = 100000;

const std::set<std::string> kCircular = {"sin", "cos", "tan"};
const std::set<std::string> kHyperbolic = {"exp", "sinh", "cosh", "tanh"};

std::string function_name(const ex& e) { return GiNaC::ex_to<GiNaC::function>(e).get_name(); }

struct Term {
  numeric coefficient = 1;
  ex base = 1;
};

Term split(const ex& term) {
  if (GiNaC::is_a<numeric>(term)) return {GiNaC::ex_to<numeric>(term), 1};
  if (GiNaC::is_a<GiNaC::mul>(term)) {
    const ex last = term.op(term.nops() - 1);
    if (GiNaC::is_a<numeric>(last) && GiNaC::ex_to<numeric>(last).is_rational())
      return {GiNaC::ex_to<numeric>(last), term / last};
  }
  return {1, term};
}

/// Expanded, if the account has the products for it.
ex expand_within_budget(const ex& e) {
  Budget::spend(products_in(e));
  return e.expand();
}

/// The products when the terms of a sum are brought over their common denominator.
double products_over_common_denominator(const ex& sum) {
  double products = static_cast<double>(sum.nops());
  for_each_part(sum, [&](const ex& part) {
    Budget::spend(1);
    if (GiNaC::is_a<GiNaC::power>(part) && part.op(1).info(GiNaC::info_flags::negint))
      products *= products_in(part);
    return true;
  });
  return products;
}

/// The least common multiple of a divisor and a denominator.
int common_divisor(int divisor, const numeric& denominator) {
  const numeric result = GiNaC::lcm(divisor, denominator);
  if (result > kGreatestDivisor)
    throw Overlong("roots or fractions of angles have no common denominator up to " +
                   std::to_string(kGreatestDivisor));
  return result.to_int();
}

/// The argument of a sine or exponential as a sum of basic terms.
std::vector<Term> terms_of(const ex& argument) {
  ex sum = expand_within_budget(argument);
  if (!sum.info(GiNaC::info_flags::polynomial)) {
    Budget::spend(products_over_common_denominator(sum));
    sum = expand_within_budget(sum.normal());
  }
  std::vector<Term> result;
  if (GiNaC::is_a<GiNaC::add>(sum)) {
    for (const ex& term : sum) result.push_back(split(term));
  } else if (!sum.is_zero()) {
    result.push_back(split(sum));
  }
  return result;
}

bool is_integer_power_of_symbol(const ex& e) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) return true;
  return GiNaC::is_a<GiNaC::power>(e) && GiNaC::is_a<GiNaC::symbol>(e.op(0)) &&
         e.op(1).info(GiNaC::info_flags::integer);
}

bool is_positive_rational(const ex& e) {
  return GiNaC::is_a<numeric>(e) && GiNaC::ex_to<numeric>(e).is_rational() &&
         GiNaC::ex_to<numeric>(e).is_positive();
}

bool is_fractional(const ex& exponent) {
  return exponent.info(GiNaC::info_flags::rational) && !exponent.info(GiNaC::info_flags::integer);
}

bool is_laurent_monomial(const ex& e) {
  if (!GiNaC::is_a<GiNaC::mul>(e)) return is_integer_power_of_symbol(e);
  for (const ex& factor : e)
    if (!is_integer_power_of_symbol(factor)) return false;
  return true;
}

}  // namespace

void spend_for_division(const Fraction& fraction) {
  Budget::spend(10.0 * static_cast<double>(fraction.numerator.nops() + 1) *
                static_cast<double>(fraction.denominator.nops() + 1));
}

NormalForm::NormalForm(const std::vector<ex>& expressions) {
  for (const ex& expression : expressions) scan(expression);
}

void NormalForm::scan(const ex& expression) {
  Budget::spend(1);
  if (GiNaC::is_a<GiNaC::function>(expression)) {
    const std::string name = function_name(expression);
    if (kCircular.count(name) != 0) scan_argument(expression.op(0), false);
    if (kHyperbolic.count(name) != 0) scan_argument(expression.op(0), true);
  }
  if (GiNaC::is_a<GiNaC::power>(expression) && is_fractional(expression.op(1))) {
    radical_degree_ =
        common_divisor(radical_degree_, GiNaC::ex_to<numeric>(expression.op(1)).denom());
  }
  for (const ex& part : expression) scan(part);
}

void NormalForm::scan_argument(const ex& argument, bool exponential) {
  for (const Term& term : terms_of(argument)) {
    if (term.base == GiNaC::Pi && !exponential) {  // cos(pi/4) = 2^(1/2)/2
      radical_degree_ = common_divisor(radical_degree_, 2);
      continue;
    }
    const numeric divisor = term.coefficient.denom();
    if (!is_laurent_monomial(term.base)) decides_ = false;
    if (exponential) {
      Exponential& entry = exponentials_[term.base];
      entry.divisor = common_divisor(entry.divisor, divisor);
      if (entry.value.is_zero()) entry.value = GiNaC::possymbol();
      generators_[entry.value] = {Role::kExponential, term.base, entry.divisor, ""};
    } else {
      Angle& entry = angles_[term.base];
      entry.divisor = common_divisor(entry.divisor, divisor);
      cosine_of_[entry.sine] = entry.cosine;
      generators_[entry.sine] = {Role::kSine, term.base, entry.divisor, ""};
      generators_[entry.cosine] = {Role::kCosine, term.base, entry.divisor, ""};
    }
  }
}

Fraction NormalForm::operator()(const ex& expression) { return convert(expression); }

NormalForm::Generator NormalForm::generator(const ex& symbol) const {
  const auto found = generators_.find(symbol);
  return found == generators_.end() ? Generator{} : found->second;
}

Fraction NormalForm::convert(const ex& e) {
  Budget::spend(1);
  if (GiNaC::is_a<numeric>(e)) {
    if (!GiNaC::ex_to<numeric>(e).is_rational()) decides_ = false;
    return {e, 1};
  }
  if (GiNaC::is_a<GiNaC::symbol>(e)) return {e, 1};
  if (GiNaC::is_a<GiNaC::constant>(e)) {
    if (e != GiNaC::Pi) decides_ = false;
    return {e, 1};
  }
  if (GiNaC::is_a<GiNaC::add>(e)) return convert_sum(e);
  if (GiNaC::is_a<GiNaC::mul>(e)) {
    Fraction result{1, 1};
    for (const ex& factor : e) {
      const Fraction next = convert(factor);
      result = {result.numerator * next.numerator, result.denominator * next.denominator};
    }
    return reduced(result);
  }
  if (GiNaC::is_a<GiNaC::power>(e)) return convert_power(e);
  return convert_function(e);
}

Fraction NormalForm::convert_sum(const ex& e) {
  std::map<ex, GiNaC::exvector, GiNaC::ex_is_less> by_denominator;
  for (const ex& term : e) {
    const Fraction part = convert(term);
    by_denominator[part.denominator].push_back(part.numerator);
  }
  Fraction result{0, 1};
  for (const auto& [denominator, numerators] : by_denominator) {
    const ex numerator = GiNaC::add(numerators);
    result = {result.numerator * denominator + numerator * result.denominator,
              result.denominator * denominator};
  }
  return reduced(result);
}

Fraction NormalForm::convert_power(const ex& e) {
  if (!GiNaC::is_a<numeric>(e.op(1)) || !GiNaC::ex_to<numeric>(e.op(1)).is_rational())
    return opaque("^", {e.op(0), e.op(1)});
  const numeric exponent = GiNaC::ex_to<numeric>(e.op(1));
  if (is_positive_rational(e.op(0)))
    return {power_of_number(GiNaC::ex_to<numeric>(e.op(0)), exponent), 1};
  const Fraction base = convert(e.op(0));
  if (exponent.is_integer()) return raised(base, integer_exponent(e));
  return raised(root(base, exponent.denom().to_int()), exponent.numer().to_int());
}

Fraction NormalForm::convert_function(const ex& e) {
  if (!GiNaC::is_a<GiNaC::function>(e))
    throw std::domain_error("not an expression of real numbers");
  const std::string name = function_name(e);
  const ex argument = e.op(0);
  if (name == "sin" || name == "cos") return sine_or_cosine(argument, name == "sin", e);
  if (name == "tan")
    return product(convert(GiNaC::sin(argument)), inverse(convert(GiNaC::cos(argument))));
  if (name == "exp") return exponential(argument, e);
  if (kHyperbolic.count(name) != 0) {
    const Fraction up = exponential(argument, GiNaC::exp(argument));
    const Fraction down = inverse(up);
    const auto combined = [&](const ex& sign) {
      return reduced(
          Fraction{(up.numerator * down.denominator + sign * down.numerator * up.denominator) / 2,
                   up.denominator * down.denominator});
    };
    if (name == "sinh") return combined(-1);
    if (name == "cosh") return combined(1);
    return product(combined(-1), inverse(combined(1)));
  }
  if (name == "log") {
    if (const std::optional<ex> inverse = logarithm(convert(argument))) return convert(*inverse);
  }
  std::vector<ex> arguments(e.begin(), e.end());
  return opaque(name, arguments);
}

Fraction NormalForm::sine_or_cosine(const ex& argument, bool sine, const ex& whole) {
  ex real = 1, imaginary = 0;  // of the product over b of (c_b + i s_b)^k_b
  const auto multiply = [&](const ex& c, const ex& s) {
    const ex next = real * c - imaginary * s;
    imaginary = expand_within_budget(real * s + imaginary * c);
    real = expand_within_budget(next);
  };
  for (const Term& term : terms_of(argument)) {
    if (term.base == GiNaC::Pi) {
      const ex c = GiNaC::cos(term.coefficient * GiNaC::Pi);
      const ex s = GiNaC::sin(term.coefficient * GiNaC::Pi);
      if (GiNaC::is_a<GiNaC::function>(c) || GiNaC::is_a<GiNaC::function>(s))
        return opaque(function_name(whole), {argument});
      const Fraction cosine = convert(c), sine_of_it = convert(s);
      if (cosine.denominator != 1 || sine_of_it.denominator != 1)
        return opaque(function_name(whole), {argument});
      multiply(cosine.numerator, sine_of_it.numerator);
      continue;
    }
    const auto entry = angles_.find(term.base);
    if (entry == angles_.end()) return opaque(function_name(whole), {argument});
    const numeric multiple = term.coefficient * entry->second.divisor;
    if (!multiple.is_integer() || GiNaC::abs(multiple) > kGreatestMultiple)
      return opaque(function_name(whole), {argument});
    const ex s = multiple.is_negative() ? ex(-entry->second.sine) : ex(entry->second.sine);
    for (int i = GiNaC::abs(multiple).to_int(); i > 0; --i) multiply(entry->second.cosine, s);
  }
  return {reduced(sine ? imaginary : real), 1};
}

Fraction NormalForm::exponential(const ex& argument, const ex& whole) {
  ex result = 1;
  for (const Term& term : terms_of(argument)) {
    const auto entry = exponentials_.find(term.base);
    if (entry == exponentials_.end()) return opaque(function_name(whole), {argument});
    const numeric multiple = term.coefficient * entry->second.divisor;
    if (!multiple.is_integer()) return opaque(function_name(whole), {argument});
    const ex power = GiNaC::pow(entry->second.value, multiple);
    integer_exponent(power);  // throws where it is too large
    result *= power;
  }
  return {result, 1};
}

/// log(prod_b exp(b/d)^k) = sum_b k b/d.
std::optional<ex> NormalForm::logarithm(const Fraction& argument) const {
  if (argument.denominator != 1) return std::nullopt;
  ex result = 0;
  const auto add_factor = [&](const ex& factor) {
    const bool is_power = is_integer_power_of_symbol(factor) && GiNaC::is_a<GiNaC::power>(factor);
    const Generator known = generator(is_power ? factor.op(0) : factor);
    if (known.role != Role::kExponential) return false;
    result += known.base * (is_power ? factor.op(1) : ex(1)) / known.divisor;
    return true;
  };
  if (!GiNaC::is_a<GiNaC::mul>(argument.numerator)) {
    if (!add_factor(argument.numerator)) return std::nullopt;
  } else {
    for (const ex& factor : argument.numerator)
      if (!add_factor(factor)) return std::nullopt;
  }
  return result;
}

Fraction NormalForm::root(const Fraction& radicand, int degree) {
  // Take positive factors out of the root:
  // (f^m rest)^(1/q) = f^(m div q) (f^(m mod q) rest)^(1/q), f > 0.
  spend_for_division(radicand);
  const ex both = (radicand.numerator / radicand.denominator).normal().numer_denom();
  Fraction drawn{1, 1};
  Fraction rest{1, 1};
  numeric number = 1;  // the factor of the radicand that is a positive number
  for (const bool upper : {true, false}) {
    ex whole = GiNaC::sqrfree(both.op(upper ? 0 : 1));
    if (!GiNaC::is_a<GiNaC::mul>(whole)) whole = GiNaC::lst{whole};
    ex outside = 1, inside = 1;
    for (const ex& factor : whole) {
      const bool is_power =
          GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::posint);
      const ex base = is_power ? factor.op(0) : factor;
      const int exponent = is_power ? integer_exponent(factor) : 1;
      if (is_positive_rational(factor)) {
        const numeric value = GiNaC::ex_to<numeric>(factor);
        number = upper ? number * value : number / value;
      } else if (is_positive(base)) {
        outside *= GiNaC::pow(base, exponent / degree);
        inside *= GiNaC::pow(base, exponent % degree);
      } else {
        inside *= factor;
      }
    }
    (upper ? drawn.numerator : drawn.denominator) = outside;
    (upper ? rest.numerator : rest.denominator) = inside;
  }
  drawn.numerator *= power_of_number(number, numeric(1, degree));
  rest = reduced(rest);
  if (same(rest, {1, 1})) return reduced(drawn);

  decides_ = false;
  for (const Root& known : roots_)
    if (known.degree == degree && same(known.radicand, rest))
      return reduced(Fraction{drawn.numerator * known.symbol, drawn.denominator});
  Root created;
  created.radicand = rest;
  created.degree = degree;
  const std::string inner = text_of(rest, *this);
  generators_[created.symbol] = {
      Role::kOther, 0, 1,
      degree == 2 ? "sqrt(" + inner + ")" : "(" + inner + ")^(1/" + std::to_string(degree) + ")"};
  roots_.push_back(created);
  return reduced(Fraction{drawn.numerator * created.symbol, drawn.denominator});
}

/// (2^3 3/5)^e = 2^(3e) 3^e 5^(-e), as powers of prime roots between 0 and 1 and a rational number.
ex NormalForm::power_of_number(const numeric& base, const numeric& exponent) {
  ex result = 1;
  for (const bool upper : {true, false}) {
    numeric left = upper ? base.numer() : base.denom();
    const numeric sign = upper ? 1 : -1;
    for (int divisor = 2; divisor <= kLargestTrialDivisor && left >= divisor * divisor;
         divisor += divisor == 2 ? 1 : 2) {
      int times = 0;
      for (; GiNaC::irem(left, divisor).is_zero(); ++times) left = GiNaC::iquo(left, divisor);
      if (times > 0) result *= power_of_prime(divisor, sign * times * exponent);
    }
    if (left.is_equal(1)) continue;
    if (left > numeric(kLargestTrialDivisor) * kLargestTrialDivisor) decides_ = false;
    result *= power_of_prime(left, sign * exponent);
  }
  return result.expand();
}

ex NormalForm::power_of_prime(const numeric& prime, const numeric& exponent) {
  const numeric steps = exponent * radical_degree_;
  if (!steps.is_integer()) throw std::logic_error("a root of a degree that was not there before");
  const numeric below = GiNaC::mod(steps, radical_degree_);
  const ex whole = GiNaC::pow(prime, (steps - below) / radical_degree_);
  if (below.is_zero()) return whole;
  const auto [found, is_new] = prime_roots_.try_emplace(prime);
  if (is_new) {
    found->second = GiNaC::possymbol();
    prime_of_[found->second] = prime;
    const std::string text = text_of(prime);
    generators_[found->second] = {Role::kOther, 0, 1,
                                  radical_degree_ == 2
                                      ? "sqrt(" + text + ")"
                                      : text + "^(1/" + std::to_string(radical_degree_) + ")"};
  }
  return whole * GiNaC::pow(found->second, below);
}

Fraction NormalForm::opaque(const std::string& function, const std::vector<ex>& arguments) {
  decides_ = false;
  Opaque created;
  created.function = function;
  for (const ex& argument : arguments) created.arguments.push_back(convert(argument));
  for (const Opaque& known : opaques_) {
    bool equal = known.function == function && known.arguments.size() == arguments.size();
    for (std::size_t i = 0; equal && i < arguments.size(); ++i)
      equal = same(known.arguments[i], created.arguments[i]);
    if (equal) return {known.symbol, 1};
  }
  std::string text;
  for (const Fraction& argument : created.arguments) {
    if (!text.empty()) text += function == "^" ? ")^(" : ", ";
    text += text_of(argument, *this);
  }
  generators_[created.symbol] = {Role::kOther, 0, 1,
                                 (function == "^" ? "" : function) + "(" + text + ")"};
  opaques_.push_back(created);
  return {created.symbol, 1};
}

ex NormalForm::reduced(const ex& polynomial) const {
  const ex expanded = expand_within_budget(polynomial);
  if (cosine_of_.empty() && prime_of_.empty()) return expanded;
  bool changed = false;
  GiNaC::exvector terms;
  const auto reduce_term = [&](const ex& term) {
    GiNaC::exvector factors;
    bool squares = false;
    const auto reduce_factor = [&](const ex& factor) {
      if (GiNaC::is_a<GiNaC::power>(factor)) {
        const auto cosine = cosine_of_.find(factor.op(0));
        if (cosine != cosine_of_.end() && factor.op(1).info(GiNaC::info_flags::posint)) {
          const int exponent = integer_exponent(factor);
          factors.push_back(GiNaC::pow(1 - GiNaC::pow(cosine->second, 2), exponent / 2) *
                            GiNaC::pow(factor.op(0), exponent % 2));
          squares = true;
          return;
        }
        const auto prime = prime_of_.find(factor.op(0));
        if (const int exponent = integer_exponent(factor);
            prime != prime_of_.end() && exponent >= radical_degree_) {
          factors.push_back(GiNaC::pow(prime->second, exponent / radical_degree_) *
                            GiNaC::pow(factor.op(0), exponent % radical_degree_));
          squares = true;
          return;
        }
      }
      factors.push_back(factor);
    };
    if (GiNaC::is_a<GiNaC::mul>(term)) {
      for (const ex& factor : term) reduce_factor(factor);
    } else {
      reduce_factor(term);
    }
    terms.push_back(squares ? expand_within_budget(GiNaC::mul(factors)) : term);
    changed = changed || squares;
  };
  if (GiNaC::is_a<GiNaC::add>(expanded)) {
    for (const ex& term : expanded) reduce_term(term);
  } else {
    reduce_term(expanded);
  }
  return changed ? ex(GiNaC::add(terms)).expand() : expanded;
}

Fraction NormalForm::reduced(const Fraction& fraction) const {
  Fraction result{reduced(fraction.numerator), reduced(fraction.denominator)};
  // Later roots may have earlier ones in their radicands, so the last comes first.
  for (auto known = roots_.rbegin(); known != roots_.rend(); ++known) {
    for (const bool upper : {true, false}) {
      const ex polynomial = upper ? result.numerator : result.denominator;
      const int highest = polynomial.degree(known->symbol);
      if (highest < known->degree) continue;
      const int most = highest / known->degree;  // clear the denominators of radicand^most
      ex sum = 0;
      for (int power = 0; power <= highest; ++power) {
        const int full = power / known->degree;
        sum += polynomial.coeff(known->symbol, power) *
               GiNaC::pow(known->radicand.numerator, full) *
               GiNaC::pow(known->radicand.denominator, most - full) *
               GiNaC::pow(known->symbol, power % known->degree);
      }
      const ex cleared = GiNaC::pow(known->radicand.denominator, most);
      (upper ? result.numerator : result.denominator) = reduced(sum);
      ex& other = upper ? result.denominator : result.numerator;
      other = reduced(other * cleared);
    }
  }
  if (result.denominator != 1 && is_plain_monomial(result.denominator))
    result = {expand_within_budget(result.numerator / result.denominator), 1};
  return result;
}

Fraction NormalForm::product(const Fraction& a, const Fraction& b) const {
  return reduced(Fraction{a.numerator * b.numerator, a.denominator * b.denominator});
}

Fraction NormalForm::raised(const Fraction& base, int exponent) const {
  const Fraction positive = exponent < 0 ? inverse(base) : base;
  const int count = std::abs(exponent);
  return reduced(
      Fraction{GiNaC::pow(positive.numerator, count), GiNaC::pow(positive.denominator, count)});
}

Fraction NormalForm::inverse(const Fraction& fraction) const {
  if (fraction.numerator.is_zero()) throw std::domain_error("a denominator is identically zero");
  if (is_plain_monomial(fraction.numerator))
    return reduced(Fraction{fraction.denominator / fraction.numerator, 1});
  return {fraction.denominator, fraction.numerator};
}

bool NormalForm::same(const Fraction& a, const Fraction& b) const {
  return reduced(Fraction{a.numerator * b.denominator - b.numerator * a.denominator, 1})
      .numerator.is_zero();
}

bool NormalForm::is_plain(const ex& symbol) const {
  const Role role = generator(symbol).role;
  return role == Role::kPlain || role == Role::kExponential;
}

bool NormalForm::is_plain_monomial(const ex& e) const {
  if (GiNaC::is_a<numeric>(e)) return true;
  if (GiNaC::is_a<GiNaC::symbol>(e)) return is_plain(e);
  if (GiNaC::is_a<GiNaC::power>(e)) return is_integer_power_of_symbol(e) && is_plain(e.op(0));
  if (!GiNaC::is_a<GiNaC::mul>(e)) return false;
  for (const ex& factor : e)
    if (!is_plain_monomial(factor)) return false;
  return true;
}

bool NormalForm::is_positive(const ex& polynomial) const {
  const auto positive_factor = [](const ex& factor) {
    return factor.info(GiNaC::info_flags::positive) ||
           (GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::even) &&
            factor.op(0).info(GiNaC::info_flags::real));
  };
  const auto positive_term = [&](const ex& term) {
    if (!GiNaC::is_a<GiNaC::mul>(term)) return positive_factor(term);
    for (const ex& factor : term)
      if (!positive_factor(factor)) return false;
    return true;
  };
  const ex expanded = polynomial.expand();
  if (!GiNaC::is_a<GiNaC::add>(expanded)) return positive_term(expanded);
  for (const ex& term : expanded)
    if (!positive_term(term)) return false;
  return true;
}

}  // namespace catena::checking
