// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/parser.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include "common/nesting.hpp"
#include "generator/checking/lexer.hpp"

namespace catena::checking {
namespace {

constexpr std::array<std::string_view, 16> kReserved = {
    "for", "if",    "then",    "else",     "elseif", "end",      "and",      "or",
    "not", "given", "symbols", "positive", "links",  "equation", "identity", "symmetric"};

bool is_reserved(const std::string& name) {
  return std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end();
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& file)
      : file_(file), tokens_(tokenize(text, file)) {}

  Program run() {
    Program program = block({});
    if (next().kind != Token::Kind::kEndOfFile) fail("a statement");
    return program;
  }

 private:
  /// Counts how deep the descent is while it lives.
  class Depth {
   public:
    explicit Depth(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > kDeepestNesting)
        throw error_at(parser_.file_, parser_.next().at,
                       "nested more than " + std::to_string(kDeepestNesting) + " deep");
    }
    ~Depth() { --parser_.depth_; }
    Depth(const Depth&) = delete;
    Depth& operator=(const Depth&) = delete;

   private:
    Parser& parser_;
  };

  const Token& next() const { return tokens_[position_]; }
  const Token& after_next() const { return tokens_[std::min(position_ + 1, tokens_.size() - 1)]; }
  Token take() { return tokens_[position_ + 1 < tokens_.size() ? position_++ : position_]; }

  [[noreturn]] void fail(const std::string& expected) const {
    throw error_at(file_, next().at, "expected " + expected + ", found " + described(next()));
  }
  bool sees(std::string_view text) const {
    return (next().kind == Token::Kind::kSign || next().kind == Token::Kind::kName) &&
           next().text == text;
  }
  bool accept(std::string_view text) {
    if (!sees(text)) return false;
    ++position_;
    return true;
  }
  void expect(std::string_view text, const std::string& expected) {
    if (!accept(text)) fail(expected);
  }
  void expect_closing(std::string_view text, Location opened) {
    if (!accept(text))
      fail("an operator, or '" + std::string(text) + "' to close the bracket opened at line " +
           std::to_string(opened.line) + ", column " + std::to_string(opened.column));
  }
  bool at_end_of_statement() const {
    return next().kind == Token::Kind::kEndOfStatement || next().kind == Token::Kind::kEndOfFile;
  }
  void end_statement() {
    if (next().kind == Token::Kind::kEndOfFile) return;
    if (next().kind != Token::Kind::kEndOfStatement)
      fail("an operator or the end of the statement");
    ++position_;
  }
  std::string name(const std::string& what) {
    if (next().kind != Token::Kind::kName || is_reserved(next().text)) fail(what);
    return take().text;
  }

  // ---- statements ----

  bool at_block_end(std::initializer_list<std::string_view> ends) const {
    return next().kind == Token::Kind::kEndOfFile ||
           std::any_of(ends.begin(), ends.end(), [&](std::string_view end) { return sees(end); });
  }

  std::vector<Statement> block(std::initializer_list<std::string_view> ends) {
    const Depth depth(*this);
    std::vector<Statement> statements;
    while (true) {
      while (next().kind == Token::Kind::kEndOfStatement) ++position_;
      if (at_block_end(ends)) return statements;
      statements.push_back(statement());
    }
  }

  Statement statement() {
    const Location at = next().at;
    if (accept("links")) {
      accept("=");
      std::vector<Expression> number = one(expression());
      if (!accept("in")) return simple(Statement::Kind::kLinks, at, {}, std::move(number));
      expect("space", "'space', as in 'links 3 in space'");
      return simple(Statement::Kind::kLinks, at, {"space"}, std::move(number));
    }
    if (accept("symbols")) return simple(Statement::Kind::kSymbols, at, names(), {});
    if (accept("positive")) return simple(Statement::Kind::kPositive, at, names(), {});
    if (accept("symmetric")) return simple(Statement::Kind::kSymmetric, at, names(), {});
    if (accept("for")) return loop(at);
    if (accept("if")) return condition(at);
    if (accept("given")) return with_ranges(assignment(Statement::Kind::kGiven, at));
    if (accept("equation")) return with_ranges(equation(at));
    if (accept("identity")) return identity(at);
    if (next().kind != Token::Kind::kName || is_reserved(next().text))
      fail(
          "a statement: an assignment such as M[1,2] = ..., links, symbols, positive, given, "
          "symmetric, equation, identity, for or if");
    return with_ranges(assignment(Statement::Kind::kAssign, at));
  }

