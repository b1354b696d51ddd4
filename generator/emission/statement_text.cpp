// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/statement_text.hpp"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace catena {

namespace {

constexpr size_t kWidth = 100;

// " + 2", " - 2" or nothing
std::string shift_text(long shift) {
  if (shift == 0) return "";
  return (shift > 0 ? " + " : " - ") + std::to_string(std::labs(shift));
}

// Where to break: before the last sum in reach outside brackets, or else the last product.
size_t break_of(const std::string& text, size_t from) {
  size_t sum = std::string::npos, product = std::string::npos;
  int brackets = 0;
  for (size_t k = 0; k + 2 < kWidth; ++k) {
    if (text[k] == '[') ++brackets;
    if (text[k] == ']') --brackets;
    if (k <= from || brackets > 0 || text[k] != ' ' || text[k + 2] != ' ') continue;
    if (text[k + 1] == '+' || text[k + 1] == '-') sum = k;
    if (text[k + 1] == '*') product = k;
  }
  return sum != std::string::npos && sum > from + kWidth / 3 ? sum
         : product != std::string::npos                      ? product
                                                             : sum;
}

class Printer {
 public:
  Printer(Language language, int depth, Arrays arrays)
      : in_c_(language == Language::kC),
        aligned_(!in_c_ && arrays == Arrays::kAligned),
        depth_(depth) {}

  std::string text() && { return std::move(text_); }

  void operator()(const Statements& statements) {
    for (const Statement& statement : statements) std::visit(*this, statement);
  }

  void operator()(const Input& input) {
    const std::string type = type_text(input.type), array = array_text(input.array);
    const std::string constant = "const " + type + " " + input.name;
    switch (input.kind) {
      case InputKind::kArray: {
        const std::string first =
            input.place == Affine() ? array : array + " + " + affine_text(input.place);
        return line(in_c_ ? "const double* const " + input.name + " = " + first + ";"
                          : "const FromOne<" + type + "> " + input.name + "(" + first + ");");
      }
      case InputKind::kEntry:
        return line(constant + " = " + array + "[" + affine_text(input.place) + "];");
      case InputKind::kNumber:
        return line(constant + " = " + array + ";");
      case InputKind::kSinesAndCosines: {
        const std::string angles = affine_text(input.place);
        Affine size = input.place;
        size += 1;
        line(type + " sine[" + affine_text(size) + "], cosine[" + affine_text(size) + "];");
        const std::string arguments = array + ", sine + 1, cosine + 1);";
        return line(in_c_                    ? "sines_and_cosines(" + arguments
                    : input.place.slope != 0 ? "sines_and_cosines(" + angles + ", " + arguments
                                             : "sines_and_cosines<" + angles + ">(" + arguments);
      }
      case InputKind::kPi: {
        const std::string pi = "3.14159265358979323846";
        return line(constant + " = " + (in_c_ ? pi : "T(" + pi + ")") + ";");
      }
      case InputKind::kZero:
        return line(constant + " = " + (in_c_ ? "0.0" : type + "(0)") + ";");
    }
  }

  void operator()(const Variable& variable) {
    const std::string type = type_text(variable.type), end = variable.zero ? " = {};" : ";";
    if (!variable.entries) return line(type + " " + variable.name + end);
    const std::string entries = affine_text(*variable.entries);
    line(aligned_ ? "LinkArray<" + type + ", " + entries + "> " + variable.name + end
                  : type + " " + variable.name + "[" + entries + "]" + end);
  }

  void operator()(const NamedValue& named) {
    line("const " + type_text(named.type) + " " + named.name + " = " + sum_text(named.value) + ";");
  }

  void operator()(const Assignment& assignment) {
    std::string target = array_text(assignment.array);
    if (assignment.place) target += "[" + place_text(*assignment.place) + "]";
    const std::string value = sum_text(assignment.value);
    line(target + (assignment.adds ? " += " : " = ") +
         (assignment.as_differential && !in_c_ ? "D(" + value + ")" : value) + ";");
  }

  void operator()(const Block& block) {
    std::string condition;
    for (const std::string& name : block.unless_zero)
      condition += (condition.empty() ? "if (any_nonzero(" : ", ") + name;
    in_braces(condition + (condition.empty() ? "{" : ")) {"), block.body);
  }

