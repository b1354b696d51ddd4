// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/comparison.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "generator/checking/attribution.hpp"
#include "generator/checking/budget.hpp"
#include "generator/checking/chain_motion.hpp"
#include "generator/checking/combination.hpp"
#include "generator/checking/exact_form.hpp"
#include "generator/checking/expression_text.hpp"
#include "generator/checking/flat_derivation.hpp"
#include "generator/checking/motion_comparison.hpp"
#include "generator/checking/normal_form.hpp"
#include "generator/checking/numeric_state.hpp"
#include "generator/checking/shared_tree.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

// Most links for which equations that are not proved are compared with the motion.
constexpr int kMostCompared = 12;

// Proofs of more products than this, a few seconds, are replaced by evaluation.
constexpr double kMostExpanded = 5.5e5;

// The difference of an equation of more products than this is not written out.
constexpr double kMostWritten = 2e4;

constexpr const char* kTooLongToWrite = "the difference is too long to be written out";

// A factor of an equation longer than this is not written out in a remark.
constexpr std::size_t kShortFactor = 40;

// A difference of more parts than this is shown by its shortest part as well.
constexpr std::size_t kShortDifference = 3;

bool is_sum(const std::string& text) {
  int depth = 0;
  for (const char c : text) {
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c == ' ' && depth == 0) return true;
  }
  return false;
}

