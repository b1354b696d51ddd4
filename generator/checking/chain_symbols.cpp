// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/chain_symbols.hpp"

#include <stdexcept>
#include <string>

namespace catena::checking {
namespace {

std::vector<GiNaC::ex> family(const std::string& name, int links) {
  std::vector<GiNaC::ex> result{GiNaC::ex(0)};
  for (int i = 1; i <= links; ++i)
    result.emplace_back(GiNaC::realsymbol(name + "_" + std::to_string(i)));
  return result;
}

// Parameters are physical, hence positive: sqrt(l_1^2) is l_1.
std::vector<GiNaC::ex> positive_family(const std::string& name, int links) {
  std::vector<GiNaC::ex> result{GiNaC::ex(0)};
  for (int i = 1; i <= links; ++i)
    result.emplace_back(GiNaC::possymbol(name + "_" + std::to_string(i)));
  return result;
}

/// One pass over the expression; ex::diff would need one pass per coordinate.
class TimeDerivative {
 public:
  TimeDerivative(const GiNaC::exmap& derivative, const GiNaC::exset& accelerations)
      : derivative_(derivative), accelerations_(accelerations) {}

  GiNaC::ex operator()(const GiNaC::ex& e) const {
    if (GiNaC::is_a<GiNaC::numeric>(e) || GiNaC::is_a<GiNaC::constant>(e)) return 0;
    if (GiNaC::is_a<GiNaC::symbol>(e)) return of_symbol(e);
    if (GiNaC::is_a<GiNaC::add>(e)) {
      GiNaC::exvector terms;
      for (const GiNaC::ex& term : e) terms.push_back((*this)(term));
      return GiNaC::add(terms);
    }
    if (GiNaC::is_a<GiNaC::mul>(e)) return of_product(e);
    if (GiNaC::is_a<GiNaC::power>(e)) {
      const GiNaC::ex exponent_rate = (*this)(e.op(1));
      const GiNaC::ex from_base = e.op(1) * GiNaC::pow(e.op(0), e.op(1) - 1) * (*this)(e.op(0));
      if (exponent_rate.is_zero()) return from_base;
      return from_base + e * GiNaC::log(e.op(0)) * exponent_rate;
    }
    GiNaC::ex result = 0;  // a function: the chain rule over its arguments
    for (std::size_t i = 0; i < e.nops(); ++i) {
      const GiNaC::ex inner = (*this)(e.op(i));
      if (inner.is_zero()) continue;
      const GiNaC::symbol argument;
      GiNaC::ex outer = e;
      outer.let_op(i) = argument;
      result += outer.diff(argument).subs(argument == e.op(i)) * inner;
    }
    return result;
  }

 private:
  GiNaC::ex of_symbol(const GiNaC::ex& symbol) const {
    const auto found = derivative_.find(symbol);
    if (found != derivative_.end()) return found->second;
    if (accelerations_.count(symbol) != 0)
      throw std::invalid_argument("the time derivative of an acceleration is not available");
    return 0;
  }

  GiNaC::ex of_product(const GiNaC::ex& product) const {
    GiNaC::exvector terms;
    for (std::size_t i = 0; i < product.nops(); ++i) {
      const GiNaC::ex derivative = (*this)(product.op(i));
      if (derivative.is_zero()) continue;
      GiNaC::exvector factors;
      for (std::size_t j = 0; j < product.nops(); ++j)
        factors.push_back(j == i ? derivative : product.op(j));
      terms.push_back(GiNaC::mul(factors));
    }
    return GiNaC::add(terms);
  }

  const GiNaC::exmap& derivative_;
  const GiNaC::exset& accelerations_;
};

}  // namespace

ChainSymbols::ChainSymbols(int number_of_links, const std::vector<Effect>& added, Space in)
    : links(number_of_links),
      space(in),
      angle(family("theta", links)),
      rate(family("thetadot", links)),
      acceleration(family("thetaddot", links)),
      length(positive_family("l", links)),
      mass(positive_family("m", links)),
      inertia(positive_family("I", links)),
      stiffness(positive_family("k", links)),
      damping(positive_family("c", links)),
      torque(family("T", in == Space::kPlane ? links : 2 * links)),
      load_mass(GiNaC::possymbol("m_c")),
      gravity(GiNaC::possymbol("g")) {
  direction.resize(angle.size());
  direction[0] = {0, 1, 0};
  if (space == Space::kPlane) {
    for (std::size_t i = 1; i < angle.size(); ++i)
      direction[i] = {GiNaC::sin(angle[i]), GiNaC::cos(angle[i]), 0};
  } else {
    const auto append = [](std::vector<GiNaC::ex>& to, const std::vector<GiNaC::ex>& azimuths) {
      to.insert(to.end(), azimuths.begin() + 1, azimuths.end());
    };
    append(angle, azimuth = family("phi", links));
    append(rate, azimuth_rate = family("phidot", links));
    append(acceleration, azimuth_acceleration = family("phiddot", links));
  }
  for (std::size_t i = 1; i < angle.size(); ++i) {
    derivative_[angle[i]] = rate[i];
    derivative_[rate[i]] = acceleration[i];
    accelerations_.insert(acceleration[i]);
  }
  for (const Effect& effect : added) {
    for (const EffectParameter& parameter : effect.parameters) {
      const std::string name = effect.id + "_" + parameter.name;
      const auto symbol = [&](const std::string& text) {
        return parameter.lower >= 0 ? GiNaC::ex(GiNaC::possymbol(text))
                                    : GiNaC::ex(GiNaC::realsymbol(text));
      };
      std::vector<GiNaC::ex>& symbols = effects[name];
      if (parameter.scope == Scope::kModel) {
        symbols = {symbol(name)};
        continue;
      }
      symbols = {0};
      for (int i = 1; i <= links; ++i) symbols.push_back(symbol(name + "_" + std::to_string(i)));
    }
  }
}

GiNaC::ex ChainSymbols::time_derivative(const GiNaC::ex& expression) const {
  return TimeDerivative(derivative_, accelerations_)(expression);
}

bool ChainSymbols::is_constant(const GiNaC::ex& expression) const {
  for (GiNaC::const_preorder_iterator i = expression.preorder_begin();
       i != expression.preorder_end(); ++i)
    if (derivative_.count(*i) != 0 || accelerations_.count(*i) != 0) return false;
  return true;
}

GiNaC::ex derivative(const GiNaC::ex& expression, const GiNaC::ex& symbol) {
  return expression.diff(GiNaC::ex_to<GiNaC::symbol>(symbol));
}

}  // namespace catena::checking
