// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/names.hpp"

namespace catena::checking {

using GiNaC::ex;

const Target* target_named(const std::string& name) {
  for (const Target& target : kTargets)
    if (target.name == name) return &target;
  return nullptr;
}

const std::map<std::string, Family>& families() {
  static const std::map<std::string, Family> table = {
      {"theta", &ChainSymbols::angle},
      {"thetadot", &ChainSymbols::rate},
      {"thetaddot", &ChainSymbols::acceleration},
      {"phi", &ChainSymbols::azimuth},
      {"phidot", &ChainSymbols::azimuth_rate},
      {"phiddot", &ChainSymbols::azimuth_acceleration},
      {"l", &ChainSymbols::length},
      {"m", &ChainSymbols::mass},
      {"I", &ChainSymbols::inertia},
      {"k", &ChainSymbols::stiffness},
      {"c", &ChainSymbols::damping},
      {"T", &ChainSymbols::torque}};
  return table;
}

bool is_family(const std::string& name, const ChainSymbols& chain) {
  const auto found = families().find(name);
  return found != families().end() && !(chain.*(found->second)).empty();
}

const std::map<std::string, Function>& functions() {
  static const std::map<std::string, Function> table = {
      {"sin", [](const ex& x) -> ex { return GiNaC::sin(x); }},
      {"sen", [](const ex& x) -> ex { return GiNaC::sin(x); }},  // as the dissertation writes it
      {"cos", [](const ex& x) -> ex { return GiNaC::cos(x); }},
      {"tan", [](const ex& x) -> ex { return GiNaC::tan(x); }},
      {"asin", [](const ex& x) -> ex { return GiNaC::asin(x); }},
      {"acos", [](const ex& x) -> ex { return GiNaC::acos(x); }},
      {"atan", [](const ex& x) -> ex { return GiNaC::atan(x); }},
      {"sinh", [](const ex& x) -> ex { return GiNaC::sinh(x); }},
      {"cosh", [](const ex& x) -> ex { return GiNaC::cosh(x); }},
      {"tanh", [](const ex& x) -> ex { return GiNaC::tanh(x); }},
      {"asinh", [](const ex& x) -> ex { return GiNaC::asinh(x); }},
      {"exp", [](const ex& x) -> ex { return GiNaC::exp(x); }},
      {"log", [](const ex& x) -> ex { return GiNaC::log(x); }},
      {"ln", [](const ex& x) -> ex { return GiNaC::log(x); }},
      {"sqrt", [](const ex& x) -> ex { return GiNaC::sqrt(x); }},
      {"abs", [](const ex& x) -> ex { return GiNaC::abs(x); }},
      {"sign", [](const ex& x) -> ex { return GiNaC::csgn(x); }}};
  return table;
}

std::string Reference::text() const {
  if (indices.empty()) return name;
  std::string result = name + "[";
  for (std::size_t i = 0; i < indices.size(); ++i)
    result += (i == 0 ? "" : ",") + std::to_string(indices[i]);
  return result + "]";
}

std::string name_of(Quantity quantity) {
  for (const Target& target : kTargets)
    if (target.quantity == quantity) return std::string(target.name);
  return quantity == Quantity::kEquation ? "equation" : "identity";
}

}  // namespace catena::checking
