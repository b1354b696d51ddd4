// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/chain_motion.hpp"

#include <algorithm>
#include <exception>
#include <utility>

#include "common/as_index.hpp"
#include "generator/checking/shared_tree.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using Vector = ChainMotion::Vector;

/// x of A x = b by elimination, exactly if the numbers are exact; nothing if A is singular.
std::optional<Vector> solution(std::vector<Vector> a, Vector b) {
  const std::size_t n = b.size();
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (GiNaC::abs(a[i][k]) > GiNaC::abs(a[pivot][k])) pivot = i;
    if (a[pivot][k].is_zero()) return std::nullopt;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    for (std::size_t i = k + 1; i < n; ++i) {
      const numeric factor = a[i][k] / a[k][k];
      for (std::size_t j = k + 1; j < n; ++j) a[i][j] = a[i][j] - factor * a[k][j];
      b[i] = b[i] - factor * b[k];
    }
  }
  for (std::size_t k = n; k-- > 0;) {
    for (std::size_t j = k + 1; j < n; ++j) b[k] = b[k] - a[k][j] * b[j];
    b[k] = b[k] / a[k][k];
  }
  return b;
}

std::optional<Vector> values_of(const std::vector<ex>& expressions, Evaluation& evaluate) {
  Vector result;
  for (const ex& expression : expressions) {
    const std::optional<numeric> value = evaluate(expression);
    if (!value) return std::nullopt;
    result.push_back(*value);
  }
  return result;
}

std::optional<std::vector<Vector>> values_of(const std::vector<std::vector<ex>>& rows,
                                             Evaluation& evaluate) {
  std::vector<Vector> result;
  for (const std::vector<ex>& row : rows) {
    std::optional<Vector> values = values_of(row, evaluate);
    if (!values) return std::nullopt;
    result.push_back(std::move(*values));
  }
  return result;
}

std::optional<Vector> solved(const std::vector<std::vector<ex>>& mass, const std::vector<ex>& rest,
                             const GiNaC::exmap& values) {
  Evaluation evaluate(values);
  const std::optional<std::vector<Vector>> a = values_of(mass, evaluate);
  std::optional<Vector> b = values_of(rest, evaluate);
  if (!a || !b) return std::nullopt;
  for (numeric& value : *b) value = -value;
  return solution(*a, *b);
}

GiNaC::exmap moving(GiNaC::exmap values, const ChainSymbols& chain, const Vector& accelerations) {
  for (int j = 1; j <= chain.coordinates(); ++j)
    values[chain.acceleration[as_index(j)]] = accelerations[as_index(j) - 1];
  return values;
}

}  // namespace

ChainMotion::ChainMotion(const ChainSymbols& chain, const FlatDerivation& model,
                         const GiNaC::exmap& given, const std::vector<ex>& equations,
                         std::uint64_t seed)
    : chain_(chain), seed_(seed) {
  Replacement replaced(given);
  GiNaC::exmap no_accelerations;
  for (int i = 1; i <= chain.coordinates(); ++i)
    no_accelerations[chain.acceleration[as_index(i)]] = 0;
  Replacement at_rest(no_accelerations);
  for (int i = 1; i <= chain.coordinates(); ++i) {
    system_.mass.emplace_back();
    for (int j = 1; j <= chain.coordinates(); ++j)
      system_.mass.back().push_back(replaced(total(model.mass(i, j))));
    system_.rest.push_back(at_rest(replaced(total(model.equation(i)))));
  }

  std::vector<ex> all = system_.rest;
  for (const std::vector<ex>& row : system_.mass) all.insert(all.end(), row.begin(), row.end());
  std::vector<ex> stated = all;
  for (const ex& h : equations) stated.push_back(at_rest(h));
  symbols_ = symbols_in(stated);
  for (const ex& h : equations)  // one without an exact form must not affect the others
    if (ExactForm({h})(h)) all.push_back(h);
  ExactForm exact(all);
  for (const ex& expression : all) {
    const std::optional<ex> rational = exact(expression);
    if (!rational) return;  // a parameter is given as a root, say: exact_ stays empty
    variable_.push_back(*rational);
  }
  exact_ = std::move(exact);

  // Cramer: determinants of n factors, one of each row. The row with its right side bounds each.
  Degree determinant;
  for (std::size_t i = 0; i < system_.rest.size(); ++i) {
    rational_.rest.push_back(*(*exact_)(system_.rest[i]));
    rational_.mass.emplace_back();
    Degree row = exact_->degree(rational_.rest[i]);
    double excess = row.numerator - row.denominator;
    for (const ex& entry : system_.mass[i]) {
      rational_.mass[i].push_back(*(*exact_)(entry));
      const Degree next = exact_->degree(rational_.mass[i].back());
      excess = std::max(excess, next.numerator - next.denominator);
      row.denominator += next.denominator;
    }
    determinant.numerator += row.denominator + excess;
    determinant.denominator += row.denominator;
  }
  solution_.numerator = solution_.denominator = determinant.numerator + determinant.denominator;
}

