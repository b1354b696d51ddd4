// SPDX-License-Identifier: BSD-3-Clause
#include "description/formula.hpp"

#include <map>
#include <set>
#include <utility>

#include "description/expression_syntax.hpp"

namespace catena {
namespace {

// A symbol as a letter with a subscript and dots above; names that are not letters stand upright.
struct Letter {
  std::string latex, mathml;  // of the letter alone
  std::string subscript;
  int dots = 0;
};

const std::map<std::string, Letter>& letters() {
  static const std::map<std::string, Letter> all = {
      {"time", {"t", "t", "", 0}},
      {"gravity", {"g", "g", "", 0}},
      {"load_mass", {"m", "m", "c", 0}},
      {"side", {"r", "r", "s", 0}},
      {"down", {"r", "r", "d", 0}},
      {"across", {"r", "r", "a", 0}},
      {"depth", {"r", "r", "g", 0}},
      {"velocity_side", {"v", "v", "s", 0}},
      {"velocity_down", {"v", "v", "d", 0}},
      {"velocity_across", {"v", "v", "a", 0}},
      {"velocity_normal", {"v", "v", "n", 0}},
      {"velocity_tangential", {"v", "v", "t", 0}},
      {"direction_side", {"e", "e", "s", 0}},
      {"direction_down", {"e", "e", "d", 0}},
      {"direction_across", {"e", "e", "a", 0}},
      {"direction_rate_side", {"e", "e", "s", 1}},
      {"direction_rate_down", {"e", "e", "d", 1}},
      {"direction_rate_across", {"e", "e", "a", 1}},
      {"relative_side", {"u", "u", "s", 0}},
      {"relative_down", {"u", "u", "d", 0}},
      {"relative_across", {"u", "u", "a", 0}},
      {"relative_normal", {"u", "u", "n", 0}},
      {"relative_tangential", {"u", "u", "t", 0}},
      {"angle", {"\\theta", "&#952;", "", 0}},
      {"rate", {"\\theta", "&#952;", "", 1}},
      {"length", {"l", "l", "", 0}},
      {"mass", {"m", "m", "", 0}},
      {"inertia", {"I", "I", "", 0}},
      {"joint_angle", {"\\varphi", "&#966;", "", 0}},
      {"joint_rate", {"\\varphi", "&#966;", "", 1}},
      {kSteadyTension, {"T", "T", "", 0}},
      {"stiffness", {"k", "k", "", 0}},
      {"damping", {"c", "c", "", 0}},
      {"arc", {"s", "s", "", 0}},
      {"spacing", {"\\Delta", "&#916;", "", 0}},
      {"distance", {"d", "d", "", 0}},
      {"distance_rate", {"d", "d", "", 1}},
      {"pi", {"\\pi", "&#960;", "", 0}},
  };
  return all;
}

std::string replaced(const std::string& text, char from, const std::string& to) {
  std::string result;
  for (const char c : text) {
    if (c == from) {
      result += to;
    } else {
      result += c;
    }
  }
  return result;
}

// The two languages.
class Language {
 public:
  virtual ~Language() = default;
  virtual std::string number(const std::string& digits) const = 0;
  virtual std::string letter(const Letter& letter) const = 0;
  virtual std::string upright(const std::string& name, int dots) const = 0;
  virtual std::string in_parentheses(const std::string& a) const = 0;
  virtual std::string fraction(const std::string& a, const std::string& b) const = 0;
  virtual std::string power(const std::string& a, const std::string& b) const = 0;
  virtual std::string root(const std::string& a) const = 0;
  virtual std::string call(const std::string& function, const std::string& a) const = 0;
  virtual std::string binary(const std::string& a, char sign, const std::string& b) const = 0;
  virtual std::string product(const std::string& a, const std::string& b, bool numbers) const = 0;
  virtual std::string negative(const std::string& a) const = 0;
};

class Latex : public Language {
 public:
  std::string number(const std::string& digits) const override {
    const auto e = digits.find_first_of("eE");
    if (e == std::string::npos) return digits;
    const std::string power = "10^{" + std::to_string(std::stol(digits.substr(e + 1))) + "}";
    const std::string mantissa = digits.substr(0, e);
    return mantissa == "1" ? power : mantissa + " \\cdot " + power;
  }
  std::string letter(const Letter& letter) const override {
    return dotted(letter.latex, letter.dots) +
           (letter.subscript.empty() ? "" : "_{" + letter.subscript + "}");
  }
  std::string upright(const std::string& name, int dots) const override {
    return dotted("\\mathrm{" + replaced(name, '_', "\\_") + "}", dots);
  }
  std::string in_parentheses(const std::string& a) const override {
    return "\\left(" + a + "\\right)";
  }
  std::string fraction(const std::string& a, const std::string& b) const override {
    return "\\frac{" + a + "}{" + b + "}";
  }
  std::string power(const std::string& a, const std::string& b) const override {
    return a + "^{" + b + "}";
  }
  std::string root(const std::string& a) const override { return "\\sqrt{" + a + "}"; }
  std::string call(const std::string& function, const std::string& a) const override {
    const bool known = function != "asinh" && function != "atan";
    const std::string name = known ? "\\" + function : "\\operatorname{" + function + "}";
    return name + in_parentheses(a);
  }
  std::string binary(const std::string& a, char sign, const std::string& b) const override {
    return a + " " + sign + " " + b;
  }
  std::string product(const std::string& a, const std::string& b, bool numbers) const override {
    return a + (numbers ? " \\cdot " : " \\, ") + b;
  }
  std::string negative(const std::string& a) const override { return "-" + a; }

