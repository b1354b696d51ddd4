// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/evaluator.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <tuple>
#include <utility>

#include "generator/checking/lexer.hpp"

namespace catena {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

constexpr int kMostLinks = 1000;

struct Target {
  std::string_view name;
  Quantity quantity;
  std::size_t indices;
};
constexpr std::array<Target, 9> kTargets = {{{"L", Quantity::kLagrangian, 0},
                                             {"T", Quantity::kKinetic, 0},
                                             {"V", Quantity::kPotential, 0},
                                             {"D", Quantity::kDissipation, 0},
                                             {"M", Quantity::kMass, 2},
                                             {"C", Quantity::kDamping, 2},
                                             {"K", Quantity::kStiffness, 2},
                                             {"F", Quantity::kCoriolis, 1},
                                             {"G", Quantity::kGravity, 1}}};

const Target* target_named(const std::string& name) {
  for (const Target& target : kTargets)
    if (target.name == name) return &target;
  return nullptr;
}

using Family = std::vector<ex> ChainSymbols::*;
const std::map<std::string, Family>& families() {
  static const std::map<std::string, Family> table = {
      {"theta", &ChainSymbols::angle},         {"thetadot", &ChainSymbols::rate},
      {"thetaddot", &ChainSymbols::acceleration}, {"l", &ChainSymbols::length},
      {"m", &ChainSymbols::mass},              {"I", &ChainSymbols::inertia},
      {"k", &ChainSymbols::stiffness},         {"c", &ChainSymbols::damping},
      {"T", &ChainSymbols::torque}};
  return table;
}

using Function = ex (*)(const ex&);
const std::map<std::string, Function>& functions() {
  static const std::map<std::string, Function> table = {
      {"sin", [](const ex& x) -> ex { return GiNaC::sin(x); }},
      {"sen", [](const ex& x) -> ex { return GiNaC::sin(x); }},  // as the dissertation writes it
      {"cos", [](const ex& x) -> ex { return GiNaC::cos(x); }},
      {"tan", [](const ex& x) -> ex { return GiNaC::tan(x); }},
      {"asin", [](const ex& x) -> ex { return GiNaC::asin(x); }},
      {"acos", [](const ex& x) -> ex { return GiNaC::acos(x); }},
      {"atan", [](const ex& x) -> ex { return GiNaC::atan(x); }},
      {"sinh", [](const ex& x) -> ex { return GiNaC::sinh(x); }},
      {"cosh", [](const ex& x) -> ex { return GiNaC::cosh(x); }},
      {"tanh", [](const ex& x) -> ex { return GiNaC::tanh(x); }},
      {"asinh", [](const ex& x) -> ex { return GiNaC::asinh(x); }},
      {"exp", [](const ex& x) -> ex { return GiNaC::exp(x); }},
      {"log", [](const ex& x) -> ex { return GiNaC::log(x); }},
      {"ln", [](const ex& x) -> ex { return GiNaC::log(x); }},
      {"sqrt", [](const ex& x) -> ex { return GiNaC::sqrt(x); }},
      {"abs", [](const ex& x) -> ex { return GiNaC::abs(x); }},
      {"sign", [](const ex& x) -> ex { return GiNaC::csgn(x); }}};
  return table;
}

/// A name with the values of its subscripts.
struct Reference {
  std::string name;
  std::vector<int> indices;

  bool operator<(const Reference& other) const {
    return std::tie(name, indices) < std::tie(other.name, other.indices);
  }
  [[nodiscard]] std::string text() const {
    if (indices.empty()) return name;
    std::string result = name + "[";
    for (std::size_t i = 0; i < indices.size(); ++i)
      result += (i == 0 ? "" : ",") + std::to_string(indices[i]);
    return result + "]";
  }
};

struct Stored {
  ex value;
  Location at;
  std::vector<Location> overwritten;
};

class Evaluator {
 public:
  Evaluator(const std::string& file, std::optional<int> links)
      : file_(file), requested_links_(links) {}

