// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/ticks.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

namespace catena::plot {
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

/// Step of 1, 2 or 5 times a power of ten that cuts `span` into about `about` pieces.
double nice_step(double span, int about) {
  const double raw = span / about;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double leading = raw / power;
  return power * (leading < 1.5 ? 1 : leading < 3.5 ? 2 : leading < 7.5 ? 5 : 10);
}

}  // namespace

std::vector<Tick> linear_ticks(double low, double high, int about) {
  if (low == high) {
    const double margin = low == 0 ? 1 : std::abs(low) / 2;
    low -= margin;
    high += margin;
  }
  const double step = nice_step(high - low, about);
  const double largest = std::max(std::abs(low), std::abs(high));
  const bool plain = largest < 1e6 && step >= 1e-5;
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  std::vector<Tick> ticks;
  const double slack = 1e-9 * step;
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k) {
    const double at = k == 0 ? 0 : k * step;
    ticks.push_back({at, plain ? with_minus_sign(fixed(at, decimals)) : for_people(at, 6)});
  }
  return ticks;
}

std::vector<Tick> logarithmic_ticks(double low, double high, int about) {
  const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
  const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
  const int stride = std::max(1, (last - first + about) / about);
  const bool sparse = last - first < 1;
  std::vector<Tick> ticks;
  for (int decade = first - 1; decade <= last; ++decade) {
    for (const int factor : {1, 2, 5}) {
      const double at = factor * std::pow(10.0, decade);
      if (at < low * (1 - 1e-9) || at > high * (1 + 1e-9)) continue;
      const bool labelled = sparse || (factor == 1 && (decade - first) % stride == 0);
      if (labelled || stride == 1) ticks.push_back({at, labelled ? for_people(at) : ""});
    }
  }
  return ticks;
}

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

std::string exact(double value) {
  if (std::isnan(value)) return "";
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
  return {text.data(), end.ptr};
}

}  // namespace catena::plot
