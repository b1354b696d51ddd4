// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/candidate_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "description/expression_syntax.hpp"
#include "identify/forces/place_kinematics.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

/// m/s, rad/s: |v| is sqrt(v^2 + floor^2) in effects, which has derivatives at rest.
constexpr double kSpeedFloor = 1e-6;
/// Amplitudes are at most so many times the one found, others so many deviations from the value
/// found; a positive shape changes at most by so much. A fit that goes there has lost its way.
constexpr double kBound = 1000, kMostShapeChange = 20;
/// A step of a number, over its size; the least shape that is no edge, in half widths.
constexpr double kNumberStep = 0.02, kLeastShape = 0.01;
constexpr const char* kEdge = "edge";
/// Width of a step or an edge of an effect, over that with which the law was found. With the whole one dry friction in
/// joints was wrong by 5 % and left 1.4 noises in held-out frames.
constexpr double kSharpWidth = 0.05;
/// Fixed points of a distance: in the plane in so many directions from the middle of what the place visits,
/// so far beyond that, over the length of the cable.
constexpr int kDirections = 8;
constexpr double kBeyond[] = {0.03, 0.06, 0.12, 0.25};
/// Knots of a curve against a velocity, over its root mean square, below such a part of the largest velocity, which is
/// the last knot. Most of the time is spent below two root mean squares; a snap of the cable goes far beyond. A corner
/// between two knots is off by 6 % of the root mean square times its change of slope, at most.
constexpr double kVelocityKnots[] = {0.5, 1, 1.5, 2}, kLastInnerKnot = 0.85;
/// Knots of a curve against the distance of two places or a tension, over the visited range.
constexpr double kRangeKnots[] = {0.2, 0.4, 0.6, 0.8};
/// s, of what relaxes: a swing of a cable takes some seconds, its bending some tenths of one. The least that a fit
/// may find.
constexpr double kTriedLags[] = {0.1, 0.3, 1}, kLeastLag = 1e-3;

/// Unit of a force over a power of the variable: "N/m^2", "N s^2/m^2", "N m^2 s".
std::string unit_over(const LawNames& names, int power) {
  if (power == 0) return names.force_unit;
  if (names.variable_unit == "m/s^2") return "kg";
  if (names.variable_unit == "N")
    return power == 1 ? "m" : fmt::format("m/N^{}", power - 1);  // moments
  struct Row {
    const char *unit, *below, *above;
  };
  static constexpr Row kRows[] = {{"m", "", "m"},        {"m/s", "s", "m"}, {"rad", "", "rad"},
                                  {"rad/s", "s", "rad"}, {"1/m", "m", ""},  {"1/(m s)", "m s", ""}};
  const Row& row = *std::find_if(std::begin(kRows), std::end(kRows),
                                 [&](const Row& of) { return names.variable_unit == of.unit; });
  const auto raised = [&](std::string unit) {
    const int size = std::abs(power);
    if (unit.empty() || size == 1) return unit;
    const std::string exponent = fmt::format("^{}", size);
    const std::size_t space = unit.find(' ');
    if (space != std::string::npos) unit.insert(space, exponent);
    return unit + exponent;
  };
  std::string above = raised(power > 0 ? row.below : row.above);
  std::string below = raised(power > 0 ? row.above : row.below);
  // "N/m" over a power: one fraction.
  std::string numerator = names.force_unit;
  const std::size_t slash = numerator.find('/');
  if (slash != std::string::npos) {
    below = numerator.substr(slash + 1) + (below.empty() ? "" : " " + below);
    numerator.resize(slash);
  }
  if (below.find(' ') != std::string::npos) below = "(" + below + ")";
  return numerator + (above.empty() ? "" : " " + above) + (below.empty() ? "" : "/" + below);
}

