// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <string>

#include "generator/checking/scope.hpp"
#include "generator/checking/syntax_tree.hpp"

namespace catena::checking {

/// Evaluates expressions in a scope. A sum binds its index in the scope. Reading an entry that is
/// not set yet adds a note to the scope. Throws InputError with file, line and column.
class ExpressionEvaluator {
 public:
  explicit ExpressionEvaluator(Scope& scope) : scope_(scope) {}

  /// The value of a whole expression. Throws Overlong (budget.hpp) if it costs too much.
  GiNaC::ex value(const Expression& expression);
  /// `what` names the number in messages.
  int integer(const Expression& expression, const std::string& what);
  /// Whether a condition between numbers holds.
  bool holds(const Expression& condition);

  /// A name with its subscripts evaluated: both theta_i and theta[i] are theta with one index.
  Reference resolve(const Expression& name);
  /// The value of a name.
  GiNaC::ex read(const Expression& name);
  /// Fails unless lowest <= index <= highest, the number of links or of coordinates.
  void check_range(Location at, const Reference& reference, int index, int lowest,
                   int highest) const;

  /// Runs `body` with the index bound to each number of a range for which the condition, if there
  /// is one, holds.
  void over_range(const std::string& index, const Expression& from, const Expression& to,
                  const Expression* condition, const std::function<void()>& body);

 private:
  [[noreturn]] void fail(Location at, const std::string& message) const {
    scope_.fail(at, message);
  }
  [[nodiscard]] int links() const { return scope_.links(); }
  [[nodiscard]] int coordinates() const { return scope_.coordinates(); }

  [[nodiscard]] GiNaC::ex family_member(Location at, const Reference& reference,
                                        Family family) const;
  GiNaC::ex unset(Location at, const Reference& reference);

  GiNaC::ex evaluate(const Expression& expression);
  GiNaC::numeric number(const Expression& expression);
  GiNaC::ex terms(const Expression& expression);
  GiNaC::ex factors(const Expression& expression);
  GiNaC::ex power(const Expression& expression);
  GiNaC::ex call(const Expression& call);
  GiNaC::ex extreme(const Expression& call);
  GiNaC::ex derivative(const Expression& call);
  GiNaC::ex variable(const Expression& expression);
  void expect_arguments(const Expression& call, std::size_t least, std::size_t most) const;

  Scope& scope_;
};

}  // namespace catena::checking
