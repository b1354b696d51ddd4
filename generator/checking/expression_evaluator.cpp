// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/expression_evaluator.hpp"

#include <algorithm>
#include <stdexcept>

#include "generator/checking/budget.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

/// Decimals are exact: 0.1 is 1/10.
numeric exact_number(const std::string& text) {
  std::string digits;
  long shift = 0;
  bool after_point = false;
  std::size_t i = 0;
  for (; i < text.size() && text[i] != 'e' && text[i] != 'E'; ++i) {
    if (text[i] == '.') {
      after_point = true;
    } else {
      digits += text[i];
      if (after_point) --shift;
    }
  }
  if (i < text.size()) shift += std::stol(text.substr(i + 1).substr(0, 9));
  const std::size_t first = std::min(digits.find_first_not_of('0'), digits.size() - 1);
  constexpr double kBitsPerDigit = 3.33;
  require_short_number(kBitsPerDigit *
                       (static_cast<double>(digits.size()) + std::abs(static_cast<double>(shift))));
  return numeric(digits.substr(first).c_str()) * GiNaC::pow(numeric(10), numeric(shift));
}

}  // namespace

Reference ExpressionEvaluator::resolve(const Expression& name) {
  Reference reference{name.text, {}};
  for (const Expression& index : name.children)
    reference.indices.push_back(integer(index, "an index"));
  if (!name.children.empty() || scope_.indices.count(name.text) != 0 || name.text == "m_c" ||
      scope_.free_symbols.count(name.text) != 0)
    return reference;
  const std::size_t split = name.text.rfind('_');
  if (split == std::string::npos) return reference;
  const std::string subscript = name.text.substr(split + 1);
  const auto bound = scope_.indices.find(subscript);
  if (bound != scope_.indices.end()) {
    reference.indices.push_back(bound->second);
  } else if (subscript == "n" && scope_.chain) {
    reference.indices.push_back(links());
  } else if (subscript.find_first_not_of("0123456789") == std::string::npos) {
    if (subscript.size() > 6) fail(name.at, "the subscript of '" + name.text + "' is too large");
    reference.indices.push_back(std::stoi(subscript));
  } else {
    return reference;
  }
  reference.name = name.text.substr(0, split);
  return reference;
}

void ExpressionEvaluator::check_range(Location at, const Reference& reference, int index,
                                      int lowest, int highest) const {
  if (index < lowest || index > highest)
    fail(at, reference.text() + ": the index " + std::to_string(index) + " is not in " +
                 std::to_string(lowest) + ".." + std::to_string(highest) + " (there are " +
                 std::to_string(links()) + " links)");
}

ex ExpressionEvaluator::read(const Expression& name) {
  const Reference reference = resolve(name);
  if (reference.indices.empty()) {
    const auto index = scope_.indices.find(reference.name);
    if (index != scope_.indices.end()) return index->second;
    if (reference.name == "pi") return GiNaC::Pi;
    const auto free = scope_.free_symbols.find(reference.name);
    if (free != scope_.free_symbols.end()) return free->second;
    if (scope_.chain && reference.name == "n") return links();
    if (scope_.chain && reference.name == "g") return scope_.chain->gravity;
    if (scope_.chain && reference.name == "m_c") return scope_.chain->load_mass;
    if (scope_.chain) {
      const auto effect = scope_.chain->effects.find(reference.name);
      if (effect != scope_.chain->effects.end() && effect->second.size() == 1)
        return effect->second.front();
    }
  } else if (scope_.chain) {
    const auto effect = scope_.chain->effects.find(reference.name);
    if (effect != scope_.chain->effects.end() && reference.indices.size() == 1) {
      check_range(name.at, reference, reference.indices[0], 1, links());
      if (effect->second.size() == 1)
        fail(name.at, "'" + reference.name + "' has no index; there is one for all links");
      return effect->second[static_cast<std::size_t>(reference.indices[0])];
    }
    const auto family = families().find(reference.name);
    if (is_family(reference.name, *scope_.chain))
      return family_member(name.at, reference, family->second);
  }
  const auto stored = scope_.values.find(reference);
  if (stored != scope_.values.end()) return stored->second.value;
  return unset(name.at, reference);
}

