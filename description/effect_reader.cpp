// SPDX-License-Identifier: BSD-3-Clause
#include "description/effect_reader.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>
#include <stdexcept>

#include "common/in_quotes.hpp"
#include "common/nearest_name.hpp"
#include "common/number_text.hpp"
#include "common/toml_reader.hpp"
#include "description/built_in_effects.hpp"
#include "description/description.hpp"
#include "description/effect.hpp"
#include "description/effect_checks.hpp"
#include "description/expression_syntax.hpp"
#include "description/unit.hpp"

namespace catena {
namespace {

// Names with a meaning in expressions: an effect's own names must differ from them. `across` is not among
// them: files of the plane have it as a name of their own, which then hides the position across.
const std::set<std::string, std::less<>>& reserved_names() {
  static const std::set<std::string, std::less<>> names = {"time",
                                                           "gravity",
                                                           "load_mass",
                                                           "side",
                                                           "down",
                                                           "depth",
                                                           "velocity_side",
                                                           "velocity_down",
                                                           "velocity_across",
                                                           "velocity_normal",
                                                           "velocity_tangential",
                                                           "direction_side",
                                                           "direction_down",
                                                           "direction_across",
                                                           "direction_rate_side",
                                                           "direction_rate_down",
                                                           "direction_rate_across",
                                                           "relative_side",
                                                           "relative_down",
                                                           "relative_across",
                                                           "relative_normal",
                                                           "relative_tangential",
                                                           "angle",
                                                           "rate",
                                                           "length",
                                                           "mass",
                                                           "inertia",
                                                           "joint_angle",
                                                           "joint_rate",
                                                           kSteadyTension,
                                                           "stiffness",
                                                           "damping",
                                                           "arc",
                                                           "spacing",
                                                           "distance",
                                                           "distance_rate",
                                                           "pi",
                                                           "sin",
                                                           "cos",
                                                           "tan",
                                                           "exp",
                                                           "log",
                                                           "sqrt",
                                                           "tanh",
                                                           "sinh",
                                                           "cosh",
                                                           "atan",
                                                           "asinh"};
  return names;
}

// One effect file while it is read: the names it has given so far.
class EffectReader {
 public:
  explicit EffectReader(const TomlTable& file) : file_(file) {}

  Effect read() {
    effect_.source_file = file_.file();
    effect_.id = file_.text("id");
    check_identifier(file_, "id", effect_.id);
    effect_.title = file_.text("title");
    effect_.description = file_.text("description");
    effect_.form_of = file_.optional_text("form_of").value_or("");
    if (!effect_.form_of.empty()) check_identifier(file_, "form_of", effect_.form_of);
    effect_.rare = file_.optional_flag("rare").value_or(false);
    if (file_.has("space")) effect_.space = space_words()[file_.choice("space", space_words())];
    if (const auto extended = file_.optional_text("extends")) take_over(*extended);
    read_parts();
    file_.finish();
    check_consistency(effect_);
    return std::move(effect_);
  }

 private:
  void read_parts() {
    read_parameters();
    read_constants();
    read_signals();
    read_coordinates();
    read_states();
    read_tables();
    read_definitions();
    read_flow();
    read_forces();
    read_scalars();
    read_events();
    read_whole_chain_terms();
  }

  // All that the built-in effect `id` declares, as if it stood at the beginning of this file. Its own title
  // and what a diagnosis makes of it stay behind.
  void take_over(const std::string& id) {
    const auto& effects = built_in_effects();
    const auto base = std::find_if(effects.begin(), effects.end(),
                                   [&](const BuiltInEffect& effect) { return effect.id == id; });
    if (base == effects.end())
      file_.fail("extends", in_quotes(id) + " is not a built-in effect" +
                                suggestion(id, built_in_effect_ids()));
    const TomlTable own = file_;
    file_ = TomlTable::parse(base->text, "built in: " + id, "effect");
    if (effect_.space.empty() && file_.has("space"))
      effect_.space = space_words()[file_.choice("space", space_words())];
    for (const char* const table :
         {"flow", "support", "held_end", "held_joint", "chord", "kinematics", "sensor"})
      if (file_.has(table) && own.has(table))
        own.fail(table,
                 "stands in " + in_quotes(id) + ", too, which this effect extends; leave one away");
    read_parts();
    file_ = own;
  }

