// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/readable.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace catena::report {
namespace {

constexpr std::string_view kMinus = "\u2212";

std::string fixed(double value, int decimals) {
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::fixed, decimals);
  return {text.data(), end.ptr};
}

std::string with_minus_sign(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, kMinus);
  return text;
}

std::string superscript(int exponent) {
  constexpr std::array<std::string_view, 10> kDigits = {"⁰", "¹", "²", "³", "⁴",
                                                        "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) {
    text += kDigits[static_cast<std::size_t>(digit - '0')];
  }
  return text;
}

std::string without_trailing_zeros(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace

std::string for_people(double value, int digits) {
  if (std::isnan(value)) return "–";
  if (std::isinf(value)) return value > 0 ? "∞" : std::string(kMinus) + "∞";
  if (value == 0) return "0";
  // The exponent after rounding: 9.99996 shown with four digits is 10.
  std::array<char, 64> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::scientific, digits - 1);
  const std::string scientific(text.data(), end.ptr);
  const std::size_t mark = scientific.find('e');
  const int exponent = std::stoi(scientific.substr(mark + 1));
  if (exponent >= -4 && exponent < 6) {
    return with_minus_sign(
        without_trailing_zeros(fixed(value, std::max(0, digits - 1 - exponent))));
  }
  const std::string mantissa = without_trailing_zeros(scientific.substr(0, mark));
  const std::string power = "10" + superscript(exponent);
  if (mantissa == "1") return power;
  if (mantissa == "-1") return std::string(kMinus) + power;
  return with_minus_sign(mantissa + "×" + power);
}

std::string readable_unit(std::string unit) {
  for (const auto& [plain, raised] :
       {std::pair("^2", "²"), std::pair("^3", "³"), std::pair("^4", "⁴")}) {
    for (auto at = unit.find(plain); at != std::string::npos; at = unit.find(plain)) {
      unit.replace(at, 2, raised);
    }
  }
  return unit;
}

}  // namespace catena::report
