// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_terms.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace catena {

namespace {

/// Of a sine an edge is 2 % of the largest value.
constexpr double kSignWidth = 0.05, kEdgeWidth = 0.03;
/// Of a corner of a piece, over the largest velocity: cosh of its inverse is a number, and of seven times that.
constexpr double kPieceWidth = 0.01;
/// Values of a curve against the time. With six one period of a sine is followed within some per cent.
constexpr int kTimeValues = 6;

/// max(y, 0), smooth: CATENA_POSITIVE_PART, the slope of CATENA_STOP. Few repetitions of y, for y is long in an effect.
double positive_part(double y, double width) {
  const double size = std::hypot(y, width);
  return 0.25 * (y + size) * (y + size) / size;
}

#define CATENA_STOP(Y) "(" Y " + sqrt(" Y "^2 + edge_width^2))^2/8"
#define CATENA_POSITIVE_PART(Y) \
  "(" Y " + sqrt(" Y "^2 + edge_width^2))^2/(4*sqrt(" Y "^2 + edge_width^2))"
/// Around a knot, over the spacing: the second difference of sizes that are smooth where they are 0.
#define CATENA_SIZE(Y) "sqrt((" Y ")^2 + edge_width^2)"
#define CATENA_HAT(Y)                  \
  CATENA_SIZE(Y " + spacing_of_knots") \
  " - 2*" CATENA_SIZE(Y) " + " CATENA_SIZE(Y " - spacing_of_knots")

/// log(cosh(y)), also where cosh(y) is too large a number.
double log_cosh(double y) {
  const double size = std::abs(y);
  return size + std::log1p(std::exp(-2 * size)) - std::numbers::ln2;
}

/// u up to the knot, which it keeps beyond, with a smooth corner: odd, or of positive u alone. As CATENA_UP_TO and
/// CATENA_ONE_WAY_UP_TO. Concave in the knot, so that no piece makes energy.
double up_to(double knot, double u, double width, bool one_way) {
  if (!(knot > 0)) return 0;
  const double before = log_cosh((u - knot) / width);
  if (!one_way) return 0.5 * width * (log_cosh((u + knot) / width) - before);
  return 0.5 * (u * std::tanh(u / width) + knot - width * (before + std::numbers::ln2));
}

#define CATENA_UP_TO \
  "edge_width*(log(cosh(({z} + {n})/edge_width)) - log(cosh(({z} - {n})/edge_width)))/2"
#define CATENA_ONE_WAY_UP_TO \
  "({z}*tanh({z}/edge_width) + {n} - edge_width*(log(cosh(({z} - {n})/edge_width)) + {x}))/2"

/// What a curve is written with: the velocity up to a knot.
std::string part_name(TermKind kind, int knot) {
  const char* const way = kind == TermKind::kPiece          ? ""
                          : kind == TermKind::kForwardPiece ? "forward_"
                                                            : "backward_";
  return std::string(way) + "up_to_" + letter_of(knot);
}

/// Slopes of a piece before its knot and behind it.
struct PieceSlopes {
  double up, down;
  explicit PieceSlopes(const LawTerm& term)
      : up(1 / (term.shape - term.below)), down(1 / (term.above - term.shape)) {}
};

double piece(const LawTerm& term, double u) {
  const bool one_way = term.kind != TermKind::kPiece;
  const PieceSlopes slopes(term);
  const auto part = [&](double knot) { return up_to(knot, u, term.width, one_way); };
  double value = (slopes.up + slopes.down) * part(term.shape) - slopes.up * part(term.below);
  if (slopes.down > 0) value -= slopes.down * part(term.above);
  return value;
}

void add_form(LawGrammar& grammar, const std::vector<LawTerm>& form) {
  std::vector<int>& places = grammar.forms.emplace_back();
  for (const LawTerm& term : form) {
    int place = 0;
    while (place < static_cast<int>(grammar.terms.size()) &&
           (grammar.terms[static_cast<std::size_t>(place)].kind != term.kind ||
            grammar.terms[static_cast<std::size_t>(place)].shape != term.shape ||
            grammar.terms[static_cast<std::size_t>(place)].moment != term.moment ||
            grammar.terms[static_cast<std::size_t>(place)].knot != term.knot))
      ++place;
    if (place == static_cast<int>(grammar.terms.size())) grammar.terms.push_back(term);
    places.push_back(place);
  }
}

LawGrammar grammar(const std::vector<std::vector<LawTerm>>& forms) {
  LawGrammar grammar;
  for (const std::vector<LawTerm>& form : forms) add_form(grammar, form);
  return grammar;
}

using Forms = std::vector<std::vector<LawTerm>>;

void add_shapes(Forms& forms, TermKind kind, std::initializer_list<double> shapes) {
  for (const double shape : shapes) forms.push_back({{kind, shape}});
}

const LawTerm kOne{TermKind::kConstant}, kX{TermKind::kLinear}, kX2{TermKind::kQuadratic},
    kX3{TermKind::kCubic};

/// With a curve over both sides of the middle.
LawGrammar with_curve(const Forms& forms) {
  LawGrammar all = grammar(forms);
  add_curve(all, {-0.6, -0.2, 0.2, 0.6});
  return all;
}

}  // namespace