  void check_identifier(const TomlTable& table, std::string_view key, const std::string& name) {
    const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
    const auto inner = [&](char c) {
      return letter(c) || std::isdigit(static_cast<unsigned char>(c)) || c == '_';
    };
    if (name.empty() || !letter(name[0]) || !std::all_of(name.begin(), name.end(), inner)) {
      table.fail(key,
                 in_quotes(name) + " is not a name; a name is a letter, then letters, digits, _");
    }
  }

  // A new name for expressions, given at `key` of `table`.
  void add_name(const TomlTable& table, std::string_view key, const std::string& name) {
    check_identifier(table, key, name);
    const std::size_t underscore = name.rfind('_');
    if (underscore != std::string::npos && underscore + 1 < name.size() &&
        std::all_of(name.begin() + static_cast<long>(underscore) + 1, name.end(),
                    [](unsigned char c) { return std::isdigit(c); })) {
      table.fail(key, in_quotes(name) + " ends like the name of one joint or link; choose another");
    }
    if (reserved_names().contains(name)) {
      table.fail(key,
                 in_quotes(name) + " has a meaning in expressions already; choose another name");
    }
    if (!names_.insert(name).second) {
      table.fail(key, in_quotes(name) + " is given twice in this effect; choose another name");
    }
  }

  static std::string unit(const TomlTable& table, std::string_view key = "unit") {
    const std::string text = table.text(key);
    try {
      Unit::parse(text);
    } catch (const std::invalid_argument& error) {
      table.fail(key, error.what());
    }
    return text;
  }

  static Expression expression(const TomlTable& table, std::string_view key) {
    Expression result;
    if (!table.has(key)) return result;
    if (table.is_text(key)) {
      result.text = table.text(key);
    } else {
      result.text = shortest_number(table.number(key));
    }
    if (std::all_of(result.text.begin(), result.text.end(),
                    [](unsigned char c) { return std::isspace(c); })) {
      table.fail(key, "is empty; give an expression or leave the key out");
    }
    result.file = table.file();
    result.line = table.line(key);
    result.key = table.path(key);
    return result;
  }

  static Expression required(const TomlTable& table, std::string_view key) {
    if (!table.has(key)) table.text(key);  // fails, saying what is missing
    return expression(table, key);
  }

  // The place named by `at`; those allowed are given in the order of their words.
  static Place place(const TomlTable& table, const std::vector<Place>& allowed) {
    static const std::vector<std::string> words = {"joint",       "pivot", "link",
                                                   "link_centre", "load",  "chord"};
    std::vector<std::string> here;
    for (const Place p : allowed) here.push_back(words[static_cast<std::size_t>(p)]);
    return allowed[table.choice("at", here)];
  }

  static bool per_length(const TomlTable& table, Place at) {
    if (!table.has("per")) return false;
    table.choice("per", {"length"});
    if (at != Place::kLinkCentre && at != Place::kLink) {
      table.fail("per", "\"length\" goes with at = \"link_centre\" or \"link\" only; leave it out");
    }
    return true;
  }

  void read_parameters() {
    const auto tables = file_.named_tables("parameters");
    for (const auto& [name, table] : tables) {
      EffectParameter parameter;
      parameter.name = name;
      add_name(table, "", name);
      parameter.unit = unit(table);
      parameter.description = table.text("description");
      parameter.lower = table.optional_number("lower").value_or(parameter.lower);
      parameter.upper = table.optional_number("upper").value_or(parameter.upper);
      parameter.neutral = table.optional_number("neutral").value_or(parameter.neutral);
      if (!std::isinf(parameter.neutral)) parameter.default_value = parameter.neutral;
      parameter.default_value = table.optional_number("default").value_or(parameter.default_value);
      parameter.scope =
          static_cast<Scope>(table.choice("scope", {"model", "joint", "link"}, false));
      check_bounds(table, parameter);
      read_sentences(table, parameter);
      parameter.at_most = table.optional_text("at_most").value_or("");
      effect_.parameters.push_back(parameter);
    }
    for (const auto& [name, table] : tables) check_order(table, name);
  }

