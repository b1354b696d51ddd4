// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/exact_form.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <sstream>
#include <string>
#include <utility>

#include "generator/checking/expression_text.hpp"
#include "generator/checking/numeric_state.hpp"
#include "generator/checking/shared_tree.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using Role = NormalForm::Role;

GiNaC::exset variables_in(const std::vector<ex>& expressions) {
  GiNaC::exset found;
  for (const ex& expression : expressions)
    for_each_part(expression, [&](const ex& part) {
      if (GiNaC::is_a<GiNaC::symbol>(part) || GiNaC::is_a<GiNaC::constant>(part))
        found.insert(part);
      return true;
    });
  return found;
}

/// From 1 to 2^bits. The number depends on the name, not on the order of calls.
numeric random_integer(const std::string& name, int bits, std::uint64_t seed) {
  std::vector<std::uint32_t> material(name.begin(), name.end());
  material.push_back(static_cast<std::uint32_t>(seed));
  material.push_back(static_cast<std::uint32_t>(seed >> 32U));
  std::seed_seq sequence(material.begin(), material.end());
  std::mt19937 random(sequence);
  numeric result = 0;
  for (int drawn = 0; drawn < bits; drawn += 32)
    result = result * numeric(0x100000000L) + numeric(static_cast<unsigned long>(random()));
  return result + 1;
}

Degree product(const Degree& a, const Degree& b) {
  return {a.numerator + b.numerator, a.denominator + b.denominator};
}

}  // namespace

std::optional<int> bits_for(const Degree& degree) {
  // One bit more, as poles are left out.
  const double bits = std::log2(degree.numerator + degree.denominator + 1) + kCertainty + 1;
  if (!std::isfinite(bits)) return std::nullopt;
  return static_cast<int>(std::ceil(bits / 64)) * 64;
}

ExactForm::ExactForm(const std::vector<ex>& expressions)
    : form_(transcendental_parts(expressions)), is_independent_(form_.decides()) {}

std::optional<ex> ExactForm::operator()(const ex& expression) {
  if (!is_independent_) return std::nullopt;
  GiNaC::exmap rational;
  for (const ex& part : transcendental_parts({expression})) {
    const Fraction fraction = form_(part);
    for (const ex& symbol : variables_in({fraction.numerator, fraction.denominator}))
      if (form_.generator(symbol).role == Role::kOther) return std::nullopt;
    rational[part] = fraction.numerator / fraction.denominator;
  }
  return Replacement(rational)(expression);
}

Degree ExactForm::degree(const ex& e, Degrees known) const {
  const std::function<Degree(const ex&)> of = [&](const ex& part) -> Degree {
    if (GiNaC::is_a<numeric>(part)) return {};
    const auto found = known.find(part);
    if (found != known.end()) return found->second;
    Degree result;
    if (GiNaC::is_a<GiNaC::add>(part)) {
      double excess = 0;  // of a numerator over its own denominator
      for (const ex& term : part) {
        const Degree next = of(term);
        excess = std::max(excess, next.numerator - next.denominator);
        result.denominator += next.denominator;
      }
      result.numerator = result.denominator + excess;
    } else if (GiNaC::is_a<GiNaC::mul>(part)) {
      for (const ex& factor : part) result = product(result, of(factor));
    } else if (GiNaC::is_a<GiNaC::power>(part)) {
      const double exponent = GiNaC::ex_to<numeric>(part.op(1)).to_double();
      const Degree base = of(part.op(0));
      result = {std::abs(exponent) * base.numerator, std::abs(exponent) * base.denominator};
      if (exponent < 0) std::swap(result.numerator, result.denominator);
    } else {
      const Role role = form_.generator(part).role;
      result = role == Role::kSine || role == Role::kCosine ? Degree{2, 2} : Degree{1, 0};
    }
    return known[part] = result;
  };
  return of(e);
}

GiNaC::exmap ExactForm::point(const std::vector<ex>& rationals, int bits,
                              std::uint64_t seed) const {
  GiNaC::exmap result;
  for (const ex& variable : variables_in(rationals)) {
    const NormalForm::Generator generator = form_.generator(variable);
    std::ostringstream name;
    name << static_cast<int>(generator.role == Role::kCosine ? Role::kSine : generator.role) << ' ';
    if (generator.role == Role::kPlain) {
      name << variable;
    } else {
      name << text_of({generator.base, 1}, form_);
    }
    const numeric t = random_integer(name.str(), bits, seed);
    const numeric both = 1 + t * t;
    result[variable] = generator.role == Role::kSine     ? 2 * t / both
                       : generator.role == Role::kCosine ? (1 - t * t) / both
                                                         : t;
  }
  return result;
}

std::optional<bool> vanishes(const ex& expression, std::uint64_t seed) {
  ExactForm form({expression});
  const std::optional<ex> rational = form(expression);
  if (!rational) return std::nullopt;
  const std::optional<int> bits = bits_for(form.degree(*rational));
  if (!bits) return std::nullopt;
  const std::optional<numeric> value = Evaluation(form.point({*rational}, *bits, seed))(*rational);
  if (!value) return std::nullopt;
  return value->is_zero();
}

}  // namespace catena::checking
