// SPDX-License-Identifier: GPL-3.0-or-later
//
// The straight line between two places of the chain. From one to the other it is a sum over the links between,
//
//     chord = sum_i fraction_i span_i,
//
// where span_i reaches from the upper to the lower end of link i, and fraction_i is the part of the link that
// lies between the places.
#include "generator/derivation/chain.hpp"

namespace catena {

using GiNaC::ex;

namespace {

// m: over this length a place goes from one link to the next as its arc length is changed, so that it has a
// derivative. It is off by half of this at a joint, and by less elsewhere.
const ex kPlaceRounding = GiNaC::numeric(1, 1000000000);

}  // namespace

// With R(x) = sqrt((s - x)^2 + rounding^2) at the arc lengths x of the ends of a link, the part of it that lies
// before s is (its length + R(upper end) - R(lower end)) / 2.
void Chain::place_chord(const Effect& effect) {
  if (!effect.chord.given()) return;
  ChordLine& chord = chords_[effect.id];
  const std::string name = effect.id + "_chord";
  const ex from = evaluate(effect, effect.chord.from, kShape, Place::kAnywhere, 0, "m");
  const ex to = evaluate(effect, effect.chord.to, kShape, Place::kAnywhere, 0, "m");
  const auto edge = [&](Link i) {
    // Named before it is squared: written out, the square would cancel where a place is at a joint.
    const auto distance = [&](const ex& place) {
      const ex beyond = definitions_.define(name + "_beyond", i, place - arc_[i]);
      return GiNaC::sqrt(beyond * beyond + kPlaceRounding * kPlaceRounding);
    };
    return definitions_.define(name + "_edge", i, distance(to) - distance(from));
  };
  chord.fraction.resize(1);
  ex above = edge(0);
  for (Link i = 1; i <= links_; ++i) {
    const ex below = edge(i);
    chord.fraction.push_back(
        definitions_.define(name + "_fraction", i, (above - below) / (2 * length_[i])));
    above = below;
  }
  ex square =
      kPlaceRounding * kPlaceRounding;  // two places that touch have no direction between them
  for (const Axis axis : axes()) {
    ex sum = 0;
    for (Link i = 1; i <= links_; ++i)
      sum = define_variable(name + "_sum" + ending(axis), i,
                            sum + chord.fraction[i] * span_[axis][i]);
    chord.vector.push_back(define_variable(name + ending(axis), kNoIndex, sum));
    square += chord.vector.back() * chord.vector.back();
  }
  const ex squared = define_variable(name + "_square", kNoIndex, square);
  chord.distance = define_shape(name + "_distance", GiNaC::sqrt(squared));
}

// What two places exert on one another pulls in the links between them, too, in the opposite direction.
ex Chain::force_of_chords(Axis axis, Link i) {
  ex sum = 0;
  for (const auto& [id, chord] : chords_) {
    const auto force = generalised_force_.find(definitions_.number_of(chord.vector[axis]));
    if (force != generalised_force_.end()) sum += force->second * chord.fraction[i];
  }
  return sum;
}

}  // namespace catena