  /// Refuses an order of two parameters that cannot be compared, or of which one stands in another order.
  void check_order(const TomlTable& table, const std::string& name) const {
    const auto find = [&](const std::string& of) {
      return std::find_if(effect_.parameters.begin(), effect_.parameters.end(),
                          [&](const EffectParameter& each) { return each.name == of; });
    };
    const EffectParameter& lesser = *find(name);
    if (lesser.at_most.empty()) return;
    const auto greater = find(lesser.at_most);
    if (greater == effect_.parameters.end() || greater->name == name)
      table.fail("at_most", in_quotes(lesser.at_most) + " is no other parameter of this effect");
    if (greater->unit != lesser.unit || greater->lower != lesser.lower ||
        greater->neutral != lesser.neutral || greater->scope != Scope::kModel ||
        lesser.scope != Scope::kModel)
      table.fail("at_most", in_quotes(greater->name) +
                                " needs the same unit, lower bound and neutral value, and both one "
                                "value for the whole model");
    for (const EffectParameter& each : effect_.parameters)
      if (!each.at_most.empty() && each.name != name &&
          (each.name == greater->name || each.at_most == greater->name || each.at_most == name))
        table.fail("at_most", "a parameter stands in one order only");
  }

  static void read_sentences(const TomlTable& table, EffectParameter& parameter) {
    const auto read = [&](const char* key) {
      const std::string sentence = table.optional_text(key).value_or("");
      if (sentence.empty()) return sentence;
      if (sentence.find("{}") == std::string::npos || sentence.find("{}") != sentence.rfind("{}"))
        table.fail(key, "write {} once, where the amount goes");
      if (!std::isfinite(parameter.neutral) || parameter.scope != Scope::kModel)
        table.fail(key, "goes with a finite neutral value and one value for the whole model");
      return sentence;
    };
    parameter.above = read("above");
    parameter.below = read("below");
  }

  static void check_bounds(const TomlTable& table, const EffectParameter& parameter) {
    if (!(parameter.lower < parameter.upper)) {
      table.fail("upper", shortest_number(parameter.upper) + " is not above the lower bound, " +
                              shortest_number(parameter.lower) + "; give lower < upper");
    }
    const auto check = [&](const char* key, double value) {
      if (value < parameter.lower || value > parameter.upper) {
        table.fail(key, shortest_number(value) + " lies outside the bounds, " +
                            shortest_number(parameter.lower) + " to " +
                            shortest_number(parameter.upper) + "; change it or them");
      }
    };
    check("neutral", parameter.neutral);
    check("default", parameter.default_value);
    if (std::isinf(parameter.default_value)) table.fail("default", "is infinite; give a number");
  }

  void read_constants() {
    for (const auto& [name, table] : file_.named_tables("constants")) {
      add_name(table, "", name);
      Constant constant;
      constant.name = name;
      constant.value = table.number("value");
      if (!std::isfinite(constant.value)) table.fail("value", "is not finite; give a number");
      constant.text = shortest_number(constant.value);
      constant.unit = unit(table);
      table.optional_text("description");
      effect_.constants.push_back(constant);
    }
  }

  void read_signals() {
    for (const TomlTable& table : file_.tables("signal")) {
      SignalChannel signal;
      signal.name = table.text("name");
      add_name(table, "name", signal.name);
      add_name(table, "name", signal.name + "_rate");
      add_name(table, "name", signal.name + "_acceleration");
      signal.unit = unit(table);
      signal.description = table.optional_text("description").value_or("");
      effect_.signals.push_back(signal);
    }
  }

