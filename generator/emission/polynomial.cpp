// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/polynomial.hpp"

#include <algorithm>
#include <compare>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace catena {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

struct Key {
  int family_rank;
  int offset;  // index relative to the link; large for symbols of no link
  int number;
  auto operator<=>(const Key& other) const {
    return std::tie(family_rank, offset) <=> std::tie(other.family_rank, other.offset);
  }
  bool operator==(const Key& other) const { return (*this <=> other) == 0; }
};

struct Monomial {
  numeric coefficient = 1;
  std::map<Key, int> powers;
};
using Monomials = std::vector<Monomial>;

Number number(const numeric& value) {
  if (!value.is_rational()) throw std::logic_error("numbers in equations must be rational");
  return {value.numer().to_double(), value.denom().to_double()};
}

class Factoring {
 public:
  Factoring(const Definitions& definitions, int link, const ReadSymbol& read)
      : definitions_(definitions), link_(link), read_(read) {}

  Monomials monomials(const ex& e) const {
    Monomials sum;
    if (GiNaC::is_a<GiNaC::add>(e)) {
      for (size_t i = 0; i < e.nops(); ++i) sum.push_back(read_product(e.op(i)));
    } else if (!e.is_zero()) {
      sum.push_back(read_product(e));
    }
    std::sort(sum.begin(), sum.end(),
              [](const Monomial& a, const Monomial& b) { return a.powers < b.powers; });
    return sum;
  }

  Sum factored(Monomials sum) const {
    if (sum.empty()) return {{false, {{Number{0}}}, {}}};
    if (sum.size() == 1) return {product(sum[0])};
    // What all terms share stands in front.
    const Monomial common = shared(sum);
    if (common.powers.empty() && common.coefficient.is_equal(1)) return terms(std::move(sum));
    for (Monomial& term : sum) divide(term, common);
    return {product(common, factored(std::move(sum)))};
  }

 private:
  Key key(int number) const {
    const Symbol& symbol = definitions_[number];
    return {symbol.family_rank, symbol.index == kNoIndex ? 1'000'000 : symbol.index - link_,
            number};
  }

  Monomial read_product(const ex& e) const {
    Monomial monomial;
    const auto factor = [&](const ex& f) {
      if (GiNaC::is_a<numeric>(f)) {
        monomial.coefficient = monomial.coefficient * GiNaC::ex_to<numeric>(f);
      } else if (GiNaC::is_a<GiNaC::symbol>(f)) {
        monomial.powers[key(definitions_.number_of(f))] += 1;
      } else if (GiNaC::is_a<GiNaC::power>(f) && GiNaC::is_a<GiNaC::symbol>(f.op(0)) &&
                 f.op(1).info(GiNaC::info_flags::integer)) {
        monomial.powers[key(definitions_.number_of(f.op(0)))] +=
            GiNaC::ex_to<numeric>(f.op(1)).to_int();
      } else {
        std::ostringstream what;
        what << "not a polynomial in symbols: " << f;
        throw std::logic_error(what.str());
      }
    };
    if (GiNaC::is_a<GiNaC::mul>(e)) {
      for (size_t i = 0; i < e.nops(); ++i) factor(e.op(i));
    } else {
      factor(e);
    }
    return monomial;
  }

  static Monomial shared(const Monomials& sum) {
    Monomial common = sum[0];
    common.coefficient = GiNaC::abs(common.coefficient);
    bool all_negative = true;
    for (const Monomial& term : sum) {
      all_negative = all_negative && term.coefficient.is_negative();
      if (!GiNaC::abs(term.coefficient).is_equal(common.coefficient)) common.coefficient = 1;
      for (auto it = common.powers.begin(); it != common.powers.end();) {
        const auto found = term.powers.find(it->first);
        const int power = found == term.powers.end() ? 0 : found->second;
        // Only what all have with the same sign of the exponent is shared.
        if (power > 0 && it->second > 0) {
          it->second = std::min(it->second, power);
        } else if (power < 0 && it->second < 0) {
          it->second = std::max(it->second, power);
        } else {
          it->second = 0;
        }
        it = it->second == 0 ? common.powers.erase(it) : std::next(it);
      }
    }
    if (all_negative) common.coefficient = -common.coefficient;
    return common;
  }

  static void divide(Monomial& term, const Monomial& by) {
    term.coefficient = term.coefficient / by.coefficient;
    for (const auto& [key, power] : by.powers) {
      int& left = term.powers[key];
      left -= power;
      if (left == 0) term.powers.erase(key);
    }
  }

  // Terms without a common factor: the symbol that most of them have is drawn out of those.
  Sum terms(Monomials sum) const {
    std::map<Key, int> occurrences;
    for (const Monomial& term : sum) {
      for (const auto& [key, power] : term.powers) {
        if (power > 0) ++occurrences[key];
      }
    }
    const Key* best = nullptr;
    int most = 1;
    for (const auto& [key, times] : occurrences) {
      if (times > most) {
        most = times;
        best = &key;
      }
    }
    Sum out;
    if (best != nullptr) {
      Monomials with, without;
      for (Monomial& term : sum) {
        const auto found = term.powers.find(*best);
        (found != term.powers.end() && found->second > 0 ? with : without)
            .push_back(std::move(term));
      }
      out = factored(std::move(without));
      Sum drawn = factored(std::move(with));
      // A leading minus becomes a difference.
      if (out[0].negative) std::swap(out, drawn);
      out.insert(out.end(), drawn.begin(), drawn.end());
      return out;
    }
    // A positive term first, so that no sum begins with a minus needlessly.
    const auto positive = std::find_if(
        sum.begin(), sum.end(), [](const Monomial& m) { return m.coefficient.is_positive(); });
    if (positive != sum.end()) std::rotate(sum.begin(), positive, positive + 1);
    for (const Monomial& term : sum) out.push_back(product(term));
    return out;
  }

  // `last`: one more factor.
  Product product(const Monomial& monomial, const std::optional<Sum>& last = std::nullopt) const {
    Product product;
    product.negative = monomial.coefficient.is_negative();
    const numeric size = GiNaC::abs(monomial.coefficient);
    if (!size.is_equal(1)) product.above.push_back({number(size)});
    for (const auto& [key, power] : monomial.powers) {
      auto& factors = power > 0 ? product.above : product.below;
      factors.insert(factors.end(), static_cast<size_t>(std::abs(power)), {read_(key.number)});
    }
    if (last) product.above.push_back({*last});
    if (product.above.empty()) product.above.push_back({Number{1}});
    return product;
  }

  const Definitions& definitions_;
  int link_;
  const ReadSymbol& read_;
};

}  // namespace

Sum polynomial(const Definitions& definitions, const ex& expression, int link,
               const ReadSymbol& read) {
  const auto call = [&](const std::string& function) {
    return Sum{{false, {{Call{function, read(definitions.number_of(expression.op(0)))}}}, {}}};
  };
  if (GiNaC::is_a<GiNaC::function>(expression))
    return call(GiNaC::ex_to<GiNaC::function>(expression).get_name());
  if (GiNaC::is_a<GiNaC::power>(expression) && expression.op(1).is_equal(numeric(1, 2)))
    return call("sqrt");
  const Factoring factoring(definitions, link, read);
  return factoring.factored(factoring.monomials(expression));
}

}  // namespace catena
