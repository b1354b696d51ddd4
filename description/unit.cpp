// SPDX-License-Identifier: BSD-3-Clause
#include "description/unit.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "common/in_quotes.hpp"
#include "common/nearest_name.hpp"
#include "common/nesting.hpp"

namespace catena {
namespace {

Exponent reduced(long numerator, long denominator) {
  if (denominator < 0) numerator = -numerator, denominator = -denominator;
  const long divisor = std::gcd(numerator, denominator);
  return {static_cast<int>(numerator / divisor), static_cast<int>(denominator / divisor)};
}

Exponent sum(Exponent a, Exponent b) {
  return reduced(static_cast<long>(a.numerator) * b.denominator +
                     static_cast<long>(b.numerator) * a.denominator,
                 static_cast<long>(a.denominator) * b.denominator);
}

Exponent product(Exponent a, Exponent b) {
  return reduced(static_cast<long>(a.numerator) * b.numerator,
                 static_cast<long>(a.denominator) * b.denominator);
}

struct Factors {
  int m, kg, s;
};

// In the order in which they are tried as names.
const std::vector<std::pair<std::string, Factors>>& known_units() {
  static const std::vector<std::pair<std::string, Factors>> units = {
      {"1", {0, 0, 0}},    {"m", {1, 0, 0}},  {"kg", {0, 1, 0}}, {"s", {0, 0, 1}},
      {"rad", {0, 0, 0}},  {"N", {1, 1, -2}}, {"J", {2, 1, -2}}, {"W", {2, 1, -3}},
      {"Pa", {-1, 1, -2}}, {"Hz", {0, 0, -1}}};
  return units;
}

// What people write instead, and what it is in SI.
const std::map<std::string, std::string, std::less<>>& refused_units() {
  static const std::map<std::string, std::string, std::less<>> hints = {
      {"deg", "rad (1 deg = 0.017453292519943295 rad)"},
      {"degree", "rad (1 deg = 0.017453292519943295 rad)"},
      {"degrees", "rad (1 deg = 0.017453292519943295 rad)"},
      {"mm", "m (1 mm = 0.001 m)"},
      {"cm", "m (1 cm = 0.01 m)"},
      {"km", "m (1 km = 1000 m)"},
      {"g", "kg (1 g = 0.001 kg)"},
      {"mg", "kg (1 mg = 0.000001 kg)"},
      {"ms", "s (1 ms = 0.001 s)"},
      {"min", "s (1 min = 60 s)"},
      {"h", "s (1 h = 3600 s)"},
      {"kN", "N (1 kN = 1000 N)"},
      {"mN", "N (1 mN = 0.001 N)"},
      {"kJ", "J (1 kJ = 1000 J)"},
      {"kW", "W (1 kW = 1000 W)"},
      {"kPa", "Pa (1 kPa = 1000 Pa)"},
      {"MPa", "Pa (1 MPa = 1000000 Pa)"},
      {"GPa", "Pa (1 GPa = 1000000000 Pa)"},
      {"rpm", "rad/s (1 rpm = 0.10471975511965977 rad/s)"},
      {"%", "1 (1 % = 0.01)"}};
  return hints;
}

class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  Unit parse() {
    const Unit unit = products();
    if (at_ < text_.size()) fail(in_quotes(text_.substr(at_)) + " cannot be read");
    return unit;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw std::invalid_argument("unit " + in_quotes(text_) + ": " + problem +
                                "; write it as in \"kg/m^2\", \"N m s/rad\" or \"1\"");
  }

  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  bool take(char wanted) {
    skip_spaces();
    if (at_ >= text_.size() || text_[at_] != wanted) return false;
    ++at_;
    return true;
  }

  Unit products() {
    Unit unit = factor();
    while (true) {
      skip_spaces();
      if (at_ >= text_.size() || text_[at_] == ')') return unit;
      if (take('/')) {
        unit = unit / factor();
      } else {
        take('*');
        unit = unit * factor();
      }
    }
  }

  Unit factor() {
    skip_spaces();
    if (take('(')) {
      if (++depth_ > kDeepestNesting) fail("parentheses are nested too deeply");
      const Unit inside = products();
      --depth_;
      if (!take(')')) fail("a parenthesis is not closed");
      return inside;
    }
    const std::size_t begin = at_;
    if (at_ < text_.size() && text_[at_] == '1') {
      ++at_;
    } else {
      while (at_ < text_.size() &&
             (std::isalpha(static_cast<unsigned char>(text_[at_])) || text_[at_] == '%')) {
        ++at_;
      }
    }
    const std::string name(text_.substr(begin, at_ - begin));
    if (name.empty()) fail("a unit is wanted at its character " + std::to_string(begin + 1));
    const Unit unit = named(name);
    return take('^') ? unit.power(exponent()) : unit;
  }

