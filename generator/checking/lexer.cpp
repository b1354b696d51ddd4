// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/lexer.hpp"

#include <array>
#include <cctype>

#include "common/in_quotes.hpp"

namespace catena::checking {
namespace {

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

// Longest first, so that ".." is not read as two dots nor "<=" as "<" and "=".
constexpr std::array<std::string_view, 22> kSigns = {"..", "<=", ">=", "==", "!=", "+", "-", "*",
                                                     "/",  "^",  "(",  ")",  "[",  "]", ",", "=",
                                                     "<",  ">",  ":",  ";",  "{",  "}"};

bool joins_lines(const Token& token) {
  static constexpr std::array<std::string_view, 17> kJoining = {
      "+", "-", "*", "/", "^", ",", "=", "<", ">", "<=", ">=", "==", "!=", "..", ":", "and", "or"};
  if (token.kind != Token::Kind::kSign && token.kind != Token::Kind::kName) return false;
  for (const std::string_view sign : kJoining)
    if (token.text == sign) return true;
  return false;
}

class Lexer {
 public:
  Lexer(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  std::vector<Token> run() {
    while (true) {
      skip_blanks();
      if (position_ >= text_.size()) break;
      read_token();
    }
    push(Token::Kind::kEndOfStatement, "", here());
    push(Token::Kind::kEndOfFile, "", here());
    return join_lines();
  }

 private:
  Location here() const { return {line_, static_cast<int>(position_ - line_start_) + 1}; }
  char at(std::size_t offset) const {
    return position_ + offset < text_.size() ? text_[position_ + offset] : '\0';
  }

  void skip_blanks() {
    while (position_ < text_.size()) {
      const char c = text_[position_];
      if (c == '#') {
        while (position_ < text_.size() && text_[position_] != '\n') ++position_;
      } else if (c == ' ' || c == '\t' || c == '\r') {
        ++position_;
      } else {
        return;
      }
    }
  }

  void push(Token::Kind kind, std::string text, Location where) {
    tokens_.push_back({kind, std::move(text), where});
  }

  void read_token() {
    const Location start = here();
    const char c = at(0);
    if (c == '\n') {
      push(Token::Kind::kEndOfStatement, "", start);
      ++position_;
      ++line_;
      line_start_ = position_;
    } else if (is_digit(c) || (c == '.' && is_digit(at(1)))) {
      push(Token::Kind::kNumber, read_number(), start);
    } else if (is_letter(c)) {
      push(Token::Kind::kName, read_name(), start);
    } else if (c == '"') {
      push(Token::Kind::kText, read_text(start), start);
    } else {
      push(Token::Kind::kSign, read_sign(start), start);
    }
  }

  std::string read_number() {
    const std::size_t start = position_;
    while (is_digit(at(0))) ++position_;
    if (at(0) == '.' && at(1) != '.') {
      ++position_;
      while (is_digit(at(0))) ++position_;
    }
    const std::size_t sign = at(1) == '+' || at(1) == '-' ? 1 : 0;
    if ((at(0) == 'e' || at(0) == 'E') && is_digit(at(1 + sign))) {
      position_ += 1 + sign;
      while (is_digit(at(0))) ++position_;
    }
    if (is_letter(at(0)) || at(0) == '_')
      throw error_at(file_, here(),
                     "a number is followed by '" + std::string(1, at(0)) +
                         "'; expected an operator (write products with *)");
    return std::string(text_.substr(start, position_ - start));
  }

  std::string read_name() {
    const Location where = here();
    const std::size_t start = position_;
    while (is_letter(at(0)) || is_digit(at(0)) ||
           (at(0) == '_' && (is_letter(at(1)) || is_digit(at(1)))))
      ++position_;
    if (at(0) == '_')
      throw error_at(file_, here(),
                     "expected a letter or a digit after '_'; a subscript that is an expression "
                     "goes into brackets, as in k[i+1]");
    std::string name(text_.substr(start, position_ - start));
    if (name.size() > kMostQuoted)  // messages repeat names whole
      throw error_at(file_, where,
                     "the name " + in_quotes(name) + " is too long; at most " +
                         std::to_string(kMostQuoted) + " characters are possible");
    return name;
  }

  std::string read_text(Location start) {
    const std::size_t end = text_.find_first_of("\"\n", position_ + 1);
    if (end == std::string_view::npos || text_[end] == '\n')
      throw error_at(file_, start, "this text has no closing quote on its line");
    std::string result(text_.substr(position_ + 1, end - position_ - 1));
    position_ = end + 1;
    return result;
  }

  std::string read_sign(Location start) {
    for (const std::string_view sign : kSigns) {
      if (text_.substr(position_, sign.size()) == sign) {
        position_ += sign.size();
        if (sign == "{" || sign == "}")
          throw error_at(file_, start, "braces have no meaning here; expected ( or [");
        return std::string(sign);
      }
    }
    // A character outside ASCII is several bytes long: show all of them.
    std::size_t length = 1;
    while ((static_cast<unsigned char>(at(length)) & 0xC0U) == 0x80U) ++length;
    throw error_at(file_, start,
                   "unexpected character '" + std::string(text_.substr(position_, length)) +
                       "'; expected a name, a number, an operator or a bracket");
  }

  /// Drops the ends of lines inside brackets and beside operators, and turns semicolons outside
  /// brackets into ends of statements (inside they separate the rows of a matrix).
  std::vector<Token> join_lines() const {
    std::vector<Token> result;
    int depth = 0;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      Token token = tokens_[i];
      if (token.kind == Token::Kind::kSign) {
        if (token.text == "(" || token.text == "[") ++depth;
        if (token.text == ")" || token.text == "]") --depth;
        if (token.text == ";" && depth <= 0) token.kind = Token::Kind::kEndOfStatement;
      } else if (token.kind == Token::Kind::kEndOfStatement) {
        const bool last = tokens_[i + 1].kind == Token::Kind::kEndOfFile;
        if (!last && (depth > 0 || (!result.empty() && joins_lines(result.back())))) continue;
        std::size_t next = i + 1;
        while (tokens_[next].kind == Token::Kind::kEndOfStatement) ++next;
        if (joins_lines(tokens_[next])) continue;
      }
      result.push_back(std::move(token));
    }
    return result;
  }

  std::string_view text_;
  const std::string& file_;
  std::size_t position_ = 0;
  std::size_t line_start_ = 0;
  int line_ = 1;
  std::vector<Token> tokens_;
};

}  // namespace

InputError error_at(const std::string& file, Location at, const std::string& message) {
  return InputError(file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column) +
                    ": error: " + message);
}

std::string described(const Token& token) {
  if (token.kind == Token::Kind::kEndOfFile) return "the end of the file";
  if (token.kind == Token::Kind::kEndOfStatement)
    return token.text == ";" ? "';'" : "the end of the line";
  if (token.kind == Token::Kind::kText) return "the text " + in_quotes(token.text);
  return "'" + shortened(token.text) + "'";
}

std::vector<Token> tokenize(std::string_view text, const std::string& file) {
  return Lexer(text, file).run();
}

}  // namespace catena::checking