/// Directions of length one, evenly spread: in space the corners and the middles of the faces of a cube.
std::vector<ChainVector> directions_around(bool in_space) {
  std::vector<ChainVector> directions;
  for (int k = 0; !in_space && k < kDirections; ++k) {
    const double turn = 2 * std::numbers::pi * k / kDirections;
    directions.emplace_back(Vector2d(std::sin(turn), std::cos(turn)));
  }
  for (int k = 0; in_space && k < 27; ++k) {
    const Eigen::Vector3i corner(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
    const Index zeros = (corner.array() == 0).count();
    if (zeros == 0 || zeros == 2) directions.emplace_back(corner.cast<double>().normalized());
  }
  return directions;
}

/// Pieces of the time have one spacing and one beginning: those of the first.
bool has_that_of_first(const LawTerm& term) {
  return term.kind == TermKind::kTimePiece && term.knot > 0;
}

/// Where a piece has its value, in units of the half width, or s.
double knot_of(const LawTerm& term) {
  return term.kind == TermKind::kTimePiece ? term.moment + (term.knot + 1) * term.shape
                                           : term.shape;
}

std::vector<int> all_of(Index count) {
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

}  // namespace

CandidateLaw::CandidateLaw(LawSite site, LawVariable variable, const LawChain& chain,
                           const std::vector<LawMotion>& visited, const Numbers& numbers)
    : site_(site), variable_(variable), chain_(chain), numbers_(numbers) {
  double least = HUGE_VAL, most = -HUGE_VAL, sum = 0, squares = 0, count = 0;
  for (const LawMotion& motion : visited) {
    const MatrixXd states = memory().along(motion, chain_);
    for (Index k = 0; k < states.cols(); ++k)
      for (const LawElement& element :
           law_elements(site_, variable_, numbers_.fixed_point, chain_, states.col(k))) {
        least = std::min(least, element.value);
        most = std::max(most, element.value);
        sum += element.value;
        squares += element.value * element.value;
        ++count;
      }
  }
  choose_grammar(least, most);
  if (has_time()) return;  // in s
  if (!against() && !is_angle() && !is_distance() && !of_tension()) middle_ = 0.5 * (least + most);
  half_ = std::max({std::abs(least - middle_), std::abs(most - middle_), 1e-9});
  const double mean = against() ? 0 : sum / count;  // a sign changes at 0
  const double spread = std::sqrt(std::max(0.0, squares / count - mean * mean));
  // The distance from a point that may move would be a position with knots that may.
  if (variable_ == LawVariable::kChord || of_tension()) {
    std::vector<double> knots;
    for (const double knot : kRangeKnots) knots.push_back((least + knot * (most - least)) / half_);
    add_curve(grammar_, knots);
  }
  add_velocity_curves(spread);
  for (LawTerm& term : grammar_.terms)
    if (!is_piece(term.kind)) term.width = relative_width(term.kind) * spread / half_;
}

void CandidateLaw::choose_grammar(double least, double most) {
  grammar_ = variable_ == LawVariable::kAcceleration ? inertia_grammar()
             : has_lag()                             ? relaxing_grammar()
             : has_time()                            ? time_grammar(least, most)
             : over_tension(variable_)               ? friction_grammar()
             : of_tension()                          ? tension_grammar()
             : variable_ == LawVariable::kChordRate  ? dashpot_grammar()
             : against()                             ? velocity_grammar()
             : is_angle()                            ? angle_grammar()
             : is_distance()                         ? distance_grammar()
                                                     : position_grammar();
}

void CandidateLaw::add_velocity_curves(double spread) {
  // Of the size of a vector at a right angle to the cable effects have squares alone.
  const bool size = chain_.in_space && variable_ == LawVariable::kNormalVelocity;
  if ((kind() != Formula::Kind::kDissipation && !has_lag()) || size) return;
  std::vector<double> knots;
  for (const double knot : kVelocityKnots)
    if (knot * spread < kLastInnerKnot * half_) knots.push_back(knot * spread / half_);
  knots.push_back(1);
  add_velocity_curve(grammar_, knots, variable_ != LawVariable::kSpeed);
}

double CandidateLaw::constants(const std::vector<int>& form) const {
  double count = static_cast<double>(of_point()) + has_lag();
  for (const int term : form) count += 1 + !shape_name(term).empty() + has_moment(term);
  return count;
}

MatrixXd CandidateLaw::force(const VectorXd& state, const std::vector<int>& form) const {
  MatrixXd force = MatrixXd::Zero(chain_.turns(), static_cast<Index>(form.size()));
  for (const LawElement& element :
       law_elements(site_, variable_, numbers_.fixed_point, chain_, state)) {
    const double u = (element.value - middle_) / half_;
    for (std::size_t j = 0; j < form.size(); ++j)
      force.col(static_cast<Index>(j)) +=
          element.weight * value_of(grammar_.terms[static_cast<std::size_t>(form[j])], u) *
          element.gradient;
  }
  return force;
}

bool CandidateLaw::sticks(const std::vector<int>& form) const {
  const bool joints = site_.kind == SiteKind::kJoint || site_.kind == SiteKind::kJoints;
  return joints && std::any_of(form.begin(), form.end(), [&](int term) {
           const TermKind kind = grammar_.terms[static_cast<std::size_t>(term)].kind;
           return kind == TermKind::kFriction || kind == TermKind::kSaturating;
         });
}

MatrixXd CandidateLaw::resistance(const VectorXd& state, const std::vector<int>& form,
                                  const VectorXd& coefficients) const {
  MatrixXd out = MatrixXd::Zero(chain_.turns(), chain_.turns());
  for (const LawElement& element :
       law_elements(site_, variable_, numbers_.fixed_point, chain_, state)) {
    const double u = std::max(std::abs(element.value) / half_, 1e-9);
    double size = 0;
    for (std::size_t j = 0; j < form.size(); ++j)
      size += coefficients[static_cast<Index>(j)] *
              value_of(grammar_.terms[static_cast<std::size_t>(form[j])], u);
    out += element.weight * size / (u * half_) * element.gradient * element.gradient.transpose();
  }
  return out;
}

MatrixXd CandidateLaw::force(const VectorXd& state) const { return force(state, all_of(terms())); }

bool CandidateLaw::admits(const VectorXd& coefficients) const {
  return (coefficients.array() != 0).all() && (!against() || (coefficients.array() <= 0).all());
}

Index CandidateLaw::places() const {
  const double length = chain_.lengths.sum();
  if (site_.kind == SiteKind::kPair) return 1 + !at_end(site_.other_arc_length, length);
  return site_.kind == SiteKind::kPlace && !at_end(site_.arc_length, length);
}

std::string CandidateLaw::shape_name(int term) const {
  const LawTerm& of = grammar_.terms[static_cast<std::size_t>(term)];
  const char* const name = text_of(of.kind).shape;
  return name && !has_that_of_first(of) ? name : "";
}

bool CandidateLaw::has_moment(int term) const {
  const LawTerm& of = grammar_.terms[static_cast<std::size_t>(term)];
  return text_of(of.kind).moment && !has_that_of_first(of);
}

VectorXd CandidateLaw::numbers(const std::vector<int>& form) const {
  std::vector<double> numbers;
  if (places() > 0) numbers.push_back(site_.arc_length);
  if (places() > 1) numbers.push_back(site_.other_arc_length);
  for (Index k = 0; k < of_point(); ++k) numbers.push_back(numbers_.fixed_point[k]);
  if (has_lag()) numbers.push_back(numbers_.lag);
  for (const int place : form) {
    const LawTerm& term = grammar_.terms[static_cast<std::size_t>(place)];
    if (!shape_name(place).empty()) numbers.push_back(term.shape);
    if (has_moment(place)) numbers.push_back(term.moment);
  }
  return VectorXd::Map(numbers.data(), static_cast<Index>(numbers.size()));
}

VectorXd CandidateLaw::steps(const std::vector<int>& form) const {
  VectorXd steps = kNumberStep * numbers(form).cwiseAbs();
  steps.segment(places(), of_point()).setConstant(kNumberStep * half_);
  Index next = places() + of_point() + has_lag();
  for (const int term : form) {
    if (shape_name(term).empty()) continue;
    if (shape_name(term) == kEdge) steps[next] = kNumberStep;
    ++next;
    if (has_moment(term)) steps[next] = steps[next - 1], ++next;
  }
  return steps;
}

std::optional<CandidateLaw> CandidateLaw::with(const std::vector<int>& form,
                                               const VectorXd& numbers) const {
  CandidateLaw other = *this;
  Index next = 0;
  if (places() > 0) other.site_.arc_length = numbers[next++];
  if (places() > 1) other.site_.other_arc_length = numbers[next++];
  for (Index k = 0; k < of_point(); ++k) other.numbers_.fixed_point[k] = numbers[next++];
  if (has_lag()) other.numbers_.lag = numbers[next++];
  bool possible =
      numbers.allFinite() &&
      (places() == 0 || (other.site_.arc_length > 0 && other.places() == places())) &&
      (site_.kind != SiteKind::kPair || other.site_.arc_length < other.site_.other_arc_length) &&
      (!has_lag() || other.numbers_.lag > kLeastLag);
  for (const int place : form) {
    LawTerm& term = other.grammar_.terms[static_cast<std::size_t>(place)];
    if (has_that_of_first(term)) {
      const LawTerm& first = other.grammar_.terms[static_cast<std::size_t>(form.front())];
      term.shape = first.shape;
      term.moment = first.moment;
    }
    if (shape_name(place).empty()) continue;
    term.shape = numbers[next++];
    possible = possible && (shape_name(place) == kEdge || term.shape > kLeastShape);
    if (has_moment(place)) term.moment = numbers[next++];
  }
  if (!possible) return std::nullopt;
  return other;
}

bool CandidateLaw::has_pieces(const std::vector<int>& form) const {
  return is_piece(grammar_.terms[static_cast<std::size_t>(form.front())].kind);
}

bool CandidateLaw::is_curve(const std::vector<int>& form) const {
  const TermKind kind = grammar_.terms[static_cast<std::size_t>(form.back())].kind;
  return has_pieces(form) || kind == TermKind::kBend || kind == TermKind::kTimePiece;
}

bool CandidateLaw::has_terms_of(const std::vector<int>& form, const CandidateLaw& other,
                                const std::vector<int>& other_form) const {
  const auto kinds_of = [](const CandidateLaw& law, const std::vector<int>& of) {
    std::vector<TermKind> kinds;
    kinds.reserve(of.size());
    for (const int term : of)
      kinds.push_back(law.grammar_.terms[static_cast<std::size_t>(term)].kind);
    if (!law.has_pieces(of)) return kinds;
    const bool odd = kinds.front() == TermKind::kPiece;
    return std::vector{odd ? TermKind::kPiece : TermKind::kForwardPiece};
  };
  return kinds_of(*this, form) == kinds_of(other, other_form);
}

bool CandidateLaw::same_pair(const CandidateLaw& other) const {
  return site_.kind == other.site_.kind && site_.joint == other.site_.joint &&
         places() == other.places() && variable_ == other.variable_;
}

bool CandidateLaw::differs_by_numbers(const std::vector<int>& form, const CandidateLaw& other,
                                      const std::vector<int>& other_form) const {
  return same_pair(other) && has_terms_of(form, other, other_form);
}

CandidateLaw CandidateLaw::sharp() const {
  CandidateLaw other = *this;
  for (LawTerm& term : other.grammar_.terms)
    if (!is_piece(term.kind)) term.width *= kSharpWidth;
  return other;
}

CandidateLaw CandidateLaw::on(const LawChain& chain) const {
  CandidateLaw other = *this;
  other.chain_ = chain;
  return other;
}

std::string CandidateLaw::force_name() const {
  return names_of(site_, variable_, chain_.in_space).force;
}
std::string CandidateLaw::variable_name() const {
  return names_of(site_, variable_, chain_.in_space).variable;
}

CandidateLaw::Formula::Kind CandidateLaw::kind() const {
  using Kind = Formula::Kind;
  return variable_ == LawVariable::kAcceleration   ? Kind::kMass
         : has_lag()                               ? Kind::kRelaxing
         : has_time()                              ? Kind::kForce
         : over_tension(variable_) || of_tension() ? Kind::kTorque
         : against()                               ? Kind::kDissipation
                                                   : Kind::kPotential;
}

CandidateLaw::Constant CandidateLaw::amplitude(const std::string& name, int power,
                                               double coefficient, double deviation) const {
  const double scale = std::pow(half_, power);
  const double value = (has_time() ? 1 : -1) * coefficient / scale;
  const double bound = kBound * std::abs(value);
  return {name,  unit_over(names_of(site_, variable_, chain_.in_space), power),
          value, deviation / scale,
          true,  against() ? 0.0 : -bound,
          bound};
}

void CandidateLaw::add_spring_about_rest(Formula& formula, const VectorXd& coefficients,
                                         const MatrixXd& covariance) const {
  const LawNames names = names_of(site_, variable_, chain_.in_space);
  // c0 + c1 (x - middle) / half = -linear (x - rest)
  const double ratio = coefficients[0] / coefficients[1], by_ratio = half_ / coefficients[1];
  formula.constants.push_back(
      amplitude("linear", 1, coefficients[1], std::sqrt(std::max(0.0, covariance(1, 1)))));
  const double rest_variance =
      (covariance(0, 0) - 2 * ratio * covariance(0, 1) + ratio * ratio * covariance(1, 1)) *
      by_ratio * by_ratio;
  const double rest = middle_ - half_ * ratio, deviation = std::sqrt(std::max(0.0, rest_variance));
  const double reach = std::isfinite(deviation) ? kBound * deviation : kBound * half_;
  formula.constants.push_back(
      {"rest", names.variable_unit, rest, deviation, false, rest - reach, rest + reach});
  formula.text = fmt::format("{} = -linear x ({} - rest)", names.force, names.variable);
  formula.energy = energy_of({TermKind::kLinear}, fmt::format("{} - rest", names.symbols));
}

std::string CandidateLaw::energy_of(const LawTerm& term, const std::string& symbols) const {
  const LawTermText& text = text_of(term.kind);
  return filled(is_piece(term.kind)                ? piece_text(term)
                : kind() == Formula::Kind::kTorque ? text.slope
                                                   : text.energy,
                std::to_string(term.knot + 1), symbols,
                names_of(site_, variable_, chain_.in_space).squared, letter_of(term.knot));
}

void CandidateLaw::add_terms(Formula& formula, const std::vector<int>& form,
                             const VectorXd& coefficients, const VectorXd& deviations) const {
  const LawNames names = names_of(site_, variable_, chain_.in_space);
  const bool about_middle =
      middle_ != 0 && (form.size() > 1 || grammar_.terms[static_cast<std::size_t>(form[0])].kind !=
                                              TermKind::kConstant);
  const std::string words =
      about_middle ? fmt::format("{} {} {:.3g} {}", names.variable, middle_ < 0 ? "+" : "-",
                                 std::abs(middle_), names.variable_unit)
                   : names.variable;
  const std::string symbols =
      about_middle ? fmt::format("{} - middle", names.symbols) : names.symbols;
  std::string terms;
  Index number = coefficients.size() + places() + of_point() + has_lag();  // the next shape's
  for (std::size_t j = 0; j < form.size(); ++j) {
    const LawTerm& term = grammar_.terms[static_cast<std::size_t>(form[j])];
    const LawTermText& text = text_of(term.kind);
    const std::string n = letter_of(term.knot);
    terms += (terms.empty() ? "" : " + ") + filled(text.words, words, "", "", n);
    formula.energy += (formula.energy.empty() ? "" : " + ") + energy_of(term, symbols);
    const auto i = static_cast<Index>(j);
    formula.constants.push_back(amplitude(filled(text.amplitude, "", "", "", n), text.power,
                                          coefficients[i], deviations[i]));
    if (shape_name(form[j]).empty()) continue;
    const double shape = term.shape * half_;
    const bool edge = shape_name(form[j]) == kEdge;
    formula.constants.push_back({text.shape, names.variable_unit, shape,
                                 half_ * deviations[number++], false,
                                 edge ? shape - 2 * half_ : shape / kMostShapeChange,
                                 edge ? shape + 2 * half_ : shape * kMostShapeChange});
    if (!has_moment(form[j])) continue;
    const double reach = kMostShapeChange * shape;
    formula.constants.push_back({"moment", "s", term.moment, deviations[number++], false,
                                 term.moment - reach, term.moment + reach});
  }
  const bool pieces = has_pieces(form) || (has_time() && is_curve(form));
  if (pieces) terms = pieces_in_words(form);
  formula.text = fmt::format("{} = {}{}", names.force, has_time() ? "" : "-",
                             form.size() == 1 && !pieces ? terms : fmt::format("({})", terms));
}

std::string CandidateLaw::pieces_in_words(const std::vector<int>& form) const {
  const LawNames names = names_of(site_, variable_, chain_.in_space);
  std::string words;
  for (const int place : form) {
    const LawTerm& term = grammar_.terms[static_cast<std::size_t>(place)];
    words += fmt::format("{}{} at {}{:.3g} {}", words.empty() ? "" : ", ",
                         filled(text_of(term.kind).words, "", "", "", letter_of(term.knot)),
                         term.kind == TermKind::kBackwardPiece ? "-" : "", knot_of(term) * half_,
                         names.variable_unit);
  }
  return fmt::format("straight pieces of {} through {}{}", names.variable,
                     has_time() ? "" : "0 and ",
                     words + (has_time() ? ", 0 before and after" : ""));
}

void CandidateLaw::add_fixed(Formula& formula, const std::vector<int>& form) const {
  std::string expressions = formula.energy;
  for (const auto& [name, value] : formula.definitions) expressions += value;
  const auto add = [&](const std::string& name, double value) {
    if (expressions.find(name) != std::string::npos)
      formula.fixed.push_back({name, formula.variable_unit, value});
  };
  double width = 0;
  for (const int term : form)
    width = std::max(width, grammar_.terms[static_cast<std::size_t>(term)].width);
  for (const LawTerm& term : grammar_.terms)
    if (term.kind == TermKind::kBend || term.kind == TermKind::kPiece)
      add("knot_" + letter_of(term.knot), term.shape * half_);
  add("step", width * half_);
  add("middle", middle_);
  add("edge_width", width * half_);
  add("floor", kSpeedFloor);
  add("unit", 1);
}

CandidateLaw::Formula CandidateLaw::formula(const std::vector<int>& form,
                                            const VectorXd& coefficients,
                                            const MatrixXd& covariance) const {
  const LawNames names = names_of(site_, variable_, chain_.in_space);
  const VectorXd deviations = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  Formula formula;
  formula.variable_unit = names.variable_unit;
  formula.kind = kind();
  formula.curve = is_curve(form);
  const auto kind_of = [&](std::size_t j) {
    return grammar_.terms[static_cast<std::size_t>(form[j])].kind;
  };
  const bool about_rest = form.size() == 2 && kind_of(0) == TermKind::kConstant &&
                          kind_of(1) == TermKind::kLinear && coefficients[1] != 0;
  if (about_rest)
    add_spring_about_rest(formula, coefficients, covariance);
  else
    add_terms(formula, form, coefficients, deviations);
  const Index numbers = coefficients.size() + places();
  for (Index k = 0; k < of_point(); ++k) {
    const double at = numbers_.fixed_point[k];
    formula.constants.push_back({fmt::format("point_{}", word_of(static_cast<ForceDirection>(k))),
                                 "m", at, deviations[numbers + k], false, at - 2 * half_,
                                 at + 2 * half_});
  }
  if (about_rest) return formula;
  if (has_lag())
    formula.constants.push_back({"lag", "s", numbers_.lag, deviations[numbers], false,
                                 numbers_.lag / kMostShapeChange, numbers_.lag * kMostShapeChange});
  if (has_lag() || has_time()) formula.along = {names.symbols};
  if (has_pieces(form)) {
    if (!has_lag()) {
      formula.kind = Formula::Kind::kForce;
      formula.along = components_of(site_, variable_, chain_.in_space);
      formula.definitions.emplace_back("motion",
                                       variable_ == LawVariable::kSpeed
                                           ? fmt::format("sqrt({} + floor^2)", names.squared)
                                           : names.symbols);
    }
    for (const int term : form)
      for (auto& part : piece_parts(grammar_.terms[static_cast<std::size_t>(term)]))
        if (std::find(formula.definitions.begin(), formula.definitions.end(), part) ==
            formula.definitions.end())
          formula.definitions.push_back(std::move(part));
  }
  if (formula.kind == Formula::Kind::kMass)
    formula.energy =
        fmt::format("-point_mass*gravity*({})", symbols_of(LawVariable::kDownPosition, false));
  add_fixed(formula, form);
  if (over_tension(variable_)) {
    formula.energy =
        fmt::format("sqrt({}^2 + tension_floor^2)*({})", kSteadyTension, formula.energy);
    formula.fixed.push_back({"tension_floor", "N", kTensionFloor});
  }
  return formula;
}

std::vector<CandidateLaw> candidates_at(const LawSite& site, const LawChain& chain,
                                        const std::vector<LawMotion>& visited) {
  std::vector<CandidateLaw> candidates;
  const auto add = [&](LawVariable variable, const CandidateLaw::Numbers& numbers) {
    candidates.emplace_back(site, variable, chain, visited, numbers);
  };
  for (const LawVariable variable : variables_of(site, chain)) {
    if (relaxing_of(variable)) {
      for (const double lag : kTriedLags) add(variable, {.lag = lag});
      continue;
    }
    if (variable != LawVariable::kDistance) {
      add(variable, {});
      continue;
    }
    std::vector<ChainVector> positions;
    for (const LawMotion& motion : visited)
      for (Index k = 0; k < motion.state.cols(); ++k)
        positions.push_back(
            place_kinematics(motion.state.col(k), chain.coordinates, chain, site.arc_length)
                .motion.position);
    ChainVector least = positions.front(), most = least;
    for (const ChainVector& at : positions) {
      least = least.cwiseMin(at);
      most = most.cwiseMax(at);
    }
    const ChainVector middle = 0.5 * (least + most);
    for (const ChainVector& direction : directions_around(chain.in_space)) {
      double reach = 0;
      for (const ChainVector& at : positions) reach = std::max(reach, (at - middle).dot(direction));
      for (const double beyond : kBeyond)
        add(variable, {.fixed_point = middle + (reach + beyond * chain.lengths.sum()) * direction});
    }
  }
  return candidates;
}

std::vector<CandidateLaw> candidates_of_time(const LawSite& site, const LawChain& chain,
                                             const std::vector<LawMotion>& visited) {
  std::vector<CandidateLaw> candidates;
  for (const LawVariable variable : times_of(site, chain.in_space))
    candidates.emplace_back(site, variable, chain, visited, CandidateLaw::Numbers{});
  return candidates;
}

}  // namespace catena
