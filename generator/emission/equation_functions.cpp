// SPDX-License-Identifier: GPL-3.0-or-later
#include <set>

#include "generator/derivation/tridiagonal.hpp"
#include "generator/derivation/weighted_gradient.hpp"
#include "generator/emission/function_builder.hpp"

namespace catena {

using GiNaC::ex;

void FunctionBuilder::residual() {
  const auto r = chain_.residual();
  add("residual", "r(t, q, v, a, z, u, p), the inverse dynamics.",
      "void residual(const Point<T>& at, T* r)", body(from_one("r", r), at_),
      {{"void", "residual", "const catena_point* at, double* r", "residual(point(at), r)"}});
  const auto dr = each(r, [&](const ex& e) { return tangent_.of(e); });
  add("residual_tangent", "Derivative of r along `along`.",
      "void residual_tangent(const Point<T>& at, const Point<D>& along, D* dr)",
      body(from_one("dr", dr), at_and_along_),
      {{"void", "residual_tangent", "const catena_point* at, const catena_point* along, double* dr",
        "residual_tangent(point(at), point(along), dr)"},
       {"void", "residual_tangents",
        "const catena_point* at, const catena_point* along, double* dr",
        "residual_tangent(point(at), directions(along), directions(dr))"}});
}

// Each term of r from a derivation that has this term alone.
void FunctionBuilder::terms() {
  const auto add_term = [&](const std::string& name, const Definitions& definitions,
                            const std::vector<ex>& values) {
    result_.terms.push_back(name);
    add("term_" + name, "The term " + name + " of r alone.",
        "void term_" + name + "(const Point<T>& at, T* r)",
        function_body(definitions, from_one("r", values), at_, layout_), {});
  };
  for (const std::string& name : Chain::term_names(description_)) {
    Chain chain(description_, links_, name);
    if (name == "kinetic") {
      Differential along_a(chain.definitions(),
                           [](const std::string& family) { return family + "_inertial"; });
      for (const ex& a : chain.accelerations()) along_a.set(a, a);
      add_term("inertia", chain.definitions(),
               each(chain.residual(), [&](const ex& e) { return along_a.of(e); }));
      Substitution bias = without_acceleration(chain);
      add_term("coriolis", chain.definitions(),
               each(chain.residual(), [&](const ex& e) { return bias.of(e); }));
    } else {
      add_term(name, chain.definitions(), chain.residual());
    }
    if (name == "elastic")
      result_.summary.stiffness_tridiagonal = is_constant_tridiagonal(chain, chain.coordinates());
    if (name == "friction")
      result_.summary.damping_tridiagonal = is_constant_tridiagonal(chain, chain.rates());
  }
  std::string choose = "  switch (term) {\n";
  for (size_t k = 0; k < result_.terms.size(); ++k) {
    choose += "    case " + std::to_string(k) + ":\n      term_" + result_.terms[k] + "(" +
              context() + "at, r);\n      break;\n";
  }
  choose += "  }\n";
  add("residual_term", "One term of r, numbered as in the table; their sum is r.",
      "void residual_term(const Point<T>& at, int term, T* r)", {},
      {{"void", "residual_term", "const catena_point* at, int32_t term, double* r",
        "residual_term(point(at), term, r)"}},
      choose);
}

void FunctionBuilder::state_rates() {
  const auto f = chain_.state_rates();
  add("state_rate", "zdot = f(t, q, v, z, u, p), the rates of the extra states.",
      "void state_rate(const Point<T>& at, T* zdot)", body(from_one("zdot", f), at_),
      {{"void", "state_rate", "const catena_point* at, double* zdot",
        "state_rate(point(at), zdot)"}});
  const auto df = each(f, [&](const ex& e) { return tangent_.of(e); });
  add("state_rate_tangent", "Derivative of zdot along `along`.",
      "void state_rate_tangent(const Point<T>& at, const Point<D>& along, D* dzdot)",
      body(from_one("dzdot", df), at_and_along_),
      {{"void", "state_rate_tangent",
        "const catena_point* at, const catena_point* along, double* dzdot",
        "state_rate_tangent(point(at), point(along), dzdot)"},
       {"void", "state_rate_tangents",
        "const catena_point* at, const catena_point* along, double* dzdot",
        "state_rate_tangent(point(at), directions(along), directions(dzdot))"}});
}

// The gradient of weight . r + rate_weight . zdot.
void FunctionBuilder::adjoint() {
  WeightedGradient gradient(definitions_, "adjoint_");
  const auto add_all = [&](const std::vector<ex>& values, const std::string& weight) {
    for (size_t i = 0; i < values.size(); ++i) {
      const int link = static_cast<int>(i) + 1;
      gradient.add(values[i], definitions_.input(weight, link), link);
    }
  };
  add_all(chain_.residual(), "weight");
  add_all(chain_.state_rates(), "rate_weight");
  gradient.accumulate();
  std::vector<Output> outputs;
  for (const InputPlace& place : input_places(description_, links_)) {
    if (std::string("qvzp").find(place.member) == std::string::npos) continue;
    const Array array{"", std::string("d") + place.member, {}};
    for (int i = 1; i <= place.count; ++i) {
      const ex symbol = definitions_.input(place.family, place.indexed ? i : kNoIndex);
      if (place.indexed) {
        outputs.push_back({array, i, ArrayPlace{place.offset, true, -1}, gradient.of(symbol)});
      } else {
        outputs.push_back(
            {array, kNoIndex, ArrayPlace{{}, false, place.offset}, gradient.of(symbol)});
      }
    }
  }
  Inputs inputs = at_;
  for (const std::string weight : {"weight", "rate_weight"})
    inputs[weight] = Input{InputKind::kArray, Type::kScalar, weight, {"", weight + "s", {}}, {}};
  add("residual_adjoint",
      "Gradient of weights . r + rate_weights . zdot with respect to q, v, z and p.",
      "void residual_adjoint(const Point<T>& at, const T* weights,\n"
      "                      [[maybe_unused]] const T* rate_weights, T* dq, T* dv,\n"
      "                      [[maybe_unused]] T* dz, T* dp)",
      body(outputs, inputs),
      {{"void", "residual_adjoint",
        "const catena_point* at, const double* weights, const double* rate_weights, double* dq, "
        "double* dv, double* dz, double* dp",
        "residual_adjoint(point(at), weights, rate_weights, dq, dv, dz, dp)"}});
}

// Symbols the equations depend on.
std::vector<int> FunctionBuilder::all_symbols() {
  std::set<int> seen;
  std::vector<int> open;
  const auto visit = [&](const ex& e) {
    for (const int number : definitions_.symbols_of(e)) {
      if (seen.insert(number).second) open.push_back(number);
    }
  };
  for (const ex& e : chain_.residual()) visit(e);
  for (const ex& e : chain_.state_rates()) visit(e);
  while (!open.empty()) {
    const int number = open.back();
    open.pop_back();
    visit(definitions_[number].value);
  }
  return {seen.begin(), seen.end()};
}

}  // namespace catena