ex ExpressionEvaluator::family_member(Location at, const Reference& reference,
                                      Family family) const {
  if (reference.indices.size() != 1)
    fail(at, reference.text() + ": expected one index" +
                 (reference.name == "I" ? "; the mass matrix is called M" : ""));
  const bool state = reference.name.rfind("theta", 0) == 0 ||  // theta_0 = 0, as in (2.9)
                     reference.name.rfind("phi", 0) == 0;
  check_range(at, reference, reference.indices[0], state ? 0 : 1,
              reference.name == "T" ? coordinates() : links());
  return ((*scope_.chain).*family)[static_cast<std::size_t>(reference.indices[0])];
}

// Entries of M, C, K, F and G count as 0 before they are set, and a note says so.
ex ExpressionEvaluator::unset(Location at, const Reference& reference) {
  const Target* target = scope_.chain ? target_named(reference.name) : nullptr;
  if (target != nullptr && target->indices > 0 && target->indices == reference.indices.size()) {
    for (const int index : reference.indices) check_range(at, reference, index, 1, coordinates());
    if (scope_.noted.insert({at.line, at.column}).second)
      scope_.notes.push_back("line " + std::to_string(at.line) + ": " + reference.text() +
                             " is read before it is set; unset entries are taken as 0");
    return 0;
  }
  if (target != nullptr && target->indices > 0)
    fail(at,
         "expected entries such as " + reference.name + (target->indices == 2 ? "[1,2]" : "[1]"));
  if (scope_.chain &&
      (is_family(reference.name, *scope_.chain) || scope_.chain->effects.contains(reference.name)))
    fail(at, "'" + reference.name + "' needs an index, as in " + reference.name + "_1");
  for (const auto& [known, stored] : scope_.values)
    if (known.name == reference.name)
      fail(at, reference.text() + " is not set (but " + known.text() + " is)");
  fail(at, "unknown name '" + reference.text() + "'; expected " +
               (scope_.chain ? "theta_i, thetadot_i, thetaddot_i, l_i, m_i, I_i, k_i, c_i, T_i "
                               "with an index in use, m_c, g, n, pi, a parameter of an effect "
                               "(--effect), "
                             : "a declared symbol, pi, ") +
               "or a name assigned before");
}

int ExpressionEvaluator::integer(const Expression& expression, const std::string& what) {
  const ex value = evaluate(expression);
  if (!value.info(GiNaC::info_flags::integer)) fail(expression.at, what + " must be an integer");
  const numeric number = GiNaC::ex_to<numeric>(value);
  if (GiNaC::abs(number) > 1000000) fail(expression.at, what + " is too large");
  return number.to_int();
}

bool ExpressionEvaluator::holds(const Expression& condition) {
  if (condition.kind == Expression::Kind::kNot) return !holds(condition.children[0]);
  if (condition.kind == Expression::Kind::kBinary) {
    const std::string& sign = condition.text;
    const auto& parts = condition.children;
    if (sign == "and") return holds(parts[0]) && holds(parts[1]);
    if (sign == "or") return holds(parts[0]) || holds(parts[1]);
    if (sign.size() == 2 || sign == "<" || sign == ">") {
      const numeric left = number(parts[0]), right = number(parts[1]);
      if (sign == "==") return left == right;
      if (sign == "!=") return left != right;
      if (sign == "<=") return left <= right;
      if (sign == ">=") return left >= right;
      return sign == "<" ? left < right : left > right;
    }
  }
  fail(condition.at, "expected a condition such as i == j or i < n");
}