  void read_coordinates() {
    for (const TomlTable& table : file_.tables("coordinate")) {
      Coordinate coordinate;
      coordinate.name = table.text("name");
      add_name(table, "name", coordinate.name);
      add_name(table, "name", coordinate.name + "_rate");
      coordinate.unit = unit(table);
      coordinate.description = table.optional_text("description").value_or("");
      coordinate.at = table.choice("per", {"link", "load"}) == 0 ? Place::kLink : Place::kLoad;
      effect_.coordinates.push_back(coordinate);
    }
  }

  void read_states() {
    for (const TomlTable& table : file_.tables("state")) {
      ExtraState state;
      state.name = table.text("name");
      add_name(table, "name", state.name);
      state.unit = unit(table);
      state.description = table.optional_text("description").value_or("");
      state.at = std::array{Place::kJoint, Place::kPivot,
                            Place::kLoad}[table.choice("per", {"joint", "pivot", "load"})];
      state.rate = required(table, "rate");
      effect_.states.push_back(state);
    }
  }

  // A table becomes a definition: the value at the first point and a change of slope at each, rounded:
  // (x + sqrt(x^2 + rounding^2))/2 in place of max(x, 0). Two constants of value one carry the units.
  void read_tables() {
    constexpr std::size_t kMostPoints = 24;  // an expression has an end (expression_syntax.cpp)
    constexpr double kGreatest = 1e50;       // as of parameters: squares and slopes stay numbers
    constexpr const char* kTooGreat = "must be finite, and at most 1e50 in size";
    for (const TomlTable& table : file_.tables("table")) {
      Definition definition;
      definition.name = table.text("name");
      add_name(table, "name", definition.name);
      const std::string at = definition.name + "_point", of = definition.name + "_value";
      for (const auto& [name, key] : {std::pair{at, "of_unit"}, {of, "unit"}}) {
        add_name(table, "name", name);
        effect_.constants.push_back({name, "1", 1, unit(table, key)});
      }
      const std::vector<double> points = table.numbers("points"), values = table.numbers("values");
      if (points.size() < 2 || points.size() > kMostPoints)
        table.fail("points", std::to_string(points.size()) + " numbers; give 2 to " +
                                 std::to_string(kMostPoints));
      if (values.size() != points.size())
        table.fail("values", std::to_string(values.size()) + " numbers; there are " +
                                 std::to_string(points.size()) + " points");
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!(std::abs(points[i]) <= kGreatest)) table.fail("points", kTooGreat);
        if (!(std::abs(values[i]) <= kGreatest)) table.fail("values", kTooGreat);
        if (i && !(points[i] > points[i - 1]))
          table.fail("points", shortest_number(points[i]) + " after " +
                                   shortest_number(points[i - 1]) + "; points must increase");
      }
      // Its square must not vanish beside that of a distance, nor the table beside it.
      constexpr double kLeastRounding = 1e-7;
      const double rounding = table.number("rounding"), span = points.back() - points.front();
      if (!(rounding >= kLeastRounding * span && rounding <= span && rounding * kGreatest >= 1))
        table.fail("rounding", shortest_number(rounding) + "; must be at least 1e-50, and " +
                                   shortest_number(kLeastRounding) +
                                   " to 1 times the distance from the first to the last point, " +
                                   shortest_number(span));
      definition.value = required(table, "of");
      (void)parse_syntax(
          definition.value);  // by itself, before it stands within another expression
      const std::string place = "((" + definition.value.text + ")/" + at + "-(";
      std::string text = "(" + shortest_number(values[0]) + ")";
      double slope = 0;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const double next =
            i + 1 < points.size() ? (values[i + 1] - values[i]) / (points[i + 1] - points[i]) : 0;
        if (!(std::abs(next - slope) <= kGreatest))
          table.fail("values", "change too steeply at the point " + shortest_number(points[i]) +
                                   "; no slope may be above 1e50");
        const std::string x = place + shortest_number(points[i]) + "))";
        text.append("+(").append(shortest_number((next - slope) / 2)).append(")*(").append(x);
        text.append("+sqrt(")
            .append(x)
            .append("^2+")
            .append(shortest_number(rounding))
            .append("^2))");
        slope = next;
      }
      definition.value.text = of;
      definition.value.text.append("*(").append(text).append(")");
      effect_.definitions.push_back(definition);
    }
  }

  void read_definitions() {
    for (const TomlTable& table : file_.tables("definition")) {
      Definition definition;
      definition.name = table.text("name");
      add_name(table, "name", definition.name);
      if (table.has("at")) {
        definition.at = place(table, {Place::kJoint, Place::kPivot, Place::kLink,
                                      Place::kLinkCentre, Place::kLoad, Place::kChord});
      }
      if (definition.at == Place::kLoad && effect_.moves_load())
        add_name(table, "name", definition.name + "_rate");
      definition.value = required(table, "value");
      effect_.definitions.push_back(definition);
    }
  }

  void read_flow() {
    const auto table = file_.optional_table("flow");
    if (!table) return;
    effect_.flow = {expression(*table, "side"), expression(*table, "down"),
                    expression(*table, "across")};
    if (!effect_.flow.given())
      table->fail("has none of side, down and across; give one or leave the table out");
  }

  void read_forces() {
    for (const TomlTable& table : file_.tables("force")) {
      ForceTerm force;
      const bool generalised = table.has("along") || table.has("value");
      force.at =
          place(table, generalised ? std::vector{Place::kJoint, Place::kPivot, Place::kLink,
                                                 Place::kLinkCentre, Place::kLoad, Place::kChord}
                                   : std::vector{Place::kJoint, Place::kLinkCentre, Place::kLoad});
      force.per_length = per_length(table, force.at);
      force.side = expression(table, "side");
      force.down = expression(table, "down");
      force.across = expression(table, "across");
      force.normal = expression(table, "normal");
      force.tangential = expression(table, "tangential");
      const bool cartesian = force.side.given() || force.down.given() || force.across.given();
      const bool along_link = force.normal.given() || force.tangential.given();
      if (cartesian + along_link + generalised != 1) {
        table.fail(
            "give the force as side, down and across, or as normal and tangential, or as value and "
            "along");
      }
      if (generalised) {
        force.along = required(table, "along");
        force.value = required(table, "value");
      }
      if (along_link && force.at == Place::kJoint) {
        table.fail("a joint has no normal of its own; give side and down, or at = \"link_centre\"");
      }
      effect_.forces.push_back(force);
    }
  }

  void read_scalars() {
    static const std::vector<Place> bodies = {Place::kJoint, Place::kPivot, Place::kLink,
                                              Place::kLinkCentre, Place::kLoad};
    static const std::vector<Place> deforming = {Place::kJoint,      Place::kPivot, Place::kLink,
                                                 Place::kLinkCentre, Place::kLoad,  Place::kChord};
    static const std::vector<Place> turning = {Place::kJoint, Place::kPivot, Place::kLink,
                                               Place::kLoad};
    const auto read = [&](const char* key, ScalarKind kind) {
      for (const TomlTable& table : file_.tables(key)) {
        ScalarTerm term;
        term.kind = kind;
        term.at = place(table, kind == ScalarKind::kTorque    ? turning
                               : kind == ScalarKind::kKinetic ? bodies
                                                              : deforming);
        term.per_length = per_length(table, term.at);
        term.value = required(table, "value");
        effect_.scalars.push_back(term);
      }
    };
    read("torque", ScalarKind::kTorque);
    read("potential", ScalarKind::kPotential);
    read("dissipation", ScalarKind::kDissipation);
    read("kinetic", ScalarKind::kKinetic);
  }

  void read_events() {
    for (const TomlTable& table : file_.tables("event")) {
      EventValue event;
      event.name = table.text("name");
      add_name(table, "name", event.name);
      event.unit = unit(table);
      event.at = place(table, {Place::kJoint, Place::kPivot, Place::kLink, Place::kLinkCentre,
                               Place::kLoad, Place::kChord});
      event.value = required(table, "value");
      effect_.events.push_back(event);
    }
  }

  void read_whole_chain_terms() {
    if (const auto table = file_.optional_table("support")) {
      effect_.support = {expression(*table, "side"),
                         expression(*table, "down"),
                         expression(*table, "across"),
                         expression(*table, "clamp_side"),
                         expression(*table, "clamp_down"),
                         expression(*table, "clamp_across"),
                         expression(*table, "bend_axis_side"),
                         expression(*table, "bend_axis_down"),
                         expression(*table, "bend_axis_across")};
      if (!effect_.support.given()) {
        table->fail("has neither side nor down; give one or leave the table out");
      }
    }
    if (const auto table = file_.optional_table("held_end")) {
      HeldEnd& end = effect_.held_end;
      end = {expression(*table, "side"),
             expression(*table, "down"),
             expression(*table, "across"),
             expression(*table, "clamp_side"),
             expression(*table, "clamp_down"),
             expression(*table, "clamp_across"),
             expression(*table, "clamp_stiffness"),
             expression(*table, "clamp_damping"),
             expression(*table, "torsional_stiffness"),
             expression(*table, "roll")};
      if (!end.holds())
        table->fail(
            "has none of side, down and across, which say where the end is held; give them");
      if (!end.turns() && (end.clamp_stiffness.given() || end.clamp_damping.given()))
        table->fail(
            "has a clamp without a direction; give clamp_side, clamp_down and clamp_across");
      if (!end.turns() && (end.twists() || end.roll.given()))
        table->fail(
            "has torsion, but an end that is free to turn is not twisted; give clamp_side, "
            "clamp_down and clamp_across");
      if (end.roll.given() && !end.twists())
        table->fail("has a roll, which twists nothing; give torsional_stiffness, too");
    }
    if (const auto table = file_.optional_table("held_joint")) {
      HeldEnd& joint = effect_.held_end;
      if (joint.holds())
        table->fail(
            "stands beside [held_end]; an effect holds one place, so give each its own file");
      joint.side = expression(*table, "side");
      joint.down = expression(*table, "down");
      joint.across = expression(*table, "across");
      const long link = table->integer("link");
      if (link < 1 || link > std::numeric_limits<int>::max())
        table->fail("link",
                    "is " + std::to_string(link) + "; name the link whose far end is held, from 1");
      joint.link = static_cast<int>(link);
      if (!joint.holds())
        table->fail(
            "has none of side, down and across, which say where the joint is held; give them");
    }
    if (const auto table = file_.optional_table("chord"))
      effect_.chord = {required(*table, "from"), required(*table, "to")};
    if (const auto table = file_.optional_table("kinematics")) {
      Kinematics& kinematics = effect_.kinematics;
      kinematics.centre_offset = expression(*table, "centre_offset");
      kinematics.load_offset = expression(*table, "load_offset");
      kinematics.load_side = expression(*table, "load_side");
      kinematics.load_down = expression(*table, "load_down");
      kinematics.load_across = expression(*table, "load_across");
      kinematics.load_inertia = expression(*table, "load_inertia");
      kinematics.load_mass = expression(*table, "load_mass");
      kinematics.rest_angle = expression(*table, "rest_angle");
      kinematics.pivot_rest_angle = expression(*table, "pivot_rest_angle");
      kinematics.extension = expression(*table, "extension");
      kinematics.gravity_tilt = expression(*table, "gravity_tilt");
    }
    if (const auto table = file_.optional_table("sensor")) {
      effect_.sensor = {expression(*table, "side"), expression(*table, "down"),
                        expression(*table, "across"), expression(*table, "angle"),
                        expression(*table, "clock")};
    }
  }

  TomlTable file_;
  Effect effect_;
  std::set<std::string> names_;
};

}  // namespace

Effect read_effect(const TomlTable& file) { return EffectReader(file).read(); }

Effect read_effect(const std::filesystem::path& path) {
  return read_effect(TomlTable::read(path, "effect"));
}

}  // namespace catena