  Unit named(const std::string& name) const {
    std::vector<std::string> names;
    for (const auto& [known, factors] : known_units()) {
      if (known == name) return Unit::of(factors.m, factors.kg, factors.s);
      names.push_back(known);
    }
    if (const auto hint = refused_units().find(name); hint != refused_units().end()) {
      fail(in_quotes(name) + " is not a coherent SI unit; give the value in " + hint->second);
    }
    const auto is_known = [&](const std::string& part) {
      return std::find(names.begin(), names.end(), part) != names.end();
    };
    for (std::size_t end = 1; end < name.size(); ++end)
      if (is_known(name.substr(0, end)) && is_known(name.substr(end)))
        fail(in_quotes(name) + " is not a known unit; did you mean " +
             in_quotes(name.substr(0, end) + " " + name.substr(end)) + "?");
    fail(in_quotes(name) + " is not a known unit" + suggestion(name, names));
  }

  long whole_number() {
    skip_spaces();
    const bool negative = take('-');
    const std::size_t begin = at_;
    while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_]))) ++at_;
    if (at_ == begin || at_ - begin > 4)
      fail("an exponent is a small whole number, decimal or (p/q)");
    const long value = std::stol(std::string(text_.substr(begin, at_ - begin)));
    return negative ? -value : value;
  }

  Exponent exponent() {
    if (take('(')) {
      const long numerator = whole_number();
      const long denominator = take('/') ? whole_number() : 1;
      if (!take(')') || denominator == 0) fail("an exponent in parentheses is (p/q)");
      return reduced(numerator, denominator);
    }
    long numerator = whole_number();
    long denominator = 1;
    if (at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      const bool negative = numerator < 0;
      for (; at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_])); ++at_) {
        if (denominator > 1000) fail("an exponent has too many decimals; write (p/q)");
        numerator = 10 * numerator + (negative ? -1 : 1) * (text_[at_] - '0');
        denominator *= 10;
      }
    }
    return reduced(numerator, denominator);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;  // of parentheses
};

std::string power_text(const std::string& base, Exponent exponent) {
  if (exponent.denominator != 1) {
    return base + "^(" + std::to_string(exponent.numerator) + "/" +
           std::to_string(exponent.denominator) + ")";
  }
  return exponent.numerator == 1 ? base : base + "^" + std::to_string(exponent.numerator);
}

}  // namespace

Unit Unit::parse(std::string_view text) { return UnitParser(text).parse(); }

Unit Unit::of(int metre, int kilogram, int second) {
  Unit unit;
  unit.exponents_ = {Exponent{metre, 1}, Exponent{kilogram, 1}, Exponent{second, 1}};
  return unit;
}

Unit Unit::operator*(const Unit& other) const {
  Unit result;
  for (std::size_t i = 0; i < 3; ++i) {
    result.exponents_[i] = sum(exponents_[i], other.exponents_[i]);
  }
  return result;
}

Unit Unit::operator/(const Unit& other) const { return *this * other.power({-1, 1}); }

Unit Unit::power(Exponent exponent) const {
  Unit result;
  for (std::size_t i = 0; i < 3; ++i) result.exponents_[i] = product(exponents_[i], exponent);
  return result;
}

std::string Unit::text() const {
  // The names that mechanics uses, where one fits.
  static const std::vector<std::string> usual = {
      "1",   "m",   "kg",    "s",   "N",      "N m",  "W",     "m/s",     "m/s^2", "1/s",
      "1/m", "N/m", "N s/m", "N s", "kg m^2", "kg/m", "N m s", "N s/m^2", "N m^2", "W/m"};
  for (const std::string& name : usual) {
    if (*this == parse(name)) return name;
  }
  static const std::array<std::string, 3> base = {"m", "kg", "s"};
  std::string above, below;
  int factors_below = 0;
  for (const std::size_t i : {1, 0, 2}) {
    const Exponent exponent = exponents_[i];
    if (exponent.numerator > 0) above += (above.empty() ? "" : " ") + power_text(base[i], exponent);
    if (exponent.numerator < 0) {
      below += (below.empty() ? "" : " ") +
               power_text(base[i], {-exponent.numerator, exponent.denominator});
      ++factors_below;
    }
  }
  if (above.empty()) above = "1";
  if (below.empty()) return above;
  return above + "/" + (factors_below > 1 ? "(" + below + ")" : below);
}

}  // namespace catena
