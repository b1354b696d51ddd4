// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/comparison.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "generator/checking/attribution.hpp"
#include "generator/checking/expression_text.hpp"
#include "generator/checking/flat_derivation.hpp"
#include "generator/checking/normal_form.hpp"
#include "generator/checking/numeric_state.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

// States tried before two sides that are not proved different count as numerically equal.
constexpr int kStates = 24;

// kStateDigits less what cancellation may eat: two sides closer than this are equal at a state.
const numeric& closeness() {
  static const numeric value = GiNaC::pow(numeric(10), numeric(-40));
  return value;
}

// A difference of more parts than this is shown by its shortest part as well.
constexpr std::size_t kShortDifference = 3;

std::string twelve_digits(const numeric& value) {
  std::ostringstream text;
  text.precision(12);
  text << value.to_double();
  return text.str();
}

/// The two sides of a comparison.
struct Sides {
  ex hand;
  ex model;
  Contributions parts;  ///< of the model's side, where it has parts
};

class Comparison {
 public:
  Comparison(const Derivation& derivation, std::uint64_t seed)
      : derivation_(derivation), seed_(seed) {
    if (derivation.chain) model_ = std::make_unique<FlatDerivation>(*derivation.chain);
  }

  Finding of(const Entry& entry) const {
    try {
      if (entry.quantity == Quantity::kEquation) return of_equation(entry);
      if (entry.quantity == Quantity::kIdentity)
        return of_sides({given(entry.value), given(entry.right), {}}, entry.quantity);
      Contributions parts = model_parts(entry);
      for (Contribution& part : parts) part.value = given(part.value);
      const ex model = total(parts);
      return of_sides({given(entry.value), model, std::move(parts)}, entry.quantity);
    } catch (const std::domain_error& error) {
      Finding finding;
      finding.verdict = Verdict::kDifferent;
      finding.remark = error.what();
      return finding;
    }
  }

 private:
  ex given(const ex& expression) const {
    return derivation_.given.empty()
               ? expression
               : expression.subs(derivation_.given, GiNaC::subs_options::no_pattern);
  }

  Contributions model_parts(const Entry& entry) const {
    switch (entry.quantity) {
      case Quantity::kLagrangian:
        return model_->lagrangian();
      case Quantity::kKinetic:
        return model_->kinetic();
      case Quantity::kPotential:
        return model_->potential();
      case Quantity::kDissipation:
        return model_->dissipation();
      case Quantity::kMass:
        return model_->mass(entry.row, entry.column);
      case Quantity::kDamping:
        return model_->damping(entry.row, entry.column);
      case Quantity::kStiffness:
        return model_->stiffness(entry.row, entry.column);
      case Quantity::kCoriolis:
        return model_->coriolis(entry.row);
      case Quantity::kGravity:
        return model_->gravity(entry.row);
      case Quantity::kEquation:
        return model_->equation(entry.row);
      case Quantity::kIdentity:
        break;
    }
    return {};
  }

  Finding of_sides(const Sides& sides, Quantity quantity) const {
    NormalForm form({sides.hand, sides.model});
    const Fraction difference = form(sides.hand - sides.model);
    Finding finding;
    if (difference.numerator.is_zero()) {
      finding.verdict = Verdict::kEqual;
      return finding;
    }
    if (equivalent_energy(sides, difference, form, quantity, finding)) return finding;
    numeric_evidence(sides, form.decides(), finding);
    describe(sides, difference, form, finding);
    return finding;
  }

  /// Energies that give the same equations of motion: up to a constant, and for L up to the total
  /// time derivative of a function of the angles.
  bool equivalent_energy(const Sides& sides, const Fraction& difference, const NormalForm& form,
                         Quantity quantity, Finding& finding) const {
    if (quantity != Quantity::kLagrangian && quantity != Quantity::kPotential) return false;
    if (is_constant(difference, form)) {
      finding.verdict = Verdict::kEqual;
      finding.remark =
          "up to the constant " + text_of(difference, form) + ", which no equation of motion sees";
      return true;
    }
    if (quantity != Quantity::kLagrangian || !same_equations(sides.hand - sides.model))
      return false;
    finding.verdict = Verdict::kEqual;
    finding.remark = "up to the time derivative " + text_of(difference, form) +
                     ", which no equation of motion sees";
    return true;
  }

  bool is_constant(const Fraction& fraction, const NormalForm& form) const {
    for (const ex& symbol : symbols_in({fraction.numerator, fraction.denominator})) {
      const NormalForm::Generator generator = form.generator(symbol);
      if (generator.role == NormalForm::Role::kOther) return false;
      const ex& seen = generator.role == NormalForm::Role::kPlain ? symbol : generator.base;
      if (!derivation_.chain->is_constant(seen)) return false;
    }
    return true;
  }

