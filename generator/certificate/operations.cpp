// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/certificate/operations.hpp"

#include <map>

namespace catena {
namespace {

using GiNaC::ex;

class Count {
 public:
  explicit Count(const Definitions& definitions) : definitions_(definitions) {}

  double of(const ex& e) {
    if (GiNaC::is_a<GiNaC::symbol>(e)) return of_symbol(definitions_.number_of(e));
    if (GiNaC::is_a<GiNaC::power>(e)) {
      const ex exponent = GiNaC::abs(e.op(1)).eval();
      const bool whole = exponent.info(GiNaC::info_flags::posint);
      const int times = whole ? GiNaC::ex_to<GiNaC::numeric>(exponent).to_int() : 1;
      const double own =
          (whole ? times - 1 : 1) + (e.op(1).info(GiNaC::info_flags::negative) ? 1 : 0);
      return times * of(e.op(0)) + own;
    }
    double sum = GiNaC::is_a<GiNaC::function>(e) ? 1 : 0;
    if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
      sum += static_cast<double>(e.nops()) - 1;
    }
    for (std::size_t i = 0; i < e.nops(); ++i) sum += of(e.op(i));
    return sum;
  }

 private:
  double of_symbol(int number) {
    const auto known = known_.find(number);
    if (known != known_.end()) return known->second;
    const Symbol symbol = definitions_[number];
    return known_[number] = symbol.is_input ? 0 : of(symbol.value);
  }

  const Definitions& definitions_;
  std::map<int, double> known_;
};

}  // namespace

double operations_written_out(const Definitions& definitions, const std::vector<ex>& values) {
  Count count(definitions);
  double sum = 0;
  for (const ex& value : values) sum += count.of(value);
  return sum;
}

}  // namespace catena