double value_of(const LawTerm& term, double u) {
  switch (term.kind) {
    case TermKind::kConstant:
      return 1;
    case TermKind::kLinear:
    case TermKind::kViscous:
    case TermKind::kInertia:
    case TermKind::kRelaxing:
      return u;
    case TermKind::kQuadratic:
      return u * u;
    case TermKind::kCubic:
    case TermKind::kCube:
      return u * u * u;
    case TermKind::kUpperStop:
    case TermKind::kBend:
      return positive_part(u - term.shape, term.width);
    case TermKind::kLowerStop:
      return -positive_part(term.shape - u, term.width);
    case TermKind::kDeadZone:
      return positive_part(u - term.shape, term.width) - positive_part(-u - term.shape, term.width);
    case TermKind::kUpperExponential:
      return std::exp(u / term.shape);
    case TermKind::kLowerExponential:
      return -std::exp(-u / term.shape);
    case TermKind::kInverse:
      return 1 / u;
    case TermKind::kInverseSquare:
      return 1 / (u * u);
    case TermKind::kInverseCube:
      return 1 / (u * u * u);
    case TermKind::kFriction:
      return u / std::hypot(u, term.width);
    case TermKind::kSaturating:
      return u / std::hypot(u, term.shape);
    case TermKind::kSquare:
      return std::abs(u) * u;
    case TermKind::kFalling:
      return u / (1 + u * u / (term.shape * term.shape));
    case TermKind::kPiece:
    case TermKind::kForwardPiece:
      return piece(term, u);
    case TermKind::kBackwardPiece:
      return -piece(term, -u);
    case TermKind::kPulse:
      return std::exp(-0.5 * std::pow((u - term.moment) / term.shape, 2));
    case TermKind::kTimePiece: {
      const auto size = [&](int knot) {
        return std::hypot(u - term.moment - knot * term.shape, term.width);
      };
      return 0.5 * (size(term.knot) - 2 * size(term.knot + 1) + size(term.knot + 2)) / term.shape;
    }
    case TermKind::kOnset:
      return 0.5 * (1 + std::tanh((u - term.moment) / term.shape));
  }
  return 0;
}

double relative_width(TermKind kind) {
  switch (kind) {
    case TermKind::kFriction:
      return kSignWidth;
    case TermKind::kUpperStop:
    case TermKind::kLowerStop:
    case TermKind::kDeadZone:
    case TermKind::kBend:
      return kEdgeWidth;
    default:
      return 0;
  }
}

bool is_piece(TermKind kind) {
  return kind == TermKind::kPiece || kind == TermKind::kForwardPiece ||
         kind == TermKind::kBackwardPiece;
}

std::string letter_of(int knot) { return std::string(1, static_cast<char>('a' + knot)); }

Definitions piece_parts(const LawTerm& term) {
  constexpr const char* kLogTwo = "0.6931471805599453";
  const bool odd = term.kind == TermKind::kPiece, backward = term.kind == TermKind::kBackwardPiece;
  Definitions parts;
  for (int knot = std::max(0, term.knot - 1); knot <= term.knot + std::isfinite(term.above); ++knot)
    parts.emplace_back(part_name(term.kind, knot),
                       filled(odd ? CATENA_UP_TO : CATENA_ONE_WAY_UP_TO, kLogTwo,
                              backward ? "(-motion)" : "motion", "", "knot_" + letter_of(knot)));
  return parts;
}

