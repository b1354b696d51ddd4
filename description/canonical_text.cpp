// SPDX-License-Identifier: BSD-3-Clause
#include <cctype>

#include "common/number_text.hpp"
#include "common/toml_reader.hpp"
#include "description/description.hpp"

namespace catena {
namespace {

const char* word(Scope scope) {
  switch (scope) {
    case Scope::kModel:
      return "model";
    case Scope::kJoint:
      return "joint";
    case Scope::kLink:
      return "link";
  }
  return "";
}

const char* word(Place place) {
  switch (place) {
    case Place::kJoint:
      return "joint";
    case Place::kPivot:
      return "pivot";
    case Place::kLink:
      return "link";
    case Place::kLinkCentre:
      return "link_centre";
    case Place::kLoad:
      return "load";
    case Place::kChord:
      return "chord";
    case Place::kAnywhere:
      return "anywhere";
  }
  return "";
}

const char* word(ScalarKind kind) {
  switch (kind) {
    case ScalarKind::kTorque:
      return "torque";
    case ScalarKind::kPotential:
      return "potential";
    case ScalarKind::kDissipation:
      return "dissipation";
    case ScalarKind::kKinetic:
      return "kinetic";
  }
  return "";
}

// Spaces never decide what an expression means: nowhere do two names or numbers stand side by side.
std::string without_spaces(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (!std::isspace(static_cast<unsigned char>(c))) result += c;
  }
  return result;
}

// Between units a space means a product.
std::string with_single_spaces(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c != ' ' || (!result.empty() && result.back() != ' ')) result += c;
  }
  if (!result.empty() && result.back() == ' ') result.pop_back();
  return result;
}

class CanonicalText {
 public:
  void line(std::string_view key, std::string_view value) {
    text_ += std::string(key) + " " + std::string(value) + "\n";
  }

  void line(std::string_view key, const Expression& expression) {
    if (expression.given()) line(key, without_spaces(expression.text));
  }

  void effect(const Effect& effect) {
    line("effect", effect.id);
    for (const EffectParameter& p : effect.parameters) {
      line("parameter", p.name + " [" + with_single_spaces(p.unit) + "] " + word(p.scope) + " " +
                            shortest_number(p.default_value) + " " + shortest_number(p.lower) +
                            " " + shortest_number(p.upper) + " " + shortest_number(p.neutral));
    }
    for (const Constant& c : effect.constants) {
      line("constant", c.name + " [" + with_single_spaces(c.unit) + "] " + c.text);
    }
    for (const SignalChannel& s : effect.signals) {
      line("signal", s.name + " [" + with_single_spaces(s.unit) + "]");
    }
    for (const Coordinate& c : effect.coordinates) {
      line("coordinate", c.name + " [" + with_single_spaces(c.unit) + "]" +
                             (c.at == Place::kLoad ? " load" : ""));
    }
    for (const ExtraState& s : effect.states) {
      line("state", s.name + " [" + with_single_spaces(s.unit) + "] " + word(s.at));
      line("rate", s.rate);
    }
    for (const Definition& d : effect.definitions) {
      line("definition", d.name + " " + word(d.at));
      line("value", d.value);
    }
    line("flow.side", effect.flow.side);
    line("flow.down", effect.flow.down);
    line("flow.across", effect.flow.across);
    for (const ForceTerm& f : effect.forces) {
      line("force", std::string(word(f.at)) + (f.per_length ? " per length" : ""));
      line("side", f.side);
      line("down", f.down);
      line("across", f.across);
      line("normal", f.normal);
      line("tangential", f.tangential);
      line("along", f.along);
      line("value", f.value);
    }
    for (const ScalarTerm& s : effect.scalars) {
      line(word(s.kind), std::string(word(s.at)) + (s.per_length ? " per length" : ""));
      line("value", s.value);
    }
    for (const EventValue& e : effect.events) {
      line("event", e.name + " [" + with_single_spaces(e.unit) + "] " + word(e.at));
      line("value", e.value);
    }
    line("support.side", effect.support.side);
    line("support.down", effect.support.down);
    line("support.across", effect.support.across);
    line("support.clamp_side", effect.support.clamp_side);
    line("support.clamp_down", effect.support.clamp_down);
    line("support.clamp_across", effect.support.clamp_across);
    line("support.bend_axis_side", effect.support.bend_axis_side);
    line("support.bend_axis_down", effect.support.bend_axis_down);
    line("support.bend_axis_across", effect.support.bend_axis_across);
    if (effect.held_end.link > 0) line("held_joint", std::to_string(effect.held_end.link));
    line("held_end.side", effect.held_end.side);
    line("held_end.down", effect.held_end.down);
    line("held_end.across", effect.held_end.across);
    line("held_end.clamp_side", effect.held_end.clamp_side);
    line("held_end.clamp_down", effect.held_end.clamp_down);
    line("held_end.clamp_across", effect.held_end.clamp_across);
    line("held_end.clamp_stiffness", effect.held_end.clamp_stiffness);
    line("held_end.clamp_damping", effect.held_end.clamp_damping);
    line("held_end.torsional_stiffness", effect.held_end.torsional_stiffness);
    line("held_end.roll", effect.held_end.roll);
    line("chord.from", effect.chord.from);
    line("chord.to", effect.chord.to);
    line("centre_offset", effect.kinematics.centre_offset);
    line("load_offset", effect.kinematics.load_offset);
    line("load_side", effect.kinematics.load_side);
    line("load_down", effect.kinematics.load_down);
    line("load_across", effect.kinematics.load_across);
    line("load_inertia", effect.kinematics.load_inertia);
    line("load_mass", effect.kinematics.load_mass);
    line("rest_angle", effect.kinematics.rest_angle);
    line("pivot_rest_angle", effect.kinematics.pivot_rest_angle);
    line("extension", effect.kinematics.extension);
    line("gravity_tilt", effect.kinematics.gravity_tilt);
    line("sensor.side", effect.sensor.side);
    line("sensor.down", effect.sensor.down);
    line("sensor.across", effect.sensor.across);
    line("sensor.angle", effect.sensor.angle);
    line("sensor.clock", effect.sensor.clock);
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_ = "catena model, format 1\n";
};

}  // namespace

std::string canonical_text(const Description& description) {
  CanonicalText canonical;
  if (description.space != Space::kPlane)
    canonical.line("space", space_words()[static_cast<std::size_t>(description.space)]);
  for (const Effect& effect : description.effects) canonical.effect(effect);
  return canonical.text();
}

}  // namespace catena