 private:
  static std::string dotted(const std::string& a, int dots) {
    return dots == 0 ? a : (dots == 1 ? "\\dot{" : "\\ddot{") + a + "}";
  }
};

class MathMl : public Language {
 public:
  std::string number(const std::string& digits) const override {
    const auto e = digits.find_first_of("eE");
    if (e == std::string::npos) return "<mn>" + digits + "</mn>";
    const std::string power =
        "<msup><mn>10</mn><mn>" + std::to_string(std::stol(digits.substr(e + 1))) + "</mn></msup>";
    const std::string mantissa = digits.substr(0, e);
    return mantissa == "1" ? power : product("<mn>" + mantissa + "</mn>", power, true);
  }
  std::string letter(const Letter& letter) const override {
    const std::string base = dotted("<mi>" + letter.mathml + "</mi>", letter.dots);
    if (letter.subscript.empty()) return base;
    return "<msub>" + base + "<mi>" + letter.subscript + "</mi></msub>";
  }
  std::string upright(const std::string& name, int dots) const override {
    return dotted("<mi mathvariant=\"normal\">" + name + "</mi>", dots);
  }
  std::string in_parentheses(const std::string& a) const override {
    return "<mrow><mo>(</mo>" + a + "<mo>)</mo></mrow>";
  }
  std::string fraction(const std::string& a, const std::string& b) const override {
    return "<mfrac>" + row(a) + row(b) + "</mfrac>";
  }
  std::string power(const std::string& a, const std::string& b) const override {
    return "<msup>" + row(a) + row(b) + "</msup>";
  }
  std::string root(const std::string& a) const override { return "<msqrt>" + row(a) + "</msqrt>"; }
  std::string call(const std::string& function, const std::string& a) const override {
    return "<mrow><mi>" + function + "</mi>" + in_parentheses(a) + "</mrow>";
  }
  std::string binary(const std::string& a, char sign, const std::string& b) const override {
    return a + "<mo>" + (sign == '-' ? "&#8722;" : std::string(1, sign)) + "</mo>" + b;
  }
  std::string product(const std::string& a, const std::string& b, bool numbers) const override {
    return a + (numbers ? "<mo>&#8901;</mo>" : "<mo rspace=\"0.17em\">&#8290;</mo>") + b;
  }
  std::string negative(const std::string& a) const override {
    return "<mrow><mo>&#8722;</mo>" + a + "</mrow>";
  }