  static std::vector<Expression> one(Expression expression) {
    std::vector<Expression> result;
    result.push_back(std::move(expression));
    return result;
  }

  Statement simple(Statement::Kind kind, Location at, std::vector<std::string> the_names,
                   std::vector<Expression> expressions) {
    end_statement();
    return {kind, at, std::move(the_names), std::move(expressions), {}, {}};
  }

  std::vector<std::string> names() {
    std::vector<std::string> result;
    do result.push_back(name("a name"));
    while (accept(","));
    return result;
  }

  Statement assignment(Statement::Kind kind, Location at) {
    Expression target = target_name();
    expect("=", "'=' and the value");
    Statement result{kind, at, {}, {}, {}, {}};
    result.expressions.push_back(std::move(target));
    result.expressions.push_back(sees("[") ? matrix() : expression());
    return result;
  }

  Expression target_name() {
    Expression target{Expression::Kind::kName, next().at, name("the name to assign to"), {}};
    const Location opened = next().at;
    if (sees("[") || sees("(")) {
      const std::string_view closing = take().text == "[" ? "]" : ")";
      target.children = list();
      expect_closing(closing, opened);
    }
    return target;
  }

  Statement equation(Location at) {
    Statement result{Statement::Kind::kEquation, at, {}, {}, {}, {}};
    result.expressions.push_back(expression());
    expect(":", "':' after the number of the equation, as in equation 1: left = right");
    result.expressions.push_back(expression());
    expect("=", "'=' between the two sides");
    result.expressions.push_back(expression());
    return result;
  }

  Statement identity(Location at) {
    Statement result{Statement::Kind::kIdentity, at, {""}, {}, {}, {}};
    if (next().kind == Token::Kind::kText) {
      result.names[0] = take().text;
      expect(":", "':' after the label of the identity");
    }
    result.expressions.push_back(expression());
    expect("=", "'=' between the two sides");
    result.expressions.push_back(expression());
    end_statement();
    return result;
  }

  /// i = from .. to [if condition]
  void range(Statement& result) {
    result.names = {name("the name of an index")};
    expect("=", "'=' and a range such as 1..n");
    range_bounds(result.expressions);
    if (accept("if")) result.expressions.push_back(expression());
  }

  void range_bounds(std::vector<Expression>& bounds) {
    bounds.push_back(expression());
    if (!accept("..") && !accept(":")) fail("'..' between the ends of a range, as in 1..n");
    bounds.push_back(expression());
  }

  Statement loop(Location at) {
    Statement result{Statement::Kind::kFor, at, {}, {}, {}, {}};
    range(result);
    end_statement();
    result.block = block({"end"});
    expect("end", "'end' of the loop begun at line " + std::to_string(at.line));
    end_statement();
    return result;
  }

  Statement condition(Location at) {
    const Depth depth(*this);
    Statement result{Statement::Kind::kIf, at, {}, {}, {}, {}};
    result.expressions.push_back(expression());
    if (sees("=")) fail("'==' to compare");
    accept("then");
    if (!at_end_of_statement()) fail("an operator or the end of the line");
    result.block = block({"elseif", "else", "end"});
    const Location inner = next().at;
    if (accept("elseif")) {
      result.otherwise.push_back(condition(inner));  // takes the common 'end' with it
      return result;
    }
    if (accept("else")) result.otherwise = block({"end"});
    expect("end", "'end' of the condition begun at line " + std::to_string(at.line));
    end_statement();
    return result;
  }

  /// STATEMENT for i = 1..n, j = i+1..n is the statement in nested loops.
  Statement with_ranges(Statement body) {
    std::vector<Statement> loops;
    if (accept("for")) {
      do {
        loops.push_back({Statement::Kind::kFor, next().at, {}, {}, {}, {}});
        range(loops.back());
        if (loops.size() > kDeepestNesting)
          throw error_at(file_, loops.back().at,
                         "nested more than " + std::to_string(kDeepestNesting) + " deep");
      } while (accept(","));
    }
    end_statement();
    while (!loops.empty()) {
      loops.back().block.push_back(std::move(body));
      body = std::move(loops.back());
      loops.pop_back();
    }
    return body;
  }

  // ---- expressions, loosest binding first ----

  Expression binary(const Token& sign, Expression left, Expression right) {
    Expression result{Expression::Kind::kBinary, sign.at, sign.text, {}};
    result.children.push_back(std::move(left));
    result.children.push_back(std::move(right));
    return result;
  }

