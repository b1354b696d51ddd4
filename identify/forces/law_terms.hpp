// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace catena {

enum class TermKind {
  // against a position
  kConstant,
  kLinear,
  kQuadratic,
  kCubic,
  kUpperStop,  ///< pushes back beyond the shape: what a stop or a taut string does
  kLowerStop,
  kDeadZone,          ///< pushes back beyond the shape on both sides: play
  kBend,              ///< the slope changes at the shape, a knot that stays where it is
  kUpperExponential,  ///< grows by e within the shape
  kLowerExponential,
  // against a distance
  kInverse,
  kInverseSquare,
  kInverseCube,
  // against a velocity
  kFriction,
  kViscous,
  kSquare,
  kCube,
  kSaturating,  ///< viscous far below the shape, constant far above
  kFalling,     ///< viscous far below the shape, falling above: an eddy brake, Stribeck's friction
  kPiece,  ///< of a curve of straight pieces from 0: 1 at the shape, a knot, 0 at the knots beside it; odd
  kForwardPiece,   ///< the same of positive velocities alone
  kBackwardPiece,  ///< of negative ones
  // against an acceleration, against a stretch that relaxes
  kInertia,
  kRelaxing,
  // against the time
  kPulse,      ///< a bell as wide as the shape around the moment
  kOnset,      ///< begins at the moment, over the shape
  kTimePiece,  ///< of a curve of straight pieces that begins at the moment and has a knot after each shape: 1 at its knot
};

/// One term of a law: a function of the variable's distance from a middle, in units of a half width,
/// and its integral. Force = coefficient x value; formulas have amplitude = -coefficient /
/// half^power.
struct LawTerm {
  TermKind kind = TermKind::kLinear;
  double shape = 0;   ///< in units of the half width, s of the time; 0: it has none
  double moment = 0;  ///< s, of terms that have one
  double width = 0;   ///< of a step or an edge, in units of the half width
  /// Of a piece against a velocity: the knots beside it, where it is 0. Without one above it stays 1.
  double below = 0, above = HUGE_VAL;
  int knot = 0;  ///< of a piece or a bend: which knot it is
};

/// Whether it is a piece of a curve against a velocity. Any of them may be missing in such a curve.
bool is_piece(TermKind kind);

/// At u half widths from the middle.
double value_of(const LawTerm& term, double u);

/// Width of the step of a sign, over the variable's root mean square, and of the edge of a stop, over its standard
/// deviation; 0 for terms that are smooth. A step is not linear in a state. The largest value may be that of one snap
/// of the cable. Effects have them, sharper, as constants `step` and `edge_width`.
double relative_width(TermKind kind);

/// Names of expressions in the language of effects, and what they stand for.
using Definitions = std::vector<std::pair<std::string, std::string>>;
/// A piece in the language of effects, with names of its amplitude and of its knots, knot_a, knot_b; the velocity is
/// `motion`. `piece_parts`: what it needs.
std::string piece_text(const LawTerm& term);
Definitions piece_parts(const LawTerm& term);
/// Names that end with a number are those of one joint or link.
std::string letter_of(int knot);

/// What a formula is written with: names of the amplitude and of the shape (nullptr: none), the
/// power of the variable's unit, words and energy, in which {x} is the variable in words, {z} in the language
/// of effects from the middle, {q} its square and {n} the letter of a knot, also behind the amplitude's name; of the time
/// {x} is the number of a knot.
struct LawTermText {
  const char *amplitude, *shape;
  int power = 0;
  const char *words, *energy;   ///< of the time: its force instead
  bool moment = false;          ///< whether it has one
  const char* slope = nullptr;  ///< of the energy, where a force may be over the tension or of it
};
/// Of every kind there is one.
const LawTermText& text_of(TermKind kind);

/// A text with {x}, {z}, {q}, {n} replaced.
std::string filled(const std::string& text, const std::string& x, const std::string& z,
                   const std::string& q, const std::string& n = "");

/// The terms of a variable, and the sets of them that make a formula, simplest first.
struct LawGrammar {
  std::vector<LawTerm> terms;
  std::vector<std::vector<int>> forms;
};
/// For a position, a distance, a joint's angle, a velocity or rate, a tension, an acceleration, and what relaxes.
const LawGrammar& position_grammar();
const LawGrammar& distance_grammar();
const LawGrammar& angle_grammar();
const LawGrammar& velocity_grammar();
const LawGrammar& friction_grammar();  ///< of these friction alone
const LawGrammar& tension_grammar();
const LawGrammar& dashpot_grammar();  ///< for the rate of a distance
const LawGrammar& inertia_grammar();
const LawGrammar& relaxing_grammar();
/// Adds a curve of straight pieces between these knots, for what no formula fits.
void add_curve(LawGrammar& grammar, const std::vector<double>& knots);
/// Adds a curve against a velocity or what relaxes: pieces from 0 between these knots, the same both ways or, where the
/// variable has a sign, different ones. No piece makes energy where it is against that.
void add_velocity_curve(LawGrammar& grammar, const std::vector<double>& knots, bool has_sign);
/// Between these times, s. A curve is 0 before and after some knots.
LawGrammar time_grammar(double begin, double end);

}  // namespace catena