 private:
  static std::string row(const std::string& a) { return "<mrow>" + a + "</mrow>"; }
  static std::string dotted(const std::string& a, int dots) {
    if (dots == 0) return a;
    return "<mover>" + a + "<mo>" + (dots == 1 ? "&#729;" : "&#168;") + "</mo></mover>";
  }
};

// A rendered sub-term and how tightly it holds together.
struct Rendered {
  enum Strength { kSum, kProduct, kFraction, kPower, kAtom };
  std::string text;
  Strength strength = kAtom;
  bool negative = false;      // begins with a minus
  bool first_number = false;  // begins with a digit
  bool last_number = false;   // ends with one
};

class Renderer {
 public:
  Renderer(const Language& language, const Effect& effect) : language_(language) {
    for (const Coordinate& coordinate : effect.coordinates) dotted_.insert(coordinate.name);
    for (const SignalChannel& signal : effect.signals) dotted_.insert(signal.name);
    for (const EffectParameter& parameter : effect.parameters) own_.insert(parameter.name);
    for (const Definition& definition : effect.definitions) own_.insert(definition.name);
  }

  std::string of(const Expression& expression) const {
    return render(parse_syntax(expression)).text;
  }

  std::string symbol(const std::string& name) const {
    const auto letter = letters().find(name);
    if (letter != letters().end() && !own_.contains(name)) return language_.letter(letter->second);
    const std::pair<std::string, int> endings[] = {{"_rate", 1}, {"_acceleration", 2}};
    for (const auto& [ending, dots] : endings) {
      if (!name.ends_with(ending)) continue;
      const std::string base = name.substr(0, name.size() - ending.size());
      if (dotted_.contains(base)) return language_.upright(base, dots);
    }
    return language_.upright(name, 0);
  }

 private:
  std::string held(const Rendered& part, Rendered::Strength strength) const {
    return part.strength < strength ? language_.in_parentheses(part.text) : part.text;
  }

  Rendered render(const SyntaxNode& node) const {
    switch (node.kind) {
      case SyntaxNode::kNumber:
        return {language_.number(node.name), Rendered::kAtom, false, true, true};
      case SyntaxNode::kName:
        return {symbol(node.name), Rendered::kAtom};
      case SyntaxNode::kCall: {
        const std::string argument = render(node.operands[0]).text;
        return {node.name == "sqrt" ? language_.root(argument)
                                    : language_.call(node.name, argument)};
      }
      case SyntaxNode::kNegate: {
        const Rendered operand = render(node.operands[0]);
        const std::string text = operand.negative ? language_.in_parentheses(operand.text)
                                                  : held(operand, Rendered::kProduct);
        return {language_.negative(text), Rendered::kProduct, true};
      }
      case SyntaxNode::kAdd:
      case SyntaxNode::kSubtract:
        return sum(node);
      case SyntaxNode::kMultiply:
        return product(node);
      case SyntaxNode::kDivide: {
        const Rendered above = render(node.operands[0]), below = render(node.operands[1]);
        return {language_.fraction(above.text, below.text), Rendered::kFraction};
      }
      case SyntaxNode::kPower: {
        const Rendered base = render(node.operands[0]), exponent = render(node.operands[1]);
        return {language_.power(held(base, Rendered::kAtom), exponent.text), Rendered::kPower};
      }
    }
    return {};
  }

  Rendered sum(const SyntaxNode& node) const {
    const Rendered left = render(node.operands[0]), right = render(node.operands[1]);
    const bool minus = node.kind == SyntaxNode::kSubtract;
    const bool enclose = right.negative || (minus && right.strength == Rendered::kSum);
    return {language_.binary(left.text, minus ? '-' : '+',
                             enclose ? language_.in_parentheses(right.text) : right.text),
            Rendered::kSum, left.negative};
  }

