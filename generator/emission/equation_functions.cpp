// SPDX-License-Identifier: GPL-3.0-or-later

#include "generator/derivation/tridiagonal.hpp"
#include "generator/derivation/weighted_gradient.hpp"
#include "generator/emission/function_builder.hpp"

namespace catena {

using GiNaC::ex;

void FunctionBuilder::residual() {
  const auto r = chain_.residual();
  add("residual", "r(t, q, v, a, z, u, p), the inverse dynamics.", {at(), result("r")},
      body(from_coordinates("r", r), at_));
  const auto dr = each(r, [&](const ex& e) { return tangent_.of(e); });
  add("residual_tangent", "Derivative of r along `along`.", {at(), along(), change("dr")},
      body(from_coordinates("dr", dr), at_and_along_));
}

// Each term of r from a derivation that has this term alone.
void FunctionBuilder::terms() {
  const auto add_term = [&](const std::string& name, const Definitions& definitions,
                            const std::vector<ex>& values) {
    result_.terms.push_back(name);
    add_inner("term_" + name, "The term " + name + " of r alone.", {at(), result("r")},
              function_body(definitions, from_coordinates("r", values), at_, layout_));
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
  add("residual_term", "One term of r, numbered as in the table; their sum is r.",
      {at(), {ParameterKind::kTerm, "term"}, result("r")}, {}, Frame::kChooseTerm);
}

void FunctionBuilder::state_rates() {
  const auto f = chain_.state_rates();
  add("state_rate", "zdot = f(t, q, v, z, u, p), the rates of the extra states.",
      {at(), result("zdot")}, body(from_one("zdot", f), at_));
  const auto df = each(f, [&](const ex& e) { return tangent_.of(e); });
  add("state_rate_tangent", "Derivative of zdot along `along`.", {at(), along(), change("dzdot")},
      body(from_one("dzdot", df), at_and_along_));
}

// The gradient of weight . r + rate_weight . zdot.
void FunctionBuilder::adjoint() {
  WeightedGradient gradient(definitions_, "adjoint_");
  Inputs inputs = at_;
  // A family of weights for each family of coordinates or states.
  const auto add_all = [&](const std::vector<ex>& values, const std::string& weight,
                           int border = 0) {
    const int of_links = static_cast<int>(values.size()) - border;
    for (int i = of_links; i < static_cast<int>(values.size()); ++i) {
      const std::string name = weight + "_beyond_links_" + std::to_string(i - of_links + 1);
      gradient.add(values[static_cast<size_t>(i)], definitions_.input(name), kNoIndex);
      inputs[name] = Input{InputKind::kEntry, Type::kScalar, name, {"", weight + "s", {}}, i};
    }
    for (int i = 0; i < of_links; ++i) {
      const int link = i % links_ + 1;
      const long family = i / links_;
      const std::string name = weight + (family == 0 ? "" : "_" + std::to_string(family + 1));
      gradient.add(values[static_cast<size_t>(i)], definitions_.input(name, link), link);
      inputs[name] =
          Input{InputKind::kArray, Type::kScalar, name, {"", weight + "s", {}}, family * links_};
    }
  };
  add_all(chain_.residual(), "weight", chain_.border());
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
  add("residual_adjoint",
      "Gradient of weights . r + rate_weights . zdot with respect to q, v, z and p.",
      {at(), numbers("weights"), maybe_unused(numbers("rate_weights")), result("dq"), result("dv"),
       maybe_unused(result("dz")), result("dp")},
      body(outputs, inputs));
}

}  // namespace catena
