// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/latex_document.hpp"

#include <algorithm>
#include <functional>
#include <string_view>

#include "description/formula.hpp"
#include "generator/derivation/chain.hpp"
#include "generator/emission/latex_polynomial.hpp"

namespace catena {

using GiNaC::ex;

namespace {

constexpr std::size_t kLineWidth = 80;  // letters that fit into a line of mathematics, about
constexpr std::size_t kNarrower = 6;    // by what the name of an effect takes on the left

// What formulas (description/formula.hpp) write for what effects are made of
const char* const kLettersOfEffects =
    "In the formulas of effects, $\\varphi$ is the angle of a joint, the difference of those of "
    "its\n"
    "links; $r$, $v$, $f$ and $F$ are position, velocity, force per length and force of the point\n"
    "named, with index $s$ towards side, $d$ downwards, $n$ across and $t$ along the link; $\\tau$ "
    "is a\n"
    "torque, $V$ a potential, $D$ a dissipation function, $T$ a kinetic energy, $s$ the length of\n"
    "cable from the support, $\\Delta$ the length a joint stands for, $r_g$ the depth along\n"
    "gravity, $t$ the time. All else carries its effect's own name.\n";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '_':
      case '&':
      case '%':
      case '#':
      case '$':
      case '{':
      case '}':
        result += std::string("\\") + c;
        break;
      case '^':
        result += "\\^{}";
        break;
      case '~':
        result += "\\~{}";
        break;
      case '\\':
        result += "\\textbackslash{}";
        break;
      case '|':
        result += "\\textbar{}";
        break;
      case '<':
        result += "\\textless{}";
        break;
      case '>':
        result += "\\textgreater{}";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// "left ={}& a + b \\ & + c": as many terms on a line as fit
std::string equation(const std::string& left, const std::vector<LatexTerm>& terms,
                     std::size_t width = kLineWidth) {
  std::string text = left + " ={}& ";
  std::string line;
  for (const LatexTerm& term : terms) {
    const std::string shown = &term == &terms.front() ? joined_terms({term}) : with_sign(term);
    if (!line.empty() && latex_width(line) + latex_width(shown) > width) {
      text += line + " \\\\\n  & ";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + shown;
  }
  return text + (terms.empty() ? "0" : line);
}

std::string display(const std::vector<std::string>& equations) {
  std::string text = "\\begin{align*}\n";
  for (std::size_t i = 0; i < equations.size(); ++i) {
    text += "  " + equations[i] + (i + 1 < equations.size() ? " \\\\\n" : "\n");
  }
  return text + "\\end{align*}\n";
}

std::string matrix(const std::string& left, std::size_t rows, std::size_t columns,
                   const std::function<std::string(std::size_t, std::size_t)>& entry) {
  std::string text = left + " = \\begin{bmatrix}\n";
  for (std::size_t i = 0; i < rows; ++i) {
    text += "    ";
    for (std::size_t j = 0; j < columns; ++j) text += (j > 0 ? " & " : "") + entry(i, j);
    text += i + 1 < rows ? " \\\\\n" : "\n";
  }
  return text + "  \\end{bmatrix}\n";
}

std::string in_document(const LatexEquations& equations) {
  return escaped(equations.words) + "\n" +
         (equations.aligned ? equations.latex : "\\[\n  " + equations.latex + "\\]\n") + "\n";
}

void append(std::vector<LatexEquations>& to, const std::vector<LatexEquations>& more) {
  to.insert(to.end(), more.begin(), more.end());
}

std::string number(std::size_t i) { return std::to_string(i + 1); }

class Document {
 public:
  Document(const Description& description, int links) : description_(description), links_(links) {
    for (const Effect& effect : description.effects) {
      const auto name = [&](const std::string& own, const std::string& ending) {
        const bool once = ending == "_dot" || ending == "_rate";
        names_[effect.id + "_" + own + ending] = shown(effect, own,
                                                       ending.empty() ? ""
                                                       : once         ? "\\dot"
                                                                      : "\\ddot");
      };
      for (const EffectParameter& parameter : effect.parameters) name(parameter.name, "");
      for (const ExtraState& state : effect.states) name(state.name, "");
      for (const Coordinate& coordinate : effect.coordinates) {
        for (const char* ending : {"", "_dot", "_ddot"}) name(coordinate.name, ending);
      }
      for (const SignalChannel& signal : effect.signals) {
        for (const char* ending : {"", "_rate", "_acceleration"}) name(signal.name, ending);
      }
    }
  }

  /// In this order only: what is abbreviated is explained where it first stands.
  std::vector<LatexEquations> chain() {
    std::vector<LatexEquations> found;
    lagrangian(found);
    found.push_back({"and its equations of motion are", euler_lagrange()});
    matrix_equation(found);
    inertia(found);
    joint_matrices(found);
    vectors(found);
    return found;
  }

  std::vector<LatexEquations> generalised_forces(const Effect& effect) {
    if (!has_generalised_force(effect)) return {};
    Chain chain(description_, links_, effect.id);
    const LatexPolynomial latex(chain.definitions(), names_, abbreviations_);
    std::vector<std::string> equations;
    for (std::size_t i = 0; i < chain.residual().size(); ++i) {
      equations.push_back(equation(generalised_force(effect, i), latex.terms(-chain.residual()[i]),
                                   kLineWidth - kNarrower));
    }
    std::vector<LatexEquations> found = {
        {"The generalised forces of " + effect.id + " are", display(equations)}};
    append(found, with());
    return found;
  }

  std::string text() {
    std::string text =
        "\\section{" + std::to_string(links_) + (links_ == 1 ? " link" : " links") + "}\n\n";
    for (const LatexEquations& equations : chain()) text += in_document(equations);
    for (const Effect& effect : description_.effects) text += effect_text(effect);
    return text;
  }

 private:
  // \mathinner has a space to what stands beside it, as a name of several letters needs. The effect
  // is named where two have a quantity of this name.
  std::string shown(const Effect& effect, const std::string& own, const std::string& dot) const {
    const auto has_it = [&](const Effect& other) {
      const auto named = [&](const auto& list) {
        return std::any_of(list.begin(), list.end(),
                           [&](const auto& quantity) { return quantity.name == own; });
      };
      return named(other.parameters) || named(other.states) || named(other.coordinates) ||
             named(other.signals);
    };
    const auto count =
        std::count_if(description_.effects.begin(), description_.effects.end(), has_it);
    const std::string name = escaped(count > 1 ? effect.id + "." + own : own);
    const std::string upright = "\\mathrm{" + name + "}";
    return "\\mathinner{" + (dot.empty() ? upright : dot + "{" + upright + "}") + "}";
  }

  std::string coordinate(std::size_t i, const std::string& dot = "") const {
    const auto n = static_cast<std::size_t>(links_);
    if (i < n) return dot + "{\\theta}_{" + number(i) + "}";
    std::size_t k = i - n;
    for (const Effect& effect : description_.effects) {
      for (const Coordinate& own : effect.coordinates) {
        if (own.at == Place::kLoad) continue;
        if (k < n) return shown(effect, own.name, dot) + "_{" + number(k) + "}";
        k -= n;
      }
    }
    for (const Effect& effect : description_.effects)
      for (const Coordinate& own : effect.coordinates)
        if (own.at == Place::kLoad && k-- == 0) return shown(effect, own.name, dot);
    return "";
  }

  bool has_generalised_force(const Effect& effect) const {
    return !effect.forces.empty() || !effect.scalars.empty();
  }

  // The energies of the chain itself; those of effects follow with them.
  void lagrangian(std::vector<LatexEquations>& found) {
    Chain chain(description_, links_);
    const LatexPolynomial latex(chain.definitions(), names_, abbreviations_);
    std::vector<LatexTerm> terms;
    const auto add = [&](const ex& energy) {
      for (const LatexTerm& term : latex.terms(energy)) terms.push_back(term);
    };
    ex kinetic = 0, gravity = 0;
    std::vector<LatexTerm> elastic;
    for (const EnergyItem& item : chain.energies()) {
      for (const ex& part : item.parts) {
        if (item.name == "kinetic") kinetic += part;
        if (item.name == "gravity") gravity += part;
        if (item.name == "joint_elastic") elastic.push_back(spring(chain, latex, part));
      }
    }
    add(kinetic);
    terms.insert(terms.end(), elastic.begin(), elastic.end());
    add(-gravity);
    found.push_back({"The Lagrangian is", display({equation("L", terms)})});
    append(found, with());
  }

  // - 1/2 k_i (theta_i - theta_{i-1})^2: the square stays one
  static LatexTerm spring(Chain& chain, const LatexPolynomial& latex, const ex& energy) {
    for (const int k : chain.definitions().symbols_of(energy)) {
      const Symbol& angle = chain.definitions()[k];
      if (angle.family != "joint_angle") continue;
      LatexStyle style;
      style.leading_link = angle.index;
      std::vector<LatexTerm> terms = latex.terms(angle.value, style);
      std::stable_partition(terms.begin(), terms.end(),
                            [](const LatexTerm& term) { return !term.negative; });
      const std::string inside = joined_terms(terms);
      const std::string stiffness = "k_{" + std::to_string(angle.index) + "}";
      const bool alone = GiNaC::is_a<GiNaC::symbol>(latex.written_out(angle.value));
      return {true, "\\frac{1}{2} " + stiffness + " " +
                        (alone ? inside : "\\left(" + inside + "\\right)") + "^{2}"};
    }
    return {true, "\\frac{1}{2} " + latex.of(2 * energy)};
  }

  std::string euler_lagrange() {
    Chain friction(description_, links_, "friction");
    const LatexPolynomial latex(friction.definitions(), names_, abbreviations_);
    std::vector<std::string> equations;
    for (std::size_t i = 0; i < friction.coordinates().size(); ++i) {
      const std::string q = coordinate(i), own = torque(i);
      const ex force = -friction.residual()[i];
      LatexStyle by_coefficient;
      by_coefficient.by_coefficient = true;
      by_coefficient.leading_link = static_cast<int>(i) + 1;
      std::vector<LatexTerm> first, second;
      if (!own.empty()) first.push_back({false, own});
      second = first;
      for (const LatexTerm& term : latex.terms(force, by_coefficient)) first.push_back(term);
      for (const LatexTerm& term : latex.terms(force)) second.push_back(term);
      for (const Effect& effect : description_.effects) {
        if (has_generalised_force(effect)) first.push_back({false, generalised_force(effect, i)});
      }
      std::string text = "\\frac{d}{dt} \\left(\\frac{\\partial L}{\\partial " +
                         coordinate(i, "\\dot") + "}\\right) - \\frac{\\partial L}{\\partial " + q +
                         "}";
      text = equation(text, first);
      if (description_.effects.empty() && second != first) {
        text += " \\\\\n  ={}& " + joined_terms(second);
      }
      equations.push_back(text);
    }
    return display(equations);
  }

  std::string torque(std::size_t i) const {
    return i < static_cast<std::size_t>(links_) ? "T_{\\theta_" + number(i) + "}" : "";
  }

  std::string generalised_force(const Effect& effect, std::size_t i) const {
    return "Q^{\\mathrm{" + escaped(effect.id) + "}}_{" + number(i) + "}";
  }

  void matrix_equation(std::vector<LatexEquations>& found) {
    std::string text =
        "M(\\vec{\\theta}) \\ddot{\\vec{\\theta}} + C "
        "\\dot{\\vec{\\theta}} + K \\vec{\\theta} + \\vec{F}(\\vec{\\theta}, "
        "\\dot{\\vec{\\theta}}) + \\vec{G}(\\vec{\\theta}) = \\vec{T}";
    for (const Effect& effect : description_.effects) {
      if (has_generalised_force(effect))
        text += " + \\vec{Q}^{\\mathrm{" + escaped(effect.id) + "}}";
    }
    rest_moments();
    if (!rest_.empty()) text += " + \\vec{E}";
    found.push_back({"Worked out, they read", text + "\n", false});
    const std::string all = coordinates_in_order();
    if (!all.empty()) found.push_back({"where the coordinates are", all, false});
  }

  void inertia(std::vector<LatexEquations>& found) {
    Chain chain(description_, links_, "kinetic");
    const LatexPolynomial latex(chain.definitions(), names_, abbreviations_);
    const std::size_t n = chain.coordinates().size();
    found.push_back({"with the symmetric mass matrix",
                     matrix("M", n, n,
                            [](std::size_t i, std::size_t j) {
                              return "M_{" + number(i) + (i > 8 || j > 8 ? "," : "") + number(j) +
                                     "}";
                            }),
                     false});
    std::vector<std::string> equations;
    for (std::size_t i = 0; i < n; ++i) {
      const ex row = latex.written_out(chain.residual()[i]);
      for (std::size_t j = 0; j < n; ++j) {
        const std::string comma = i > 8 || j > 8 ? "," : "";
        const std::string left = "M_{" + number(i) + comma + number(j) + "}";
        if (j < i) {
          equations.push_back(left + " ={}& M_{" + number(j) + comma + number(i) + "}");
          continue;
        }
        const ex entry = row.coeff(chain.accelerations()[j]).expand();
        LatexStyle style;
        style.order = i == j ? LatexStyle::kMassesFirst : LatexStyle::kLengthsFirst;
        style.inertia_last = i == j;
        equations.push_back(equation(left, latex.terms(entry, style)));
      }
      moving_.push_back(row.subs(no_accelerations(chain), GiNaC::subs_options::no_pattern));
    }
    found.push_back({"whose entries are", display(equations)});
    append(found, with());
    LatexStyle lengths_first;
    lengths_first.order = LatexStyle::kLengthsFirst;
    coriolis_ = {{"", column(chain, moving_, latex, "f", lengths_first)}};
    append(coriolis_, with());
  }

  // "x_{1}, \dots, x_{n}"
  std::string numbered(const std::string& name) const {
    const std::string last = name + "_{" + std::to_string(links_) + "}";
    if (links_ == 1) return last;
    return name + "_{1}, " + (links_ == 2 ? "" : "\\dots, ") + last;
  }

  // Where the coordinates are not the angles alone
  std::string coordinates_in_order() const {
    std::string own, of_load;
    for (const Effect& effect : description_.effects) {
      for (const Coordinate& coordinate : effect.coordinates) {
        const std::string name = shown(effect, coordinate.name, "");
        if (coordinate.at == Place::kLoad)
          of_load += ", " + name;
        else
          own += ", " + numbered(name);
      }
    }
    own += of_load;
    if (own.empty()) return "";
    return "\\vec{\\theta} = (" + numbered("\\theta") + own + ")\n";
  }

  static GiNaC::exmap no_accelerations(const Chain& chain) {
    GiNaC::exmap still;
    for (const ex& a : chain.accelerations()) still[a] = 0;
    return still;
  }

  std::string column(const Chain& chain, const std::vector<ex>& rows, const LatexPolynomial& latex,
                     const std::string& letter, const LatexStyle& style) const {
    std::vector<std::string> equations;
    for (std::size_t i = 0; i < chain.coordinates().size(); ++i) {
      equations.push_back(equation(letter + "_{" + number(i) + "}", latex.terms(rows[i], style)));
    }
    return display(equations);
  }

  // C and K, read off the friction and elastic terms
  void joint_matrices(std::vector<LatexEquations>& found) {
    const auto read = [&](const char* letter, const char* term) {
      Chain chain(description_, links_, term);
      const LatexPolynomial latex(chain.definitions(), names_, abbreviations_);
      const auto& variables = term == std::string("elastic") ? chain.coordinates() : chain.rates();
      return matrix(letter, variables.size(), variables.size(), [&](std::size_t i, std::size_t j) {
        return latex.of(latex.written_out(chain.residual()[i]).coeff(variables[j]));
      });
    };
    found.push_back({"The damping matrix is", read("C", "friction"), false});
    found.push_back({"and the stiffness matrix", read("K", "elastic"), false});
  }

  // K theta less the elastic moments: what the angles at rest add
  void rest_moments() {
    Chain chain(description_, links_, "elastic");
    const LatexPolynomial latex(chain.definitions(), names_, abbreviations_);
    std::vector<ex> rows;
    for (const ex& row : chain.residual()) {
      GiNaC::exmap straight;
      for (const ex& q : chain.coordinates()) straight[q] = 0;
      rows.push_back(-latex.written_out(row).subs(straight, GiNaC::subs_options::no_pattern));
    }
    const bool any =
        std::any_of(rows.begin(), rows.end(), [](const ex& e) { return !e.is_zero(); });
    if (!any) return;
    rest_ = {
        {"those of the moments of the joints' rest angles", column(chain, rows, latex, "e", {})}};
    append(rest_, with());
  }

  void vectors(std::vector<LatexEquations>& found) {
    Chain chain(description_, links_, "gravity");
    const LatexPolynomial latex(chain.definitions(), names_, abbreviations_);
    const bool support = std::any_of(
        description_.effects.begin(), description_.effects.end(), [](const Effect& effect) {
          return effect.support.side.given() || effect.support.down.given();
        });
    coriolis_.front().words =
        "The components of the Coriolis and centrifugal vector" +
        std::string(support ? ", with the inertia forces of the support's motion," : "") + " are";
    append(found, coriolis_);
    found.push_back(
        {"those of the vector of gravity", column(chain, chain.residual(), latex, "g", {})});
    append(found, with());
    append(found, rest_);
    found.push_back(
        {"and the external torques",
         matrix("\\vec{T}", chain.coordinates().size(), 1,
                [&](std::size_t i, std::size_t) { return torque(i).empty() ? "0" : torque(i); }),
         false});
  }

  std::string effect_text(const Effect& effect) {
    std::string text = "\\subsection*{" + escaped(effect.title) + " (\\texttt{" +
                       escaped(effect.id) + "})}\n\n" + escaped(effect.description) + "\n\n";
    for (const Formula& formula : formulas(effect)) {
      text += "\\noindent " + formula.what + ":\n\\[\n  " + formula.latex + "\n\\]\n";
    }
    for (const LatexEquations& forces : generalised_forces(effect)) text += in_document(forces);
    return text + "\n";
  }

  // What has been abbreviated since the last time
  std::vector<LatexEquations> with() {
    std::vector<std::string> equations;
    for (; explained_ < abbreviations_.entries.size(); ++explained_) {
      const LatexAbbreviations::Entry& entry = abbreviations_.entries[explained_];
      equations.push_back(equation(entry.name + (entry.squared ? "^{2}" : ""), entry.terms));
    }
    if (equations.empty()) return {};
    return {{"with", display(equations)}};
  }

  const Description& description_;
  int links_;
  LatexNames names_;
  LatexAbbreviations abbreviations_;
  std::size_t explained_ = 0;  // of them
  std::vector<ex> moving_;
  std::vector<LatexEquations> coriolis_, rest_;
};

}  // namespace

std::vector<LatexEquations> derived_equations(const Description& description, int links) {
  Document document(description, links);
  std::vector<LatexEquations> found = document.chain();
  for (const Effect& effect : description.effects) {
    append(found, document.generalised_forces(effect));
  }
  return found;
}

std::string latex_document(const Description& description, const std::vector<int>& links) {
  std::string text =
      "% Written by catena-derive. Do not edit: change the model description and derive again.\n"
      "\\documentclass[a4paper]{article}\n"
      "\\usepackage{amsmath}\n"
      "\\allowdisplaybreaks\n"
      "\\setcounter{MaxMatrixCols}{" +
      std::to_string(3 * kMostLatexLinks) +
      "}\n"
      "\\setlength{\\textwidth}{17cm}\n"
      "\\setlength{\\oddsidemargin}{-0.5cm}\n"
      "\\title{Equations of motion: " +
      escaped(description.id) +
      "}\n"
      "\\author{}\n\\date{}\n\n"
      "\\begin{document}\n\\maketitle\n\n"
      "$\\theta_i$ is the angle of link $i$ from the downward vertical; $l_i$, $m_i$, $I_{R_i}$ "
      "its\n"
      "length, mass and rotational inertia about its own centre; $k_i$, $c_i$ stiffness and "
      "damping\n"
      "of joint $i$; $T_{\\theta_i}$ the external torque on $\\theta_i$; $m_c$ the load; $g$ "
      "gravity.\n";
  if (!description.effects.empty()) text += kLettersOfEffects;
  text += "\n";
  for (const int n : links) text += Document(description, n).text();
  return text + "\\end{document}\n";
}

}  // namespace catena