std::string piece_text(const LawTerm& term) {
  const auto knot = [](int of) { return "knot_" + letter_of(of); };
  const auto part = [&](int of) { return part_name(term.kind, of); };
  const std::string here = knot(term.knot);
  std::string sum = term.knot == 0 ? fmt::format("{}/{}", part(0), here)
                                   : fmt::format("({} - {})/({} - {})", part(term.knot),
                                                 part(term.knot - 1), here, knot(term.knot - 1));
  if (std::isfinite(term.above)) {
    const int next = term.knot + 1;
    sum += fmt::format(" + ({} - {})/({} - {})", part(term.knot), part(next), knot(next), here);
  }
  return fmt::format("{}{}*({})", term.kind == TermKind::kBackwardPiece ? "-" : "",
                     text_of(term.kind).amplitude, sum);
}

const LawTermText& text_of(TermKind kind) {
  static constexpr struct {
    TermKind kind;
    LawTermText text;
  } kTexts[] = {
      {TermKind::kConstant,
       {"constant", nullptr, 0, "constant", "constant*({z})", false, "constant"}},
      {TermKind::kLinear,
       {"linear", nullptr, 1, "linear x ({x})", "linear*({z})^2/2", false, "linear*({z})"}},
      {TermKind::kQuadratic,
       {"quadratic", nullptr, 2, "quadratic x ({x})^2", "quadratic*({z})^3/3", false,
        "quadratic*({z})^2"}},
      {TermKind::kCubic, {"cubic", nullptr, 3, "cubic x ({x})^3", "cubic*({z})^4/4"}},
      {TermKind::kUpperStop,
       {"spring", "edge", 1, "spring x (({x}) - edge, if it is above)",
        "spring*" CATENA_STOP("({z} - edge)")}},
      {TermKind::kLowerStop,
       {"spring", "edge", 1, "spring x (({x}) - edge, if it is below)",
        "spring*" CATENA_STOP("(edge - ({z}))")}},
      {TermKind::kDeadZone,
       {"spring", "gap", 1, "spring x (({x}) beyond -gap to gap)",
        "spring*(" CATENA_STOP("({z} - gap)") " + " CATENA_STOP("(-({z}) - gap)") ")"}},
      {TermKind::kBend,
       {"bend_{n}", nullptr, 1, "bend_{n} x (({x}) - knot_{n}, if it is above)",
        "bend_{n}*" CATENA_STOP("({z} - knot_{n})"), false,
        "bend_{n}*" CATENA_POSITIVE_PART("({z} - knot_{n})")}},
      {TermKind::kUpperExponential,
       {"force", "decay", 0, "force x exp(({x})/decay)", "force*decay*exp(({z})/decay)"}},
      {TermKind::kLowerExponential,
       {"force", "decay", 0, "(-force x exp(-({x})/decay))", "force*decay*exp(-({z})/decay)"}},
      {TermKind::kInverse, {"pull", nullptr, -1, "pull/({x})", "pull*log({z}/unit)"}},
      {TermKind::kInverseSquare, {"pull", nullptr, -2, "pull/({x})^2", "-pull/({z})"}},
      {TermKind::kInverseCube, {"pull", nullptr, -3, "pull/({x})^3", "-pull/(2*({q}))"}},
      {TermKind::kFriction,
       {"friction", nullptr, 0, "friction x sign of {x}", "friction*(sqrt({q} + step^2) - step)",
        false, "friction*({z})/sqrt({q} + step^2)"}},
      {TermKind::kViscous, {"linear", nullptr, 1, "linear x {x}", "linear*({q})/2"}},
      {TermKind::kSquare,
       {"quadratic", nullptr, 2, "quadratic x |{x}| x {x}", "quadratic*({q} + floor^2)^(3/2)/3"}},
      {TermKind::kCube, {"cubic", nullptr, 3, "cubic x {x}^3", "cubic*({q})^2/4"}},
      {TermKind::kSaturating,
       {"friction", "saturation", 0, "friction x {x}/sqrt({x}^2 + saturation^2)",
        "friction*(sqrt({q} + saturation^2) - saturation)", false,
        "friction*({z})/sqrt({q} + saturation^2)"}},
      {TermKind::kFalling,
       {"linear", "saturation", 1, "linear x {x}/(1 + ({x}/saturation)^2)",
        "linear*saturation^2*log(1 + ({q})/saturation^2)/2"}},
      // What these do has no energy that is written: piece_text.
      {TermKind::kPiece, {"resistance_{n}", nullptr, 0, "resistance_{n}", ""}},
      {TermKind::kForwardPiece, {"forward_{n}", nullptr, 0, "forward_{n}", ""}},
      {TermKind::kBackwardPiece, {"backward_{n}", nullptr, 0, "-backward_{n}", ""}},
      // What these do is no energy of the variable: law_effect.cpp.
      {TermKind::kInertia, {"point_mass", nullptr, 1, "point_mass x ({x})", ""}},
      {TermKind::kPulse,
       {"amplitude", "duration", 0, "amplitude x exp(-((time - moment)/duration)^2/2)",
        "amplitude*exp(-((time - moment)/duration)^2/2)", true}},
      {TermKind::kOnset,
       {"amplitude", "duration", 0, "amplitude x (1 + tanh((time - moment)/duration))/2",
        "amplitude*(1 + tanh((time - moment)/duration))/2", true}},
      {TermKind::kTimePiece,
       {"force_{n}", "spacing_of_knots", 0, "force_{n}",
        "force_{n}*(" CATENA_HAT("time - moment - {x}*spacing_of_knots") ")/(2*spacing_of_knots)",
        true}},
      {TermKind::kRelaxing, {"spring", nullptr, 1, "spring x {x}", ""}},
  };
  for (const auto& row : kTexts)
    if (row.kind == kind) return row.text;
  return kTexts[0].text;
}