  Rendered product(const SyntaxNode& node) const {
    const Rendered left = render(node.operands[0]), right = render(node.operands[1]);
    const std::string second =
        right.negative ? language_.in_parentheses(right.text) : held(right, Rendered::kProduct);
    return {language_.product(held(left, Rendered::kProduct), second,
                              left.last_number && right.first_number),
            Rendered::kProduct, left.negative && left.strength >= Rendered::kProduct,
            left.first_number, right.last_number};
  }

  const Language& language_;
  std::set<std::string> own_;
  std::set<std::string> dotted_;  // names whose _rate and _acceleration are derivatives
};

const char* place_words(Place place) {
  switch (place) {
    case Place::kJoint:
      return ", at every joint";
    case Place::kPivot:
      return ", at the pivot";
    case Place::kLink:
      return ", on every link";
    case Place::kLinkCentre:
      return ", at the middle of every link";
    case Place::kLoad:
      return ", at the load";
    case Place::kChord:
      return ", along the chord";
    case Place::kAnywhere:
      return "";
  }
  return "";
}

class Formulas {
 public:
  explicit Formulas(const Effect& effect)
      : latex_renderer_(latex_, effect), mathml_renderer_(mathml_, effect) {}

  // what: left = right
  void add(const std::string& what, const Letter& left, const Expression& right) {
    if (right.given()) add(what, latex_.letter(left), mathml_.letter(left), right);
  }

  void add(const std::string& what, const std::string& left, const Expression& right,
           int dots = 0) {
    if (right.given()) {
      add(what, latex_.upright(left, dots), mathml_.upright(left, dots), right);
    }
  }

  std::vector<Formula> take() { return std::move(formulas_); }

 private:
  void add(const std::string& what, const std::string& latex_left, const std::string& mathml_left,
           const Expression& right) {
    formulas_.push_back(
        {what, latex_left + " = " + latex_renderer_.of(right),
         "<math>" + mathml_left + "<mo>=</mo>" + mathml_renderer_.of(right) + "</math>"});
  }