  bool same_equations(const ex& excess) const {
    const ChainSymbols& chain = *derivation_.chain;
    try {
      for (std::size_t i = 1; i < chain.angle.size(); ++i) {
        const ex equation =
            chain.time_derivative(excess.diff(GiNaC::ex_to<GiNaC::symbol>(chain.rate[i]))) -
            excess.diff(GiNaC::ex_to<GiNaC::symbol>(chain.angle[i]));
        NormalForm form({equation});
        if (!form(equation).numerator.is_zero()) return false;
      }
    } catch (const std::invalid_argument&) {  // accelerations in a Lagrangian
      return false;
    }
    return true;
  }

  /// An equation of motion may be stated with any constant factor.
  Finding of_equation(const Entry& entry) const {
    Contributions parts = model_->equation(entry.row);
    for (Contribution& part : parts) part.value = given(part.value);
    const ex hand = given(entry.value - entry.right);
    const ex model = total(parts);
    for (const ex& factor : factors_between(hand, model, entry.row)) {
      NormalForm form({hand, factor * model});
      if (!form(hand - factor * model).numerator.is_zero()) continue;
      Finding finding;
      finding.verdict = Verdict::kEqual;
      if (factor != 1) {
        NormalForm of_factor({factor});
        finding.remark = "multiplied by " + text_of(of_factor(factor), of_factor);
      }
      return finding;
    }
    // Whichever sign leaves less is how it was meant.
    const Finding plain = of_sides({hand, model, parts}, entry.quantity);
    Contributions negated = parts;
    for (Contribution& part : negated) part.value = -part.value;
    Finding opposite = of_sides({hand, -model, std::move(negated)}, entry.quantity);
    if (plain.terms <= opposite.terms) return plain;
    opposite.remark = "compared with the model's equation multiplied by -1";
    return opposite;
  }

  std::vector<ex> factors_between(const ex& hand, const ex& model, int row) const {
    const ChainSymbols& chain = *derivation_.chain;
    std::vector<ex> result{1, -1};
    const auto index = static_cast<std::size_t>(row);
    for (const ex& symbol : {chain.torque[index], chain.acceleration[index]}) {
      const ex below = model.diff(GiNaC::ex_to<GiNaC::symbol>(symbol));
      const ex above = hand.diff(GiNaC::ex_to<GiNaC::symbol>(symbol));
      NormalForm form({above, below});
      const Fraction over = form(above), under = form(below);
      if (over.numerator.is_zero() || under.numerator.is_zero()) continue;
      const ex factor =
          ((over.numerator * under.denominator) / (over.denominator * under.numerator)).normal();
      if (is_constant({factor, 1}, form)) result.push_back(factor);
    }
    return result;
  }

  void numeric_evidence(const Sides& sides, bool decided, Finding& finding) const {
    finding.verdict = decided ? Verdict::kDifferent : Verdict::kUndecided;
    const std::vector<ex> symbols = symbols_in({sides.hand, sides.model});
    int real = 0;
    for (int attempt = 0; attempt < kStates; ++attempt) {
      const NumericState state = random_state(symbols, seed_ + static_cast<std::uint64_t>(attempt));
      const std::optional<numeric> hand = evaluate_at(sides.hand, state);
      const std::optional<numeric> model = evaluate_at(sides.model, state);
      if (!hand || !model) continue;
      ++real;
      const bool differs =
          GiNaC::abs(*hand - *model) > closeness() * (1 + GiNaC::abs(*hand) + GiNaC::abs(*model));
      if (differs || finding.state.empty()) {
        finding.state = state.assignments;
        finding.value = twelve_digits(*hand);
        finding.expected = twelve_digits(*model);
      }
      if (!differs) continue;
      finding.verdict = Verdict::kDifferent;
      return;
    }
    if (decided) return;
    finding.remark =
        real == 0
            ? "not rational in parameters, angles, rates, their sines and cosines, and no "
              "state tried gave real numbers"
            : "not rational in parameters, angles, rates, their sines and cosines; both sides "
              "agree to 40 digits at " +
                  std::to_string(real) + " random states";
  }

  void describe(const Sides& sides, const Fraction& difference, NormalForm& form,
                Finding& finding) const {
    Fraction shown = difference;
    if (shown.denominator != 1) {  // cancel what the two have in common
      const ex both = (shown.numerator / shown.denominator).numer_denom();
      shown = {both.op(0).expand(), both.op(1).expand()};
    }
    std::vector<std::string> parts = readable_parts(shown.numerator, form);
    finding.terms = parts.size();
    finding.difference = text_of(shown, form);
    if (parts.size() > kShortDifference)
      finding.simplest = *std::min_element(
          parts.begin(), parts.end(),
          [](const std::string& a, const std::string& b) { return a.size() < b.size(); });
    if (sides.parts.empty() || finding.verdict != Verdict::kDifferent) return;
    finding.origins = origins_of(shown, sides.parts, *derivation_.chain, form);
  }

  const Derivation& derivation_;
  std::uint64_t seed_;
  std::unique_ptr<FlatDerivation> model_;
};

}  // namespace

std::vector<Finding> compare(const Derivation& derivation, std::uint64_t seed) {
  const Comparison comparison(derivation, seed);
  std::vector<Finding> result;
  for (const Entry& entry : derivation.entries) result.push_back(comparison.of(entry));
  return result;
}

}  // namespace catena::checking