#undef CATENA_UP_TO
#undef CATENA_ONE_WAY_UP_TO
#undef CATENA_STOP
#undef CATENA_HAT
#undef CATENA_SIZE
#undef CATENA_POSITIVE_PART

std::string filled(const std::string& text, const std::string& x, const std::string& z,
                   const std::string& q, const std::string& n) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool slot = text[i] == '{' && i + 2 < text.size() && text[i + 2] == '}';
    if (!slot) {
      out += text[i];
      continue;
    }
    out += text[i + 1] == 'x' ? x : text[i + 1] == 'z' ? z : text[i + 1] == 'q' ? q : n;
    i += 2;
  }
  return out;
}

const LawGrammar& position_grammar() {
  static const LawGrammar kGrammar = [] {
    Forms forms = {{kOne}, {kOne, kX}, {kOne, kX, kX2}, {kOne, kX, kX2, kX3}};
    add_shapes(forms, TermKind::kUpperStop, {-0.5, -0.25, 0, 0.25, 0.5});
    add_shapes(forms, TermKind::kLowerStop, {0.5, 0.25, 0, -0.25, -0.5});
    add_shapes(forms, TermKind::kUpperExponential, {0.25, 0.5});
    add_shapes(forms, TermKind::kLowerExponential, {0.25, 0.5});
    return with_curve(forms);
  }();
  return kGrammar;
}

const LawGrammar& distance_grammar() {
  static const LawGrammar kGrammar = [] {
    Forms forms = {{kOne, kX},
                   {{TermKind::kInverse}},
                   {{TermKind::kInverseSquare}},
                   {{TermKind::kInverseCube}}};
    add_shapes(forms, TermKind::kUpperStop, {0.5, 0.7, 0.8, 0.9});
    return grammar(forms);
  }();
  return kGrammar;
}

const LawGrammar& angle_grammar() {
  static const LawGrammar kGrammar = [] {
    Forms forms = {
        {kOne}, {kX}, {kX3}, {kOne, kX}, {kX, kX3}, {kOne, kX, kX2}, {kOne, kX, kX2, kX3}};
    add_shapes(forms, TermKind::kDeadZone, {0.15, 0.3, 0.45, 0.6});
    add_shapes(forms, TermKind::kUpperStop, {-0.25, 0, 0.25, 0.5});
    add_shapes(forms, TermKind::kLowerStop, {0.25, 0, -0.25, -0.5});
    return with_curve(forms);
  }();
  return kGrammar;
}

const LawGrammar& velocity_grammar() {
  static const LawGrammar kGrammar = [] {
    const LawTerm sign{TermKind::kFriction}, v{TermKind::kViscous}, v2{TermKind::kSquare},
        v3{TermKind::kCube};
    Forms forms = {{sign},           {v}, {v2}, {v3}, {sign, v}, {sign, v2}, {v, v2}, {v, v3},
                   {sign, v, v2, v3}};
    add_shapes(forms, TermKind::kSaturating, {0.15, 0.3, 0.6});
    add_shapes(forms, TermKind::kFalling, {0.1, 0.2, 0.4, 0.8});
    forms.push_back({sign, {TermKind::kFalling, 0.1}});
    forms.push_back({sign, {TermKind::kFalling, 0.2}});
    return grammar(forms);
  }();
  return kGrammar;
}

