// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/written_out.hpp"

namespace catena {

using GiNaC::ex;

namespace {

struct NoSquares : GiNaC::map_function {
  ex operator()(const ex& e) override {
    if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::posint) &&
        GiNaC::is_the_function<GiNaC::sin_SERIAL>(e.op(0))) {
      const int exponent = GiNaC::ex_to<GiNaC::numeric>(e.op(1)).to_int();
      const ex square = 1 - GiNaC::pow(GiNaC::cos(e.op(0).op(0)), 2);
      return GiNaC::pow(square, exponent / 2) * GiNaC::pow(e.op(0), exponent % 2);
    }
    return e.map(*this);
  }
};

}  // namespace

ex WrittenOut::of(const ex& expression) {
  GiNaC::exmap values;
  for (const int number : definitions_.symbols_of(expression)) {
    const Symbol& symbol = definitions_[number];
    if (!symbol.is_input && !kept_.contains(symbol.family))
      values[definitions_[number].symbol] = of_symbol(number);
  }
  return expression.subs(values, GiNaC::subs_options::no_pattern).expand();
}

ex WrittenOut::of_symbol(int number) {
  const auto found = known_.find(number);
  if (found != known_.end()) return found->second;
  const ex value = definitions_[number].value;
  return known_[number] = of(value);
}

ex WriteOutDifferences::operator()(const ex& e) {
  const bool sine = GiNaC::is_the_function<GiNaC::sin_SERIAL>(e);
  if ((sine || GiNaC::is_the_function<GiNaC::cos_SERIAL>(e)) && GiNaC::is_a<GiNaC::add>(e.op(0))) {
    ex a = 0, b = 0;
    for (size_t i = 0; i < e.op(0).nops(); ++i) {
      const ex term = e.op(0).op(i);
      (GiNaC::is_a<GiNaC::symbol>(term) ? a : b) = GiNaC::is_a<GiNaC::symbol>(term) ? term : -term;
    }
    return sine ? GiNaC::sin(a) * GiNaC::cos(b) - GiNaC::cos(a) * GiNaC::sin(b)
                : GiNaC::cos(a) * GiNaC::cos(b) + GiNaC::sin(a) * GiNaC::sin(b);
  }
  return e.map(*this);
}

ex without_sine_squares(const ex& expression) {
  NoSquares no_squares;
  return no_squares(expression).expand();
}

}  // namespace catena