  Derivation run(const Program& program) {
    for (const Statement& statement : program) execute(statement);
    mirror();
    collect();
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(Location at, const std::string& message) const {
    throw error_at(file_, at, message);
  }
  [[nodiscard]] int links() const { return result_.chain ? result_.chain->links : 0; }
  [[nodiscard]] bool scalar() const { return !result_.free_symbols.empty(); }

  // ---- statements ----

  void execute(const Statement& statement) {
    using Kind = Statement::Kind;
    const bool declares = statement.kind == Kind::kLinks || statement.kind == Kind::kSymbols ||
                          statement.kind == Kind::kPositive;
    if (!declares && !result_.chain && !scalar())
      fail(statement.at,
           "expected first 'links N' (a derivation of the chain) or 'symbols x, ...' (scalar "
           "identities)");
    switch (statement.kind) {
      case Kind::kLinks: return set_links(statement);
      case Kind::kSymbols:
      case Kind::kPositive: return declare(statement);
      case Kind::kSymmetric: return declare_symmetric(statement);
      case Kind::kGiven: return give(statement);
      case Kind::kAssign: return assign(statement);
      case Kind::kEquation: return equation(statement);
      case Kind::kIdentity: return identity(statement);
      case Kind::kFor:
        return over_range(statement.names[0], statement.expressions[0], statement.expressions[1],
                          statement.expressions.size() > 2 ? &statement.expressions[2] : nullptr,
                          [&] {
                            for (const Statement& inner : statement.block) execute(inner);
                          });
      case Kind::kIf:
        for (const Statement& inner :
             holds(statement.expressions[0]) ? statement.block : statement.otherwise)
          execute(inner);
        return;
    }
  }

  void set_links(const Statement& statement) {
    if (scalar()) fail(statement.at, "a scalar derivation (symbols ...) has no links");
    if (result_.chain) fail(statement.at, "the number of links is already set");
    result_.chain = std::make_unique<ChainSymbols>(1);  // so that the number may be an expression
    const int stated = integer(statement.expressions[0], "the number of links");
    const int number = requested_links_.value_or(stated);
    if (number < 1 || number > kMostLinks)
      fail(statement.at, "links = " + std::to_string(number) + "; must be from 1 to " +
                             std::to_string(kMostLinks));
    result_.chain = std::make_unique<ChainSymbols>(number);
  }

  void declare(const Statement& statement) {
    if (result_.chain)
      fail(statement.at, "free symbols belong to a scalar derivation; this one has links");
    for (const std::string& name : statement.names) {
      if (functions().count(name) != 0 || name == "pi")
        fail(statement.at, "'" + name + "' already has a meaning");
      if (result_.free_symbols.count(name) != 0)
        fail(statement.at, "'" + name + "' is declared twice");
      result_.free_symbols[name] = statement.kind == Statement::Kind::kPositive
                                       ? ex(GiNaC::possymbol(name))
                                       : ex(GiNaC::realsymbol(name));
    }
  }

  void declare_symmetric(const Statement& statement) {
    for (const std::string& name : statement.names) {
      const Target* target = target_named(name);
      if (target == nullptr || target->indices != 2)
        fail(statement.at, "'" + name + "' is no matrix; expected M, C or K");
      symmetric_.insert(name);
    }
  }

  void give(const Statement& statement) {
    if (!result_.chain) fail(statement.at, "'given' states a parameter of the chain; set links first");
    const Expression& target = statement.expressions[0];
    const ex parameter = read(target);
    if (!GiNaC::is_a<GiNaC::symbol>(parameter) || !result_.chain->is_constant(parameter))
      fail(target.at, "'given' expects a parameter: l_i, m_i, I_i, k_i, c_i, T_i, m_c or g");
    const ex value = evaluate(statement.expressions[1]);
    if (!result_.chain->is_constant(value))
      fail(statement.expressions[1].at, "the value of a parameter contains an angle or a rate");
    result_.given[parameter] = value;
  }

  void assign(const Statement& statement) {
    const Expression& target = statement.expressions[0];
    const Expression& value = statement.expressions[1];
    const Reference reference = resolve(target);
    check_assignable(target, reference);
    if (value.kind == Expression::Kind::kMatrix) return assign_matrix(reference, value);
    const Target* known = result_.chain ? target_named(reference.name) : nullptr;
    if (known != nullptr) {
      if (reference.indices.size() != known->indices)
        fail(target.at, known->indices == 0
                            ? reference.name + " is a scalar and has no entries"
                            : reference.name + " needs " + std::to_string(known->indices) +
                                  (known->indices == 1 ? " index" : " indices") +
                                  ", or a whole matrix in [ ]");
      for (const int index : reference.indices) check_range(target.at, reference, index, 1);
    }
    store(reference, evaluate(value), statement.at);
  }

  void check_assignable(const Expression& target, const Reference& reference) const {
    const std::string& name = reference.name;
    if (indices_.count(name) != 0)
      fail(target.at, "'" + name + "' is the index of a loop and cannot be assigned");
    const bool parameter =
        result_.chain && (name == "m_c" || name == "g" || name == "n" ||
                          (families().count(name) != 0 &&
                           !(name == "T" && reference.indices.empty())));
    if (parameter)
      fail(target.at, "'" + reference.text() +
                          "' is a symbol of the chain and cannot be assigned; to state a value "
                          "for a parameter write 'given'");
    if (name == "pi" || result_.free_symbols.count(name) != 0)
      fail(target.at, "'" + name + "' is a symbol and cannot be assigned");
    if (functions().count(name) != 0) fail(target.at, "'" + name + "' is a function");
  }

  void assign_matrix(const Reference& reference, const Expression& matrix) {
    const Target* known = result_.chain ? target_named(reference.name) : nullptr;
    if (known == nullptr || known->indices == 0 || !reference.indices.empty())
      fail(matrix.at, "only M, C, K, F and G can be given whole");
    std::vector<const Expression*> flat;
    bool square = matrix.children.size() == static_cast<std::size_t>(links());
    for (const Expression& row : matrix.children) {
      square = square && row.children.size() == static_cast<std::size_t>(links());
      for (const Expression& entry : row.children) flat.push_back(&entry);
    }
    const bool vector = flat.size() == static_cast<std::size_t>(links()) &&
                        (matrix.children.size() == 1 || matrix.children.size() == flat.size());
    if (known->indices == 2 ? !square : !vector)
      fail(matrix.at, reference.name + " has " + std::to_string(matrix.children.size()) +
                          " rows and " + std::to_string(flat.size()) + " entries; expected " +
                          std::to_string(links()) +
                          (known->indices == 2
                               ? " rows of as many entries (rows end with ;)"
                               : " entries"));
    for (std::size_t index = 0; index < flat.size(); ++index) {
      const int row = static_cast<int>(index) / (known->indices == 2 ? links() : 1) + 1;
      Reference entry{reference.name, {row}};
      if (known->indices == 2) entry.indices.push_back(static_cast<int>(index) % links() + 1);
      store(entry, evaluate(*flat[index]), flat[index]->at);
    }
  }

  void store(const Reference& reference, ex value, Location at) {
    const auto [found, created] = values_.try_emplace(reference);
    if (!created) found->second.overwritten.push_back(found->second.at);
    found->second.value = std::move(value);
    found->second.at = at;
  }

  void equation(const Statement& statement) {
    if (!result_.chain) fail(statement.at, "equations of motion belong to a chain; set links first");
    const int number = integer(statement.expressions[0], "the number of the equation");
    if (number < 1 || number > links())
      fail(statement.at, "equation " + std::to_string(number) + ": there are " +
                             std::to_string(links()) + " links");
    stated_.push_back({Quantity::kEquation, number, 0, "equation " + std::to_string(number),
                       evaluate(statement.expressions[1]), evaluate(statement.expressions[2]),
                       statement.at, {}});
  }

  void identity(const Statement& statement) {
    std::string label = statement.names[0];
    if (label.empty()) label = "identity, line " + std::to_string(statement.at.line);
    stated_.push_back({Quantity::kIdentity, 0, 0, label, evaluate(statement.expressions[0]),
                       evaluate(statement.expressions[1]), statement.at, {}});
  }

  // ---- what is checked ----

  void mirror() {
    for (const std::string& name : symmetric_) {
      std::map<Reference, Stored> mirrored;
      for (const auto& [reference, stored] : values_)
        if (reference.name == name)
          mirrored.emplace(Reference{name, {reference.indices[1], reference.indices[0]}}, stored);
      values_.merge(mirrored);  // keeps what is written
    }
  }

  void collect() {
    if (result_.chain) {
      for (const Target& target : kTargets) {
        for (const auto& [reference, stored] : values_) {
          if (reference.name != target.name) continue;
          const std::vector<int>& index = reference.indices;
          result_.entries.push_back({target.quantity, index.empty() ? 0 : index[0],
                                     index.size() < 2 ? 0 : index[1], reference.text(),
                                     stored.value, 0, stored.at, stored.overwritten});
        }
      }
    }
    for (Entry& entry : stated_) result_.entries.push_back(std::move(entry));
    std::stable_sort(
        result_.entries.begin(), result_.entries.end(),
        [](const Entry& a, const Entry& b) { return a.quantity < b.quantity; });
    if (result_.entries.empty())
      throw InputError(file_ + ": error: nothing to check; assign L, T, V, D, M, C, K, F or G, or "
                               "state an equation or identity");
  }

  // ---- names ----

  Reference resolve(const Expression& name) {
    Reference reference{name.text, {}};
    for (const Expression& index : name.children)
      reference.indices.push_back(integer(index, "an index"));
    if (!name.children.empty() || indices_.count(name.text) != 0 || name.text == "m_c" ||
        result_.free_symbols.count(name.text) != 0)
      return reference;
    const std::size_t split = name.text.rfind('_');
    if (split == std::string::npos) return reference;
    const std::string subscript = name.text.substr(split + 1);
    const auto bound = indices_.find(subscript);
    if (bound != indices_.end()) {
      reference.indices.push_back(bound->second);
    } else if (subscript == "n" && result_.chain) {
      reference.indices.push_back(links());
    } else if (subscript.find_first_not_of("0123456789") == std::string::npos) {
      if (subscript.size() > 6) fail(name.at, "the subscript of '" + name.text + "' is too large");
      reference.indices.push_back(std::stoi(subscript));
    } else {
      return reference;
    }
    reference.name = name.text.substr(0, split);
    return reference;
  }

  void check_range(Location at, const Reference& reference, int index, int lowest) const {
    if (index < lowest || index > links())
      fail(at, reference.text() + ": the index " + std::to_string(index) + " is not in " +
                   std::to_string(lowest) + ".." + std::to_string(links()) + " (there are " +
                   std::to_string(links()) + " links)");
  }

  ex read(const Expression& name) {
    const Reference reference = resolve(name);
    if (reference.indices.empty()) {
      const auto index = indices_.find(reference.name);
      if (index != indices_.end()) return index->second;
      if (reference.name == "pi") return GiNaC::Pi;
      const auto free = result_.free_symbols.find(reference.name);
      if (free != result_.free_symbols.end()) return free->second;
      if (result_.chain && reference.name == "n") return links();
      if (result_.chain && reference.name == "g") return result_.chain->gravity;
      if (result_.chain && reference.name == "m_c") return result_.chain->load_mass;
    } else if (result_.chain) {
      const auto family = families().find(reference.name);
      if (family != families().end()) return family_member(name.at, reference, family->second);
    }
    const auto stored = values_.find(reference);
    if (stored != values_.end()) return stored->second.value;
    return unset(name.at, reference);
  }

  ex family_member(Location at, const Reference& reference, Family family) const {
    if (reference.indices.size() != 1) fail(at, reference.text() + ": expected one index");
    const bool state = reference.name.rfind("theta", 0) == 0;  // theta_0 = 0, as in (2.9)
    check_range(at, reference, reference.indices[0], state ? 0 : 1);
    return ((*result_.chain).*family)[static_cast<std::size_t>(reference.indices[0])];
  }

  /// Entries of M, C, K, F and G count as 0 before they are set, and a note says so.
  ex unset(Location at, const Reference& reference) {
    const Target* target = result_.chain ? target_named(reference.name) : nullptr;
    if (target != nullptr && target->indices > 0 && target->indices == reference.indices.size()) {
      for (const int index : reference.indices) check_range(at, reference, index, 1);
      if (noted_.insert({at.line, at.column}).second)
        result_.notes.push_back("line " + std::to_string(at.line) + ": " + reference.text() +
                                " is read before it is set; unset entries are taken as 0");
      return 0;
    }
    if (target != nullptr && target->indices > 0)
      fail(at, "expected entries such as " + reference.name +
                   (target->indices == 2 ? "[1,2]" : "[1]"));
    if (result_.chain && families().count(reference.name) != 0)
      fail(at, "'" + reference.name + "' needs an index, as in " + reference.name + "_1");
    for (const auto& [known, stored] : values_)
      if (known.name == reference.name)
        fail(at, reference.text() + " is not set (but " + known.text() + " is)");
    fail(at, "unknown name '" + reference.text() + "'; expected " +
                 (result_.chain ? "theta_i, thetadot_i, thetaddot_i, l_i, m_i, I_i, k_i, c_i, T_i "
                                  "with an index in use, m_c, g, n, pi, "
                                : "a declared symbol, pi, ") +
                 "or a name assigned before");
  }

  // ---- expressions ----

  int integer(const Expression& expression, const std::string& what) {
    const ex value = evaluate(expression);
    if (!value.info(GiNaC::info_flags::integer)) fail(expression.at, what + " must be an integer");
    const numeric number = GiNaC::ex_to<numeric>(value);
    if (GiNaC::abs(number) > 1000000) fail(expression.at, what + " is too large");
    return number.to_int();
  }

  bool holds(const Expression& condition) {
    if (condition.kind == Expression::Kind::kNot) return !holds(condition.children[0]);
    if (condition.kind == Expression::Kind::kBinary) {
      const std::string& sign = condition.text;
      const auto& parts = condition.children;
      if (sign == "and") return holds(parts[0]) && holds(parts[1]);
      if (sign == "or") return holds(parts[0]) || holds(parts[1]);
      if (sign.size() == 2 || sign == "<" || sign == ">") {
        const numeric left = number(parts[0]), right = number(parts[1]);
        if (sign == "==") return left == right;
        if (sign == "!=") return left != right;
        if (sign == "<=") return left <= right;
        if (sign == ">=") return left >= right;
        return sign == "<" ? left < right : left > right;
      }
    }
    fail(condition.at, "expected a condition such as i == j or i < n");
  }

  numeric number(const Expression& expression) {
    const ex value = evaluate(expression);
    if (!GiNaC::is_a<numeric>(value) || !GiNaC::ex_to<numeric>(value).is_real())
      fail(expression.at, "expected a number (made of indices, n and constants)");
    return GiNaC::ex_to<numeric>(value);
  }

  void over_range(const std::string& index, const Expression& from, const Expression& to,
                  const Expression* condition, const std::function<void()>& body) {
    if (result_.free_symbols.count(index) != 0 || (result_.chain && index == "n"))
      fail(from.at, "'" + index + "' already has a meaning; choose another index");
    const int first = integer(from, "the start of a range");
    const int last = integer(to, "the end of a range");
    const auto outer = indices_.find(index);
    const std::optional<int> hidden =
        outer == indices_.end() ? std::nullopt : std::optional<int>(outer->second);
    for (int value = first; value <= last; ++value) {
      indices_[index] = value;
      if (condition == nullptr || holds(*condition)) body();
    }
    if (hidden) {
      indices_[index] = *hidden;
    } else {
      indices_.erase(index);
    }
  }

  ex evaluate(const Expression& expression) {
    using Kind = Expression::Kind;
    const auto& parts = expression.children;
    switch (expression.kind) {
      case Kind::kNumber: return exact_number(expression.text);
      case Kind::kName: return read(expression);
      case Kind::kCall: return call(expression);
      case Kind::kNegate: return -evaluate(parts[0]);
      case Kind::kBinary: return binary(expression);
      case Kind::kSum: {
        GiNaC::exvector terms;
        over_range(expression.text, parts[0], parts[1], parts.size() > 3 ? &parts[3] : nullptr,
                   [&] { terms.push_back(evaluate(parts[2])); });
        return GiNaC::add(terms);
      }
      case Kind::kConditional: return evaluate(holds(parts[0]) ? parts[1] : parts[2]);
      case Kind::kNot: fail(expression.at, "a condition is no value; write if ... then ... else ...");
      case Kind::kMatrix:
      case Kind::kRow: break;
    }
    fail(expression.at, "a matrix can only stand alone to the right of =");
  }

  /// Decimals are exact: 0.1 is 1/10.
  static numeric exact_number(const std::string& text) {
    std::string digits;
    long shift = 0;
    bool after_point = false;
    std::size_t i = 0;
    for (; i < text.size() && text[i] != 'e' && text[i] != 'E'; ++i) {
      if (text[i] == '.') {
        after_point = true;
      } else {
        digits += text[i];
        if (after_point) --shift;
      }
    }
    if (i < text.size()) shift += std::stol(text.substr(i + 1).substr(0, 6));
    const std::size_t first = std::min(digits.find_first_not_of('0'), digits.size() - 1);
    return numeric(digits.substr(first).c_str()) * GiNaC::pow(numeric(10), numeric(shift));
  }

  ex binary(const Expression& expression) {
    const std::string& sign = expression.text;
    if (sign != "+" && sign != "-" && sign != "*" && sign != "/" && sign != "^")
      fail(expression.at, "a condition is no value; write if ... then ... else ...");
    const ex left = evaluate(expression.children[0]);
    const ex right = evaluate(expression.children[1]);
    if (sign == "+") return left + right;
    if (sign == "-") return left - right;
    if (sign == "*") return left * right;
    if (sign == "/" && right.is_zero()) fail(expression.at, "division by zero");
    if (sign == "/") return left / right;
    if (left.is_zero() && !right.info(GiNaC::info_flags::positive))
      fail(expression.at, "0 raised to a power that is not a positive number");
    if (GiNaC::is_a<numeric>(right) && GiNaC::abs(GiNaC::ex_to<numeric>(right)) > 1000)
      fail(expression.at, "an exponent beyond 1000");
    return GiNaC::pow(left, right);
  }

  ex call(const Expression& call) {
    const std::string& name = call.text;
    const auto function = functions().find(name);
    if (function != functions().end()) {
      expect_arguments(call, 1, 1);
      const ex argument = evaluate(call.children[0]);
      try {
        return function->second(argument);
      } catch (const std::exception& error) {
        fail(call.at, name + " cannot be evaluated here: " + error.what());
      }
    }
    if (name == "max" || name == "min") return extreme(call);
    if (name == "ddt") {
      expect_arguments(call, 1, 1);
      if (!result_.chain) fail(call.at, "ddt (d/dt) belongs to a chain; use diff(y, x)");
      try {
        return result_.chain->time_derivative(evaluate(call.children[0]));
      } catch (const std::invalid_argument& error) {
        fail(call.at, error.what());
      }
    }
    if (name == "diff") return derivative(call);
    if (name == "at") {
      expect_arguments(call, 3, 3);
      return evaluate(call.children[0])
          .subs(variable(call.children[1]) == evaluate(call.children[2]),
                GiNaC::subs_options::no_pattern);
    }
    // M(i,j) is M[i,j], as the dissertation writes it.
    const bool known =
        result_.chain && (target_named(name) != nullptr || families().count(name) != 0);
    const bool assigned = std::any_of(values_.begin(), values_.end(), [&](const auto& value) {
      return value.first.name == name && !value.first.indices.empty();
    });
    if (!known && !assigned)
      fail(call.at, "unknown function '" + name +
                        "'; expected sin, cos, tan, asin, acos, atan, sinh, cosh, tanh, asinh, exp, "
                        "log, sqrt, abs, sign, max, min, sum, diff, at, ddt (write products with *)");
    Expression entry = call;
    entry.kind = Expression::Kind::kName;
    return read(entry);
  }

  void expect_arguments(const Expression& call, std::size_t least, std::size_t most) const {
    const std::size_t count = call.children.size();
    if (count < least || count > most)
      fail(call.at, call.text + " has " + std::to_string(count) + " arguments; expected " +
                        std::to_string(least) +
                        (most > least ? " or " + std::to_string(most) : std::string()));
  }

  ex extreme(const Expression& call) {
    numeric result = number(call.children[0]);
    for (const Expression& argument : call.children) {
      const numeric value = number(argument);
      if (call.text == "max" ? value > result : value < result) result = value;
    }
    return result;
  }

  ex variable(const Expression& expression) {
    const ex symbol = evaluate(expression);
    if (!GiNaC::is_a<GiNaC::symbol>(symbol))
      fail(expression.at, "expected a symbol here, such as " +
                              std::string(result_.chain ? "theta_1" : "x"));
    return symbol;
  }

  /// diff(y, x), diff(y, x, 2): partial derivatives with respect to a symbol.
  ex derivative(const Expression& call) {
    expect_arguments(call, 2, 3);
    const int order = call.children.size() < 3 ? 1 : integer(call.children[2], "the order");
    if (order < 0 || order > 10) fail(call.children[2].at, "an order from 0 to 10 is expected");
    return evaluate(call.children[0])
        .diff(GiNaC::ex_to<GiNaC::symbol>(variable(call.children[1])),
              static_cast<unsigned>(order));
  }

  const std::string& file_;
  std::optional<int> requested_links_;
  Derivation result_;
  std::map<std::string, int> indices_;
  std::map<Reference, Stored> values_;
  std::vector<Entry> stated_;
  std::set<std::string> symmetric_;
  std::set<std::pair<int, int>> noted_;
};

}  // namespace

std::string name_of(Quantity quantity) {
  for (const Target& target : kTargets)
    if (target.quantity == quantity) return std::string(target.name);
  return quantity == Quantity::kEquation ? "equation" : "identity";
}

Derivation evaluate(const Program& program, const std::string& file, std::optional<int> links) {
  return Evaluator(file, links).run(program);
}

}  // namespace catena