std::optional<bool> ChainMotion::is_obeyed(const ex& h) {
  const std::optional<ex> rational = exact_ ? (*exact_)(h) : std::nullopt;
  if (!rational) return std::nullopt;
  ExactForm::Degrees known;
  for (int j = 1; j <= chain_.coordinates(); ++j)
    known[chain_.acceleration[as_index(j)]] = solution_;
  const std::optional<int> bits = bits_for(exact_->degree(*rational, known));
  if (!bits) return std::nullopt;
  std::optional<Evaluation>& here = point(*bits);
  if (!here) return std::nullopt;
  const std::optional<numeric> value = (*here)(*rational);
  if (!value) return std::nullopt;
  return value->is_zero();
}

std::optional<Evaluation>& ChainMotion::point(int bits) {
  const auto [found, is_new] = points_.try_emplace(bits);
  if (!is_new) return found->second;
  const GiNaC::exmap values = exact_->point(variable_, bits, seed_);
  if (const std::optional<Vector> there = solved(rational_.mass, rational_.rest, values))
    found->second.emplace(moving(values, chain_, *there));
  return found->second;
}

const std::optional<Vector>& ChainMotion::accelerations(const NumericState& state) {
  const auto [found, is_new] = motions_.try_emplace(state.assignments);
  if (is_new) found->second = solved(system_.mass, system_.rest, state.values);
  return found->second;
}

std::map<int, numeric> ChainMotion::factors(const Vector& slope, const GiNaC::exmap& values) const {
  Evaluation evaluate(values);
  std::map<int, numeric> result;
  const std::optional<std::vector<Vector>> mass = values_of(system_.mass, evaluate);
  const std::optional<Vector> f = mass ? solution(*mass, slope) : std::nullopt;
  for (int j = 1; f && j <= chain_.coordinates(); ++j)
    if (GiNaC::abs((*f)[as_index(j) - 1]) > closeness()) result[j] = (*f)[as_index(j) - 1];
  return result;
}

std::optional<Vector> acceleration_factors(const ex& h, const ChainSymbols& chain,
                                           const GiNaC::exmap& values) {
  GiNaC::exmap numbers = values;
  for (int j = 1; j <= chain.coordinates(); ++j) numbers.erase(chain.acceleration[as_index(j)]);
  Evaluation evaluate(numbers);
  for (const ex& part : transcendental_parts({h})) {
    const std::optional<numeric> value = evaluate(part);
    if (!value) return std::nullopt;
    numbers[part] = *value;
  }
  try {
    const ex left = Replacement(numbers)(h).expand();  // only accelerations
    Vector result;
    for (int j = 1; j <= chain.coordinates(); ++j) {
      const ex factor =
          left.diff(GiNaC::ex_to<GiNaC::symbol>(chain.acceleration[as_index(j)])).evalf();
      if (!GiNaC::is_a<numeric>(factor)) return std::nullopt;
      result.push_back(GiNaC::ex_to<numeric>(factor));
    }
    return result;
  } catch (const std::exception&) {  // a pole
    return std::nullopt;
  }
}

}  // namespace catena::checking