numeric ExpressionEvaluator::number(const Expression& expression) {
  const ex value = evaluate(expression);
  if (!GiNaC::is_a<numeric>(value) || !GiNaC::ex_to<numeric>(value).is_real())
    fail(expression.at, "expected a number (made of indices, n and constants)");
  return GiNaC::ex_to<numeric>(value);
}

ex ExpressionEvaluator::value(const Expression& expression) {
  const ex result = evaluate(expression);
  require_moderate(result);
  return result;
}

ex ExpressionEvaluator::evaluate(const Expression& expression) {
  Budget::spend(1);
  using Kind = Expression::Kind;
  const auto& parts = expression.children;
  switch (expression.kind) {
    case Kind::kNumber:
      return exact_number(expression.text);
    case Kind::kName:
      return read(expression);
    case Kind::kCall:
      return call(expression);
    case Kind::kNegate:
      return -evaluate(parts[0]);
    case Kind::kTerms:
      return terms(expression);
    case Kind::kFactors:
      return factors(expression);
    case Kind::kBinary:
      return power(expression);
    case Kind::kSum: {
      GiNaC::exvector terms;
      over_range(expression.text, parts[0], parts[1], parts.size() > 3 ? &parts[3] : nullptr,
                 [&] { terms.push_back(evaluate(parts[2])); });
      return GiNaC::add(terms);
    }
    case Kind::kConditional:
      return evaluate(holds(parts[0]) ? parts[1] : parts[2]);
    case Kind::kNot:
      fail(expression.at, "a condition is no value; write if ... then ... else ...");
    case Kind::kMatrix:
    case Kind::kRow:
      break;
  }
  fail(expression.at, "a matrix can only stand alone to the right of =");
}

ex ExpressionEvaluator::terms(const Expression& expression) {
  GiNaC::exvector values;
  for (std::size_t i = 0; i < expression.children.size(); ++i) {
    const ex value = evaluate(expression.children[i]);
    values.push_back(expression.text[i] == '-' ? -value : value);
  }
  return GiNaC::add(values);
}

ex ExpressionEvaluator::factors(const Expression& expression) {
  GiNaC::exvector values;
  double bits = 0;
  for (std::size_t i = 0; i < expression.children.size(); ++i) {
    const ex value = evaluate(expression.children[i]);
    if (GiNaC::is_a<numeric>(value)) bits += bits_of(GiNaC::ex_to<numeric>(value));
    require_short_number(bits);
    const bool divides = expression.text[i] == '/';
    if (divides && value.is_zero()) fail(expression.children[i].at, "division by zero");
    values.push_back(divides ? GiNaC::pow(value, -1) : value);
  }
  return GiNaC::mul(values);
}

ex ExpressionEvaluator::power(const Expression& expression) {
  if (expression.text != "^")
    fail(expression.at, "a condition is no value; write if ... then ... else ...");
  const ex left = evaluate(expression.children[0]);
  const ex right = evaluate(expression.children[1]);
  if (left.is_zero() && !right.info(GiNaC::info_flags::positive))
    fail(expression.at, "0 raised to a power that is not a positive number");
  if (GiNaC::is_a<numeric>(right) && GiNaC::abs(GiNaC::ex_to<numeric>(right)) > 100)
    fail(expression.at, "an exponent beyond 100");
  return moderate_power(left, right);
}