  const Latex latex_;
  const MathMl mathml_;
  Renderer latex_renderer_, mathml_renderer_;
  std::vector<Formula> formulas_;
};

Letter subscripted(const std::string& letter, const std::string& subscript) {
  return {letter, letter, subscript, 0};
}

}  // namespace

std::vector<Formula> formulas(const Effect& effect) {
  Formulas all(effect);
  for (const Definition& definition : effect.definitions) {
    all.add(std::string("With") + place_words(definition.at), definition.name, definition.value);
  }
  const std::string flow = "Velocity of the fluid, ";
  all.add(flow + "side", subscripted("w", "s"), effect.flow.side);
  all.add(flow + "down", subscripted("w", "d"), effect.flow.down);
  all.add(flow + "across", subscripted("w", "a"), effect.flow.across);
  for (const ForceTerm& force : effect.forces) {
    const std::string what =
        std::string(force.per_length ? "Force per length" : "Force") + place_words(force.at);
    const std::string letter = force.per_length ? "f" : "F";
    all.add(what, subscripted(letter, "s"), force.side);
    all.add(what, subscripted(letter, "d"), force.down);
    all.add(what, subscripted(letter, "a"), force.across);
    all.add(what, subscripted(letter, "n"), force.normal);
    all.add(what, subscripted(letter, "t"), force.tangential);
    all.add(what + ", along a velocity", subscripted(letter, "v"), force.value);
    all.add("This velocity", subscripted("v", letter), force.along);
  }
  static const std::map<ScalarKind, std::pair<const char*, const char*>> scalars = {
      {ScalarKind::kTorque, {"Torque", "\\tau"}},
      {ScalarKind::kPotential, {"Potential", "V"}},
      {ScalarKind::kDissipation, {"Dissipation", "D"}},
      {ScalarKind::kKinetic, {"Kinetic energy", "T"}}};
  for (const ScalarTerm& term : effect.scalars) {
    const auto& [word, letter] = scalars.at(term.kind);
    const std::string what =
        std::string(word) + (term.per_length ? " per length" : "") + place_words(term.at);
    const std::string mathml = term.kind == ScalarKind::kTorque ? "&#964;" : letter;
    all.add(what, Letter{letter, mathml, "", 0}, term.value);
  }
  for (const ExtraState& state : effect.states) {
    all.add(std::string("State") + place_words(state.at), state.name, state.rate, 1);
  }
  for (const EventValue& event : effect.events) {
    all.add(std::string("Event, where it changes its sign") + place_words(event.at), event.name,
            event.value);
  }
  all.add("Motion of the support to the side", subscripted("r", "s"), effect.support.side);
  all.add("Motion of the support downwards", subscripted("r", "d"), effect.support.down);
  all.add("Motion of the support across", subscripted("r", "a"), effect.support.across);
  const std::string clamp = "Direction of the clamp, ";
  all.add(clamp + "side", subscripted("e", "s"), effect.support.clamp_side);
  all.add(clamp + "down", subscripted("e", "d"), effect.support.clamp_down);
  all.add(clamp + "across", subscripted("e", "a"), effect.support.clamp_across);
  const std::string bend_axis = "Axis of rest angles, ";
  all.add(bend_axis + "side", subscripted("a", "s"), effect.support.bend_axis_side);
  all.add(bend_axis + "down", subscripted("a", "d"), effect.support.bend_axis_down);
  all.add(bend_axis + "across", subscripted("a", "a"), effect.support.bend_axis_across);
  const int link = effect.held_end.link;
  const std::string end = link > 0 ? "Held far end of link " + std::to_string(link) + ", "
                                   : std::string("Held end, "),
                    end_clamp = "Direction of the clamp at the held end, ";
  all.add(end + "side", subscripted("h", "s"), effect.held_end.side);
  all.add(end + "down", subscripted("h", "d"), effect.held_end.down);
  all.add(end + "across", subscripted("h", "a"), effect.held_end.across);
  all.add(end_clamp + "side", subscripted("c", "s"), effect.held_end.clamp_side);
  all.add(end_clamp + "down", subscripted("c", "d"), effect.held_end.clamp_down);
  all.add(end_clamp + "across", subscripted("c", "a"), effect.held_end.clamp_across);
  all.add("Stiffness of the clamp at the held end", "k", effect.held_end.clamp_stiffness);
  all.add("Damping of the clamp at the held end", "c", effect.held_end.clamp_damping);
  all.add("Torsional stiffness GJ", "torsional_stiffness", effect.held_end.torsional_stiffness);
  all.add("Roll of the held end", "roll", effect.held_end.roll);
  all.add("The chord begins at the arc length", subscripted("s", "1"), effect.chord.from);
  all.add("The chord ends at the arc length", subscripted("s", "2"), effect.chord.to);
  const Kinematics& kinematics = effect.kinematics;
  all.add("Mass centre past mid-link", "centre_offset", kinematics.centre_offset);
  all.add("Load past the end of the last link", "load_offset", kinematics.load_offset);
  const std::string load = "Load from the end of the last link, ";
  all.add(load + "side", subscripted("d", "s"), kinematics.load_side);
  all.add(load + "down", subscripted("d", "d"), kinematics.load_down);
  all.add(load + "across", subscripted("d", "a"), kinematics.load_across);
  all.add("Inertia of the load", subscripted("I", "c"), kinematics.load_inertia);
  all.add("Added to the load", "load_mass", kinematics.load_mass);
  const Letter rest = {"\\varphi", "&#966;", "0", 0};
  all.add("Rest angle, of every joint", rest, kinematics.rest_angle);
  all.add("Rest angle, of the pivot", rest, kinematics.pivot_rest_angle);
  all.add("Added to the length of every link", "extension", kinematics.extension);
  all.add("Gravity turned towards side", "gravity_tilt", kinematics.gravity_tilt);
  all.add("Reported", "side", effect.sensor.side);
  all.add("Reported", "down", effect.sensor.down);
  all.add("Reported", "across", effect.sensor.across);
  all.add("Reported", "angle", effect.sensor.angle);
  all.add("Model time of what was recorded", "clock", effect.sensor.clock);
  return all.take();
}

}  // namespace catena
