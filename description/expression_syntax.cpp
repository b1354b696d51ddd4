// SPDX-License-Identifier: BSD-3-Clause
#include "description/expression_syntax.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string_view>
#include <utility>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "common/nesting.hpp"

namespace catena {
namespace {

constexpr std::size_t kLongest = 4000;  // characters; also bounds the depth of the tree

// What people reach for that has no derivative everywhere, and what to write instead.
const std::map<std::string, std::string>& smooth_substitutes() {
  static const std::map<std::string, std::string> substitutes = {
      {"abs", "sqrt(x^2 + floor^2)"},
      {"sign", "x/sqrt(x^2 + floor^2)"},
      {"sgn", "x/sqrt(x^2 + floor^2)"},
      {"max", "(a + b + sqrt((a - b)^2 + floor^2))/2"},
      {"min", "(a + b - sqrt((a - b)^2 + floor^2))/2"},
  };
  return substitutes;
}

bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

/// 0, or between 1e-300 and 1e300 in size: what pages and emitted programs can hold. Zeros may not
/// have such an exponent either.
bool is_ordinary(const std::string& number) {
  constexpr double kGreatestExponent = 300;
  const double size = std::strtod(number.c_str(), nullptr);
  const std::size_t e = number.find_first_of("eE");
  const double exponent = e == std::string::npos ? 0 : std::strtod(number.c_str() + e + 1, nullptr);
  const bool is_zero = number.substr(0, e).find_first_of("123456789") == std::string::npos;
  return std::abs(exponent) <= kGreatestExponent &&
         (is_zero || std::abs(std::log10(size)) <= kGreatestExponent);
}

class Parser {
 public:
  explicit Parser(const Expression& expression) : expression_(expression), text_(expression.text) {
    if (text_.size() > kLongest) {
      throw InputError(expression.file + ":" + std::to_string(expression.line) + ": " +
                       expression.key + ": an expression of " + std::to_string(text_.size()) +
                       " characters is too long; use definitions");
    }
  }

  SyntaxNode parse() {
    SyntaxNode node = sum();
    if (!at_end()) fail(in_quotes(text_.substr(at_, 1)) + " cannot stand here" + here());
    return node;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { fail_at(expression_, problem); }

  std::string here() const { return ", at its character " + std::to_string(at_ + 1); }

  bool at_end() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ == text_.size();
  }

  bool next_is(char wanted) { return !at_end() && text_[at_] == wanted; }

  bool take(char wanted) {
    if (!next_is(wanted)) return false;
    ++at_;
    return true;
  }

  std::size_t start() {
    at_end();
    return at_;
  }