ex ExpressionEvaluator::call(const Expression& call) {
  const std::string& name = call.text;
  const auto function = functions().find(name);
  if (function != functions().end()) {
    expect_arguments(call, 1, 1);
    const ex argument = evaluate(call.children[0]);
    try {
      return function->second(argument);
    } catch (const std::exception& error) {
      fail(call.at, name + " cannot be evaluated here: " + error.what());
    }
  }
  if (name == "max" || name == "min") return extreme(call);
  if (name == "ddt") {
    expect_arguments(call, 1, 1);
    if (!scope_.chain) fail(call.at, "ddt (d/dt) belongs to a chain; use diff(y, x)");
    const ex differentiated = evaluate(call.children[0]);
    Budget::spend(written_size(differentiated));
    try {
      return scope_.chain->time_derivative(differentiated);
    } catch (const std::invalid_argument& error) {
      fail(call.at, error.what());
    }
  }
  if (name == "diff") return derivative(call);
  if (name == "at") {
    expect_arguments(call, 3, 3);
    const ex changed = evaluate(call.children[0]);
    Budget::spend(written_size(changed));
    return changed.subs(variable(call.children[1]) == evaluate(call.children[2]),
                        GiNaC::subs_options::no_pattern);
  }
  // M(i,j) is M[i,j], as the dissertation writes it.
  const bool known =
      scope_.chain && (target_named(name) != nullptr || is_family(name, *scope_.chain));
  const bool assigned = std::any_of(
      scope_.values.begin(), scope_.values.end(),
      [&](const auto& value) { return value.first.name == name && !value.first.indices.empty(); });
  if (!known && !assigned)
    fail(call.at, "unknown function '" + name +
                      "'; expected sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, asinh, exp, "
                      "log, sqrt, abs, sign, max, min, sum, diff, at, ddt (write products with *)");
  Expression entry = call;
  entry.kind = Expression::Kind::kName;
  return read(entry);
}

void ExpressionEvaluator::expect_arguments(const Expression& call, std::size_t least,
                                           std::size_t most) const {
  const std::size_t count = call.children.size();
  if (count < least || count > most)
    fail(call.at, call.text + " has " + std::to_string(count) + " arguments; expected " +
                      std::to_string(least) +
                      (most > least ? " or " + std::to_string(most) : std::string()));
}

ex ExpressionEvaluator::extreme(const Expression& call) {
  numeric result = number(call.children[0]);
  for (const Expression& argument : call.children) {
    const numeric value = number(argument);
    if (call.text == "max" ? value > result : value < result) result = value;
  }
  return result;
}

ex ExpressionEvaluator::variable(const Expression& expression) {
  const ex symbol = evaluate(expression);
  if (!GiNaC::is_a<GiNaC::symbol>(symbol))
    fail(expression.at,
         "expected a symbol here, such as " + std::string(scope_.chain ? "theta_1" : "x"));
  return symbol;
}

// diff(y, x), diff(y, x, 2): partial derivatives with respect to a symbol.
ex ExpressionEvaluator::derivative(const Expression& call) {
  expect_arguments(call, 2, 3);
  const int order = call.children.size() < 3 ? 1 : integer(call.children[2], "the order");
  if (order < 0 || order > 10) fail(call.children[2].at, "an order from 0 to 10 is expected");
  ex result = evaluate(call.children[0]);
  const ex by = variable(call.children[1]);
  for (int k = 0; k < order; ++k) {
    Budget::spend(written_size(result));
    result = result.diff(GiNaC::ex_to<GiNaC::symbol>(by));
  }
  return result;
}

void ExpressionEvaluator::over_range(const std::string& index, const Expression& from,
                                     const Expression& to, const Expression* condition,
                                     const std::function<void()>& body) {
  if (scope_.free_symbols.count(index) != 0 || (scope_.chain && index == "n"))
    fail(from.at, "'" + index + "' already has a meaning; choose another index");
  const int first = integer(from, "the start of a range");
  const int last = integer(to, "the end of a range");
  const auto outer = scope_.indices.find(index);  // an index of the same name around this one
  const bool hides = outer != scope_.indices.end();
  const int hidden = hides ? outer->second : 0;
  for (int value = first; value <= last; ++value) {
    scope_.indices[index] = value;
    if (condition == nullptr || holds(*condition)) body();
  }
  if (hides) {
    scope_.indices[index] = hidden;
  } else {
    scope_.indices.erase(index);
  }
}

}  // namespace catena::checking