  void operator()(const Loop& loop) {
    const bool up = loop.step > 0;
    in_braces("for (int i = " + affine_text(loop.first) + "; i " + (up ? "<" : ">") + "= " +
                  affine_text(loop.last) + "; " + (up ? "++" : "--") + "i) {",
              loop.body);
  }

 private:
  void in_braces(const std::string& head, const Statements& body) {
    line(head);
    ++depth_;
    (*this)(body);
    --depth_;
    line("}");
  }

  void line(const std::string& statement) {
    const size_t own = static_cast<size_t>(2 * depth_);
    const std::string indent(own + 4, ' ');
    std::string rest = std::string(own, ' ') + statement;
    while (rest.size() > kWidth) {
      const size_t at = break_of(rest, indent.size());
      if (at == std::string::npos) break;
      text_ += rest.substr(0, at) + "\n";
      rest = indent + rest.substr(at + 1);
    }
    text_ += rest + "\n";
  }

  std::string type_text(Type type) const {
    return in_c_ ? "double" : type == Type::kDifferential ? "D" : "T";
  }

  std::string array_text(const Array& array) const {
    std::string text =
        array.owner.empty() ? array.name : array.owner + (in_c_ ? "->" : ".") + array.name;
    if (array.row) text += "[" + std::to_string(*array.row) + "]";
    return text;
  }

  static std::string place_text(const ArrayPlace& place, int shift = 0) {
    std::string text = place.base == Affine() ? "" : affine_text(place.base) + " + ";
    Affine at = place.at;
    at += shift;
    if (!place.of_link) return text + affine_text(at);
    if (at.slope != 0) throw std::logic_error("a number of links beside a loop's i");
    return text + "i" + shift_text(at.constant);
  }

  // Arrays of inputs count from 0 in C; in C++ FromOne lets them count from 1, as links do.
  std::string read_text(const Read& read) const {
    if (!read.place) return read.name;
    return read.name + "[" + place_text(*read.place, in_c_ && read.is_argument ? -1 : 0) + "]";
  }

  std::string number_text(const Number& number) const {
    const std::string above = integer_text(number.numerator);
    if (number.denominator == 1) return in_c_ ? above : "T(" + above + ")";
    const std::string below = integer_text(number.denominator);
    return in_c_ ? "(" + above + " / " + below + ")" : "ratio<T>(" + above + ", " + below + ")";
  }

  // What an int may not hold is written as a double literal: the nearest double either way.
  std::string integer_text(double value) const {
    if (std::abs(value) < 1e9) return std::to_string(std::lround(value)) + (in_c_ ? ".0" : "");
    std::ostringstream out;
    out.precision(17);
    out << std::scientific << value;
    return out.str();
  }

  std::string factor_text(const Factor& factor) const {
    if (const auto* number = std::get_if<Number>(&factor.value)) return number_text(*number);
    if (const auto* read = std::get_if<Read>(&factor.value)) return read_text(*read);
    if (const auto* call = std::get_if<Call>(&factor.value))
      return call->function + "(" + read_text(call->argument) + ")";
    const Sum& sum = std::get<Sum>(factor.value);
    return sum.size() == 1 ? sum_text(sum) : "(" + sum_text(sum) + ")";
  }

  std::string factors_text(const std::vector<Factor>& factors) const {
    std::string text;
    for (const Factor& factor : factors) text += (text.empty() ? "" : " * ") + factor_text(factor);
    return text;
  }

  std::string sum_text(const Sum& sum) const {
    std::string text;
    for (const Product& product : sum) {
      text += text.empty() ? (product.negative ? "-" : "") : product.negative ? " - " : " + ";
      text += factors_text(product.above);
      if (product.below.empty()) continue;
      const std::string divisor = factors_text(product.below);
      text += product.below.size() == 1 ? " / " + divisor : " / (" + divisor + ")";
    }
    return text;
  }

  bool in_c_;
  bool aligned_;
  int depth_;
  std::string text_;
};

}  // namespace

std::string affine_text(const Affine& affine) {
  if (affine.slope == 0) return std::to_string(affine.constant);
  return (affine.slope == 1 ? "links" : std::to_string(affine.slope) + " * links") +
         shift_text(affine.constant);
}

std::string statements_text(const Statements& statements, Language language, int depth,
                            Arrays arrays) {
  Printer printer(language, depth, arrays);
  printer(statements);
  return std::move(printer).text();
}

}  // namespace catena