  SyntaxNode node(SyntaxNode::Kind kind, std::size_t begin, std::string name,
                  std::vector<SyntaxNode> operands = {}) const {
    std::string_view text = text_.substr(begin, at_ - begin);
    while (std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
    return {kind, std::string(text), std::move(name), std::move(operands)};
  }

  SyntaxNode sum() {
    const std::size_t begin = start();
    SyntaxNode total = product();
    while (next_is('+') || next_is('-')) {
      const auto kind = text_[at_] == '+' ? SyntaxNode::kAdd : SyntaxNode::kSubtract;
      ++at_;
      SyntaxNode right = product();
      total = node(kind, begin, "", {std::move(total), std::move(right)});
    }
    return total;
  }

  SyntaxNode product() {
    const std::size_t begin = start();
    SyntaxNode total = factor();
    while (next_is('*') || next_is('/')) {
      const auto kind = text_[at_] == '*' ? SyntaxNode::kMultiply : SyntaxNode::kDivide;
      ++at_;
      SyntaxNode right = factor();
      total = node(kind, begin, "", {std::move(total), std::move(right)});
    }
    return total;
  }

  SyntaxNode factor() {
    const Nesting nesting(*this);
    const std::size_t begin = start();
    if (take('-')) {
      SyntaxNode operand = factor();
      return node(SyntaxNode::kNegate, begin, "", {std::move(operand)});
    }
    if (take('+')) return factor();
    return power();
  }

  SyntaxNode power() {
    const std::size_t begin = start();
    SyntaxNode base = primary();
    if (!take('^')) return base;
    SyntaxNode exponent = factor();
    return node(SyntaxNode::kPower, begin, "", {std::move(base), std::move(exponent)});
  }

  SyntaxNode primary() {
    const std::size_t begin = start();
    if (at_end()) fail("it ends where a number, a name or a parenthesis is wanted");
    if (take('(')) {
      SyntaxNode inside = sum();
      if (!take(')')) {
        fail("the parenthesis at its character " + std::to_string(begin + 1) + " is not closed");
      }
      inside.text = std::string(text_.substr(begin, at_ - begin));
      return inside;
    }
    if (is_digit(text_[at_]) || text_[at_] == '.') return number();
    if (!is_letter(text_[at_])) {
      fail(in_quotes(text_.substr(at_, 1)) + " cannot stand here" + here());
    }
    while (at_ < text_.size() &&
           (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '_')) {
      ++at_;
    }
    const std::string name(text_.substr(begin, at_ - begin));
    const std::size_t after = at_;
    if (next_is('(')) return call(begin, name);
    at_ = after;
    return node(SyntaxNode::kName, begin, name);
  }

  SyntaxNode number() {
    const std::size_t begin = at_;
    const auto digits = [&] {
      const std::size_t first = at_;
      while (at_ < text_.size() && is_digit(text_[at_])) ++at_;
      return at_ > first;
    };
    bool any = digits();
    if (at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      any = digits() || any;
    }
    if (any && at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      ++at_;
      if (at_ < text_.size() && (text_[at_] == '-' || text_[at_] == '+')) ++at_;
      any = digits();
    }
    const std::string text(text_.substr(begin, at_ - begin));
    if (!any) fail(in_quotes(text) + " is not a number; write 12, 0.5 or 1e-6");
    if (!is_ordinary(text))
      fail(in_quotes(text) + " is too large or too small: at most 1e300, and 0 or at least 1e-300");
    return node(SyntaxNode::kNumber, begin, text);
  }

  SyntaxNode call(std::size_t begin, const std::string& name) {
    if (const auto smooth = smooth_substitutes().find(name); smooth != smooth_substitutes().end()) {
      fail(name + " has no derivative everywhere; write " + smooth->second +
           " with a small constant");
    }
    static const std::vector<std::string> known = {"sin",  "cos",  "tan",  "exp",  "log",  "sqrt",
                                                   "tanh", "sinh", "cosh", "atan", "asinh"};
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      fail(in_quotes(name) + " is no known function" + suggestion(name, known) +
           "; a product is written " + name + "*(...)");
    }
    take('(');
    SyntaxNode argument = sum();
    if (!take(')')) fail(name + "(...) takes one argument and ends with a parenthesis" + here());
    return node(SyntaxNode::kCall, begin, name, {std::move(argument)});
  }

  // Counts how deep parentheses and signs are nested while it lives.
  struct Nesting {
    explicit Nesting(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > kDeepestNesting)
        parser_.fail("it is nested too deeply; use definitions");
    }
    ~Nesting() { --parser_.depth_; }
    Parser& parser_;
  };

  const Expression& expression_;
  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

void collect_names(const SyntaxNode& node, std::set<std::string>& names) {
  if (node.kind == SyntaxNode::kName) names.insert(node.name);
  for (const SyntaxNode& operand : node.operands) collect_names(operand, names);
}

}  // namespace

SyntaxNode parse_syntax(const Expression& expression) { return Parser(expression).parse(); }

std::set<std::string> names_in(const Expression& expression) {
  std::set<std::string> names;
  if (expression.given()) collect_names(parse_syntax(expression), names);
  return names;
}

void fail_at(const Expression& expression, const std::string& problem) {
  throw InputError(expression.file + ":" + std::to_string(expression.line) + ": " + expression.key +
                   ": in " + in_quotes(expression.text) + ": " + problem);
}

}  // namespace catena