/// "1, 2 and 4"
template <class Factors>
std::string listed(const Factors& by_number) {
  std::string result;
  for (auto entry = by_number.begin(); entry != by_number.end(); ++entry)
    result += (entry == by_number.begin()            ? ""
               : std::next(entry) == by_number.end() ? " and "
                                                     : ", ") +
              std::to_string(entry->first);
  return result;
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
    if (derivation.chain)
      model_ = std::make_unique<FlatDerivation>(
          *derivation.chain, parts_of_effects(derivation.effects, *derivation.chain));
  }

  Finding of(const Entry& entry) {
    Finding finding;
    try {
      const Budget budget;
      return entry.quantity == Quantity::kEquation ? of_equation(entry)
                                                   : of_sides(sides_of(entry), entry.quantity);
    } catch (const Overlong& error) {
      finding.remark = error.what();
    } catch (const std::domain_error& error) {
      finding.verdict = Verdict::kDifferent;
      finding.remark = error.what();
      return finding;
    }
    try {
      return by_evaluation(entry);
    } catch (const std::exception&) {  // too long for evaluation too, or beyond GiNaC's numbers
      finding.remark = "not decided: " + finding.remark;
      return finding;
    }
  }

 private:
  ex given(const ex& expression) const {
    return derivation_.given.empty() ? expression : Replacement(derivation_.given)(expression);
  }

  Sides sides_of(const Entry& entry) const {
    if (entry.quantity == Quantity::kIdentity) return {given(entry.value), given(entry.right), {}};
    Contributions parts = model_parts(entry);
    for (Contribution& part : parts) part.value = given(part.value);
    const ex model = total(parts);
    return {given(entry.value), model, std::move(parts)};
  }

  /// For what is too long for algebra.
  Finding by_evaluation(const Entry& entry) {
    if (entry.quantity == Quantity::kEquation) {
      const Budget budget;
      const ex hand = given(entry.value - entry.right);
      return by_motion(hand, solved_for(hand), cleared(hand).denominator).value();
    }
    const Sides sides = sides_of(entry);
    Finding finding;
    std::optional<bool> equal;
    try {
      const Budget budget;
      equal = vanishes(sides.hand - sides.model, seed_);
    } catch (const Overlong&) {  // the values at some states may still differ
    }
    if (equal && *equal) {
      finding.verdict = Verdict::kEqual;
      finding.by_evaluation = true;
    } else {
      const Budget budget;
      numeric_evidence(sides, equal.has_value(), finding);
      finding.remark = finding.verdict == Verdict::kDifferent
                           ? kTooLongToWrite
                           : "too long for algebra, and no state tried shows a difference";
    }
    return finding;
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
    try {
      describe(sides, difference, form, finding);
    } catch (const Overlong&) {
      if (finding.remark.empty()) finding.remark = kTooLongToWrite;
    }
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

  /// An equation of motion may be stated with a factor, as a sum of several with factors, or solved
  /// for an acceleration. It is compared with that combination of the chain's equations.
  Finding of_equation(const Entry& entry) {
    const ex hand = given(entry.value - entry.right);
    if (says_nothing(hand)) {
      Finding finding;
      finding.verdict = Verdict::kDifferent;
      finding.remark = "it states nothing: both sides are the same for every motion";
      return finding;
    }
    const int solved = solved_for(hand);
    const Quotient fraction = cleared(hand);
    const std::vector<Combination> candidates = candidates_for(hand, entry.row);
    std::optional<Combination> proved = proved_of(candidates, hand);
    if (!proved && fraction.denominator != 1) {
      proved = proved_of(candidates_for(fraction.numerator, entry.row), fraction.numerator);
      if (proved) proved->divisor *= fraction.denominator;
    }
    if (proved) {
      Finding finding;
      finding.verdict = Verdict::kEqual;
      finding.remark = name_of(*proved, entry.row, solved);
      finding.combination = numbers_in(*proved);
      return finding;
    }
    if (std::optional<Finding> finding = by_motion(hand, solved, fraction.denominator))
      return *finding;
    // The combination with the shortest difference is taken as the intended one.
    std::optional<Finding> best;
    for (const Combination& candidate : candidates) {
      if (!has_constant_factors(candidate)) continue;
      Finding finding =
          of_sides({candidate.divisor * hand, total(parts_of(candidate)), parts_of(candidate)},
                   entry.quantity);
      const std::string name = name_of(candidate, entry.row, 0);
      if (!name.empty()) finding.remark = "compared with the chain's, " + name;
      if (!best || finding.terms < best->terms) best = std::move(finding);
    }
    return *best;
  }

  bool says_nothing(const ex& hand) const {
    if (differs_somewhere(hand)) return false;
    return is_too_long(hand) ? vanishes(hand, seed_).value_or(false)
                             : NormalForm({hand})(hand).numerator.is_zero();
  }

  /// The first candidate that is proved to be the equation h = 0.
  std::optional<Combination> proved_of(const std::vector<Combination>& candidates,
                                       const ex& h) const {
    for (const Combination& candidate : candidates) {
      const ex excess = candidate.divisor * h - total(parts_of(candidate));
      if (differs_somewhere(excess) || is_too_long(excess)) continue;
      NormalForm form({excess});
      if (form(excess).numerator.is_zero()) return candidate;
    }
    return std::nullopt;
  }

  std::vector<Combination> candidates_for(const ex& hand, int row) const {
    if (is_too_long(hand)) return {};
    std::vector<Combination> result;
    for (const ex& factor : factors_between(hand, row)) result.push_back({{{row, factor}}, 1});
    for (const Combination& combination : possible_combinations(hand, *derivation_.chain, *model_))
      result.push_back(combination);
    return result;
  }

  bool is_too_long(const ex& expression) const { return expanded_size(expression) > kMostExpanded; }

  /// The k for which h = 0 reads thetaddot_k = ... with no other acceleration; 0 if there is none,
  /// or none other.
  int solved_for(const ex& hand) const {
    if (derivation_.chain->coordinates() == 1) return 0;
    const std::optional<ChainMotion::Vector> factors =
        acceleration_factors(hand, *derivation_.chain, common_state().values);
    int result = 0;
    for (std::size_t j = 0; factors && j < factors->size(); ++j) {
      const numeric size = GiNaC::abs((*factors)[j]);
      if (size <= closeness()) continue;
      if (result != 0 || GiNaC::abs(size - 1) > closeness()) return 0;
      result = static_cast<int>(j) + 1;
    }
    return result;
  }

  /// The chain's equations with these factors, part by part.
  Contributions parts_of(const Combination& combination) const {
    Contributions result;
    for (const auto& [number, factor] : combination.factors) {
      for (Contribution part : model_->equation(number)) {
        part.value = given(factor * part.value);
        result.push_back(std::move(part));
      }
    }
    return result;
  }

  bool has_constant_factors(const Combination& combination) const {
    return combination.divisor == 1 &&
           std::all_of(
               combination.factors.begin(), combination.factors.end(),
               [&](const auto& entry) { return derivation_.chain->is_constant(entry.second); });
  }

  /// Avoids proofs that must fail.
  bool differs_somewhere(const ex& excess) const {
    for (std::uint64_t attempt = 0; attempt < kStates; ++attempt) {
      const std::optional<numeric> value =
          evaluate_at(excess, random_state(symbols_in({excess}), seed_ + attempt));
      // The terms are near 1 in size, but for determinants of M.
      if (value) return GiNaC::abs(*value) > closeness();
    }
    return false;
  }

  /// "equation 1 + 2*(equation 2)"; empty for equation `row` itself.
  std::string name_of(const Combination& combination, int row, int solved) const {
    if (solved != 0) return "solved for thetaddot_" + std::to_string(solved);
    std::vector<std::string> parts;
    bool is_short = combination.divisor == 1;
    for (const auto& [number, factor] : combination.factors) {
      const std::string equation = "equation " + std::to_string(number);
      NormalForm form({factor});
      const std::string text = text_of(form(factor), form);
      is_short = is_short && text.size() < kShortFactor;
      parts.push_back(text == "1" ? equation
                      : text == "-1"
                          ? "-" + equation
                          : (is_sum(text) ? "(" + text + ")" : text) + "*(" + equation + ")");
      if (combination.factors.size() == 1 && number == row && is_short)
        return text == "1" ? "" : "multiplied by " + text;
    }
    if (parts.size() == 1 && !is_short)
      return combination.factors.begin()->first == row
                 ? "multiplied by a factor"
                 : "equation " + listed(combination.factors) + " times a factor";
    if (is_short) return (parts.size() == 1 ? "it is " : "the sum ") + joined_by_signs(parts);
    return "a combination of equations " + listed(combination.factors);
  }

  /// Factors of the combination at a state, to tell independent ones from others.
  std::map<int, numeric> numbers_in(const Combination& combination) const {
    std::map<int, numeric> result;
    const NumericState state = common_state();
    const std::optional<numeric> divisor = evaluate_at(given(combination.divisor), state);
    for (const auto& [number, factor] : combination.factors) {
      const std::optional<numeric> value = evaluate_at(given(factor), state);
      if (value && divisor && !divisor->is_zero()) result[number] = *value / *divisor;
    }
    return result;
  }

  NumericState common_state() const {
    const ChainSymbols& chain = *derivation_.chain;
    std::vector<ex> all{chain.load_mass, chain.gravity};
    for (const auto* family :
         {&chain.angle, &chain.rate, &chain.acceleration, &chain.length, &chain.mass,
          &chain.inertia, &chain.stiffness, &chain.damping, &chain.torque})
      all.insert(all.end(), family->begin() + 1, family->end());
    for (const auto& [name, symbols] : chain.effects)
      all.insert(all.end(), symbols.begin(), symbols.end());
    return random_state(symbols_in(all), seed_);
  }

  /// Compares an equation that is not proved with the chain's motion. Returns nothing for equations
  /// that do not hold and whose difference is short enough to be written out.
  std::optional<Finding> by_motion(const ex& hand, int solved, const ex& denominator) {
    const ChainSymbols& chain = *derivation_.chain;
    const bool must_be_judged =
        solved != 0 || expanded_size(hand) > kMostWritten || !chain.is_constant(denominator);
    Finding finding;
    if (chain.links > kMostCompared) {
      if (!must_be_judged) return std::nullopt;
      finding.remark =
          "solved equations and those too long to be expanded are compared with the motion of up "
          "to " +
          std::to_string(kMostCompared) + " links";
      return finding;
    }
    const NumericState state = common_state();
    const std::optional<ChainMotion::Vector> slope =
        acceleration_factors(hand, chain, state.values);
    const std::optional<bool> obeyed = slope ? motion().is_obeyed(hand) : std::nullopt;
    if (obeyed && *obeyed) {
      finding.verdict = Verdict::kEqual;
      finding.by_evaluation = true;
      finding.combination = motion().factors(*slope, state.values);
      finding.remark = solved != 0 ? "solved for thetaddot_" + std::to_string(solved)
                                   : "a combination of equations " + listed(finding.combination);
      return finding;
    }
    if (!must_be_judged) return std::nullopt;
    finding.verdict = obeyed ? Verdict::kDifferent : Verdict::kUndecided;
    if (solved == 0) {
      finding.remark = "left - right at the chain's accelerations, which should be 0";
      compare_with_motion(hand, 0, motion(), chain, seed_, finding);
    } else {
      finding.remark =
          "compared with the chain's equations solved for thetaddot_" + std::to_string(solved);
      const auto k = static_cast<std::size_t>(solved);
      compare_with_motion(chain.acceleration[k] - hand / (*slope)[k - 1], solved, motion(), chain,
                          seed_, finding);
    }
    return finding;
  }

  ChainMotion& motion() {
    if (!motion_) {
      std::vector<ex> equations;
      for (const Entry& entry : derivation_.entries)
        if (entry.quantity == Quantity::kEquation)
          equations.push_back(given(entry.value - entry.right));
      motion_ = std::make_unique<ChainMotion>(*derivation_.chain, *model_, derivation_.given,
                                              equations, seed_);
    }
    return *motion_;
  }

  /// Constants c with dh = c dr for the torque and the acceleration of the row, and 1, -1.
  std::vector<ex> factors_between(const ex& hand, int row) const {
    const ChainSymbols& chain = *derivation_.chain;
    const ex model = total(model_->equation(row));
    std::vector<ex> result{1, -1};
    const auto index = static_cast<std::size_t>(row);
    for (const ex& symbol : {chain.torque[index], chain.acceleration[index]}) {
      const ex below = given(model.diff(GiNaC::ex_to<GiNaC::symbol>(symbol)));
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
    if (static_cast<double>(shown.numerator.nops()) > kMostWritten) throw Overlong("a difference");
    if (shown.denominator != 1) {  // cancel what the two have in common
      spend_for_division(shown);
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
  std::unique_ptr<ChainMotion> motion_;  // for the equations that need it
};

}  // namespace

std::vector<Finding> compare(const Derivation& derivation, std::uint64_t seed) {
  Comparison comparison(derivation, seed);
  std::vector<Finding> result;
  for (const Entry& entry : derivation.entries) result.push_back(comparison.of(entry));
  return result;
}

int independent_equations(const std::vector<Finding>& findings, int coordinates) {
  std::vector<std::vector<numeric>> rows;  // in echelon form, each with its pivot
  std::vector<std::size_t> pivots;
  for (const Finding& finding : findings) {
    if (finding.combination.empty()) continue;
    std::vector<numeric> row(static_cast<std::size_t>(coordinates) + 1);
    for (const auto& [number, factor] : finding.combination)
      row[static_cast<std::size_t>(number)] = factor;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const numeric factor = row[pivots[r]] / rows[r][pivots[r]];
      for (std::size_t j = 0; j < row.size(); ++j) row[j] = row[j] - factor * rows[r][j];
    }
    const auto largest = std::max_element(
        row.begin(), row.end(),
        [](const numeric& a, const numeric& b) { return GiNaC::abs(a) < GiNaC::abs(b); });
    if (GiNaC::abs(*largest) <= closeness()) continue;
    pivots.push_back(static_cast<std::size_t>(largest - row.begin()));
    rows.push_back(row);
  }
  return static_cast<int>(rows.size());
}

}  // namespace catena::checking