  Expression expression() {
    const Depth depth(*this);
    Expression result = conjunction();
    while (sees("or")) {
      const Token sign = take();
      result = binary(sign, std::move(result), conjunction());
    }
    return result;
  }

  Expression conjunction() {
    Expression result = negation();
    while (sees("and")) {
      const Token sign = take();
      result = binary(sign, std::move(result), negation());
    }
    return result;
  }

  Expression negation() {
    if (!sees("not")) return comparison();
    const Depth depth(*this);
    const Location at = take().at;
    return {Expression::Kind::kNot, at, "", one(negation())};
  }

  Expression comparison() {
    Expression result = additive();
    for (const std::string_view sign : {"==", "!=", "<=", ">=", "<", ">"}) {
      if (!sees(sign)) continue;
      const Token token = take();
      return binary(token, std::move(result), additive());
    }
    return result;
  }

  Expression additive() {
    Expression first = multiplicative();
    if (!sees("+") && !sees("-")) return first;
    Expression result{Expression::Kind::kTerms, first.at, "+", one(std::move(first))};
    while (sees("+") || sees("-")) {
      result.text += take().text;
      result.children.push_back(multiplicative());
    }
    return result;
  }

  Expression multiplicative() {
    Expression first = unary();
    if (!sees("*") && !sees("/")) return first;
    Expression result{Expression::Kind::kFactors, first.at, "*", one(std::move(first))};
    while (sees("*") || sees("/")) {
      result.text += take().text;
      result.children.push_back(unary());
    }
    return result;
  }

  Expression unary() {
    if (!sees("+") && !sees("-")) return power();
    const Depth depth(*this);
    const Token sign = take();
    if (sign.text == "+") return unary();
    return {Expression::Kind::kNegate, sign.at, "", one(unary())};
  }

  Expression power() {
    Expression base = primary();
    if (!sees("^")) return base;
    const Depth depth(*this);
    const Token sign = take();
    return binary(sign, std::move(base), unary());
  }

  Expression primary() {
    const Token token = next();
    if (token.kind == Token::Kind::kNumber) {
      ++position_;
      return {Expression::Kind::kNumber, token.at, token.text, {}};
    }
    if (accept("(")) {
      Expression result = expression();
      expect_closing(")", token.at);
      return result;
    }
    if (accept("if")) return conditional(token.at);
    if (sees("sum") && after_next().text == "(") return sum();
    if (token.kind != Token::Kind::kName || is_reserved(token.text))
      fail("a number, a name or a bracket");
    ++position_;
    Expression result{Expression::Kind::kName, token.at, token.text, {}};
    const Location opened = next().at;
    if (accept("[")) {
      result.children = list();
      expect_closing("]", opened);
    } else if (accept("(")) {
      result.kind = Expression::Kind::kCall;
      result.children = list();
      expect_closing(")", opened);
    }
    return result;
  }

  Expression conditional(Location at) {
    Expression result{Expression::Kind::kConditional, at, "", {}};
    result.children.push_back(expression());
    expect("then", "'then' and the value if the condition holds");
    result.children.push_back(expression());
    expect("else", "'else' and the value if the condition does not hold");
    result.children.push_back(expression());
    return result;
  }

  /// sum(i = from .. to [if condition], body)
  Expression sum() {
    Expression result{Expression::Kind::kSum, take().at, "", {}};
    const Location opened = take().at;
    result.text = name("the index of the sum, as in sum(k = 1..n, m_k)");
    expect("=", "'=' and a range such as 1..n");
    range_bounds(result.children);
    std::vector<Expression> filter;
    if (accept("if")) filter = one(expression());
    expect(",", "',' and what is summed");
    result.children.push_back(expression());
    for (Expression& part : filter) result.children.push_back(std::move(part));
    expect_closing(")", opened);
    return result;
  }

  std::vector<Expression> list() {
    std::vector<Expression> result;
    do result.push_back(expression());
    while (accept(","));
    return result;
  }

  Expression matrix() {
    const Location opened = take().at;
    Expression result{Expression::Kind::kMatrix, opened, "", {}};
    do {
      Expression row{Expression::Kind::kRow, next().at, "", {}};
      row.children = list();
      result.children.push_back(std::move(row));
    } while (accept(";"));
    expect_closing("]", opened);
    return result;
  }

  const std::string& file_;
  std::vector<Token> tokens_;
  std::size_t position_ = 0;
  int depth_ = 0;
};

}  // namespace

Program parse_derivation(std::string_view text, const std::string& file) {
  return Parser(text, file).run();
}

}  // namespace catena::checking
