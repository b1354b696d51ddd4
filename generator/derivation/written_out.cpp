// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/written_out.hpp"

namespace catena {

using GiNaC::ex;

namespace {

struct OneSquare : GiNaC::map_function {
  ex operator()(const ex& e) override {
    if (GiNaC::is_a<GiNaC::power>(e) && e.op(1).is_equal(2) &&
        GiNaC::is_the_function<GiNaC::sin_SERIAL>(e.op(0))) {
      return 1 - GiNaC::pow(GiNaC::cos(e.op(0).op(0)), 2);
    }
    return e.map(*this);
  }
};

}  // namespace

ex WrittenOut::of(const ex& expression) {
  GiNaC::exmap values;
  for (const int number : definitions_.symbols_of(expression)) {
    if (!definitions_[number].is_input) values[definitions_[number].symbol] = of_symbol(number);
  }
  return expression.subs(values, GiNaC::subs_options::no_pattern).expand();
}

ex WrittenOut::of_symbol(int number) {
  const auto found = known_.find(number);
  if (found != known_.end()) return found->second;
  const ex value = definitions_[number].value;
  return known_[number] = of(value);
}

ex without_sine_squares(const ex& expression) {
  OneSquare one_square;
  return one_square(expression).expand();
}

}  // namespace catena