const LawGrammar& friction_grammar() {
  static const LawGrammar kGrammar = [] {
    Forms forms = {{{TermKind::kFriction}}};
    add_shapes(forms, TermKind::kSaturating, {0.15, 0.3, 0.6});
    return grammar(forms);
  }();
  return kGrammar;
}

const LawGrammar& tension_grammar() {
  static const LawGrammar kGrammar = grammar({{kX}, {kOne, kX}, {kX, kX2}, {kOne, kX, kX2}});
  return kGrammar;
}

const LawGrammar& dashpot_grammar() {
  static const LawGrammar kGrammar = [] {
    const LawTerm v{TermKind::kViscous}, v2{TermKind::kSquare};
    return grammar({{v}, {v2}, {v, v2}});
  }();
  return kGrammar;
}

const LawGrammar& inertia_grammar() {
  static const LawGrammar kGrammar = grammar({{{TermKind::kInertia}}});
  return kGrammar;
}

const LawGrammar& relaxing_grammar() {
  static const LawGrammar kGrammar = grammar({{{TermKind::kRelaxing}}});
  return kGrammar;
}

void add_curve(LawGrammar& grammar, const std::vector<double>& knots) {
  std::vector<LawTerm> curve = {kOne, kX};
  int next = 0;
  for (const double knot : knots) {
    LawTerm& bend = curve.emplace_back(LawTerm{TermKind::kBend, knot});
    bend.knot = next++;
  }
  add_form(grammar, curve);
}

void add_velocity_curve(LawGrammar& grammar, const std::vector<double>& knots, bool has_sign) {
  const auto pieces = [&](TermKind kind) {
    std::vector<LawTerm> curve;
    for (std::size_t k = 0; k < knots.size(); ++k) {
      LawTerm& term = curve.emplace_back(LawTerm{kind, knots[k]});
      term.knot = static_cast<int>(k);
      term.width = kPieceWidth;
      if (k > 0) term.below = knots[k - 1];
      if (k + 1 < knots.size()) term.above = knots[k + 1];
    }
    return curve;
  };
  add_form(grammar, pieces(TermKind::kPiece));
  if (!has_sign) return;
  std::vector<LawTerm> both = pieces(TermKind::kForwardPiece);
  const std::vector<LawTerm> backward = pieces(TermKind::kBackwardPiece);
  both.insert(both.end(), backward.begin(), backward.end());
  add_form(grammar, both);
}

LawGrammar time_grammar(double begin, double end) {
  // So close that the nearest one explains most of what any does: a pulse half of its width away, or 1.2 times as
  // wide, has a product of 0.93 with another one.
  constexpr double kShortest = 0.03, kWidening = 1.5;  // s, 1
  Forms forms;
  const double span = end - begin;
  const auto add = [&](TermKind kind, double width, double first, double last, double step) {
    for (int k = 0; first + k * step < last; ++k)
      forms.push_back({{kind, width, first + k * step}});
  };
  double width = kShortest;
  while (width < span / 4) {
    add(TermKind::kPulse, width, begin + width, end, width);
    width *= kWidening;
  }
  width = kShortest;
  while (width < span / 4) {
    add(TermKind::kOnset, width, begin + 2 * width, end - 2 * width, std::max(width, span / 40));
    width *= 3;
  }
  // Over half of the time at most: a slow force over all of it follows anything.
  constexpr double kShortestSpacing = 0.05;  // s
  constexpr int kSpacings = kTimeValues + 1;
  for (double spacing = kShortestSpacing; kSpacings * spacing < span / 2; spacing *= kWidening)
    for (double first = begin + spacing; first + kSpacings * spacing < end; first += spacing) {
      std::vector<LawTerm>& curve = forms.emplace_back();
      for (int knot = 0; knot < kTimeValues; ++knot) {
        LawTerm& term = curve.emplace_back(LawTerm{TermKind::kTimePiece, spacing, first});
        term.width = kEdgeWidth * spacing;
        term.knot = knot;
      }
    }
  return grammar(forms);
}

}  // namespace catena
