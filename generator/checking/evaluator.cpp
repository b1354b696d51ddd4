// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/evaluator.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "common/most_links.hpp"
#include "generator/checking/budget.hpp"
#include "generator/checking/expression_evaluator.hpp"
#include "generator/checking/normal_form.hpp"
#include "generator/checking/scope.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;

class Evaluator {
 public:
  Evaluator(const std::string& file, std::optional<int> links, const std::vector<Effect>& effects)
      : requested_links_(links) {
    scope_.file = file;
    result_.effects = effects;
  }

  Derivation run(const Program& program) {
    for (const Statement& statement : program) {
      const Budget budget;
      execute(statement);
    }
    mirror();
    collect();
    result_.chain = std::move(scope_.chain);
    result_.notes = std::move(scope_.notes);
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(Location at, const std::string& message) const {
    scope_.fail(at, message);
  }
  [[nodiscard]] int links() const { return scope_.links(); }
  [[nodiscard]] int coordinates() const { return scope_.coordinates(); }
  [[nodiscard]] bool scalar() const { return !scope_.free_symbols.empty(); }

  // ---- statements ----

  void execute(const Statement& statement) {
    using Kind = Statement::Kind;
    const bool declares = statement.kind == Kind::kLinks || statement.kind == Kind::kSymbols ||
                          statement.kind == Kind::kPositive;
    if (!declares && !scope_.chain && !scalar())
      fail(statement.at,
           "expected first 'links N' (a derivation of the chain) or 'symbols x, ...' (scalar "
           "identities)");
    try {
      perform(statement);
    } catch (const InputError&) {
      throw;
    } catch (const Overlong& error) {
      fail(statement.at, std::string("this statement is too long: ") + error.what() +
                             "; write it, or the loops around it, in smaller steps");
    } catch (const std::exception& error) {  // what GiNaC cannot do
      fail(statement.at, std::string("this cannot be evaluated: ") + error.what());
    }
  }

  void perform(const Statement& statement) {
    using Kind = Statement::Kind;
    switch (statement.kind) {
      case Kind::kLinks:
        return set_links(statement);
      case Kind::kSymbols:
      case Kind::kPositive:
        return declare(statement);
      case Kind::kSymmetric:
        return declare_symmetric(statement);
      case Kind::kGiven:
        return give(statement);
      case Kind::kAssign:
        return assign(statement);
      case Kind::kEquation:
        return equation(statement);
      case Kind::kIdentity:
        return identity(statement);
      case Kind::kFor:
        return expressions_.over_range(
            statement.names[0], statement.expressions[0], statement.expressions[1],
            statement.expressions.size() > 2 ? &statement.expressions[2] : nullptr, [&] {
              for (const Statement& inner : statement.block) execute(inner);
            });
      case Kind::kIf:
        for (const Statement& inner :
             expressions_.holds(statement.expressions[0]) ? statement.block : statement.otherwise)
          execute(inner);
        return;
    }
  }

  void set_links(const Statement& statement) {
    if (scalar()) fail(statement.at, "a scalar derivation (symbols ...) has no links");
    if (scope_.chain) fail(statement.at, "the number of links is already set");
    scope_.chain = std::make_unique<ChainSymbols>(1);  // so that the number may be an expression
    const int stated = expressions_.integer(statement.expressions[0], "the number of links");
    const int number = requested_links_.value_or(stated);
    if (number < 1 || number > kMostLinks)
      fail(statement.at, "links = " + std::to_string(number) + "; must be from 1 to " +
                             std::to_string(kMostLinks));
    Budget::spend(4.0 * number *
                  number);  // the energies of link k have terms of k links, in two or three axes
    const bool in_space = !statement.names.empty();
    if (in_space && !result_.effects.empty())
      fail(statement.at, "derivations with effects are compared in the plane only");
    scope_.chain = std::make_unique<ChainSymbols>(
        number, result_.effects, in_space ? Space::kThreeDimensional : Space::kPlane);
    if (in_space) store_direction(0, statement.at);
  }

  [[nodiscard]] bool is_direction(const Reference& reference) const {
    return scope_.chain && scope_.chain->space == Space::kThreeDimensional && reference.name == "q";
  }

  /// q[i,1], q[i,2], q[i,3] are the components of the unit vector of link i.
  void store_direction(int link, Location at) {
    for (int axis = 0; axis < 3; ++axis)
      store({"q", {link, axis + 1}},
            scope_.chain->direction[static_cast<std::size_t>(link)][static_cast<std::size_t>(axis)],
            at);
  }

  /// q_i = [side, down, across]: what the angles of link i mean.
  void assign_direction(const Reference& reference, const Expression& target,
                        const Expression& value) {
    if (reference.indices.size() != 1)
      fail(target.at, "q has one index: q_i is the unit vector of link i");
    const int link = reference.indices[0];
    expressions_.check_range(target.at, reference, link, 1, links());
    if (value.kind != Expression::Kind::kMatrix || value.children.size() != 1 ||
        value.children[0].children.size() != 3)
      fail(value.at, "the unit vector of a link is written [side, down, across]");
    std::vector<ex>& direction = scope_.chain->direction[static_cast<std::size_t>(link)];
    if (!direction.empty()) fail(target.at, reference.text() + " is set twice");
    ex square = 0;
    for (const Expression& component : value.children[0].children) {
      direction.push_back(expressions_.value(component));
      square += GiNaC::pow(direction.back(), 2);
      for (const auto* moving : {&scope_.chain->rate, &scope_.chain->acceleration})
        if (std::any_of(moving->begin() + 1, moving->end(),
                        [&](const ex& symbol) { return direction.back().has(symbol); }))
          fail(component.at, "the unit vector of a link contains a rate or an acceleration");
    }
    NormalForm form({square});
    if (!form(square - 1).numerator.is_zero())
      fail(value.at, reference.text() + " is no unit vector: its square is not proved to be 1");
    store_direction(link, target.at);
  }

  void declare(const Statement& statement) {
    if (scope_.chain)
      fail(statement.at, "free symbols belong to a scalar derivation; this one has links");
    for (const std::string& name : statement.names) {
      if (functions().count(name) != 0 || name == "pi")
        fail(statement.at, "'" + name + "' already has a meaning");
      if (scope_.free_symbols.count(name) != 0)
        fail(statement.at, "'" + name + "' is declared twice");
      scope_.free_symbols[name] = statement.kind == Statement::Kind::kPositive
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
    if (!scope_.chain)
      fail(statement.at, "'given' states a parameter of the chain; set links first");
    const Expression& target = statement.expressions[0];
    const ex parameter = expressions_.read(target);
    if (!GiNaC::is_a<GiNaC::symbol>(parameter) || !scope_.chain->is_constant(parameter))
      fail(target.at,
           "'given' expects a parameter: l_i, m_i, I_i, k_i, c_i, T_i, m_c, g or one of an effect");
    const auto replaced = [](const ex& in, const GiNaC::exmap& by) {
      return in.subs(by, GiNaC::subs_options::no_pattern);
    };
    const ex value = replaced(expressions_.value(statement.expressions[1]), result_.given);
    if (!scope_.chain->is_constant(value))
      fail(statement.expressions[1].at, "the value of a parameter contains an angle or a rate");
    if (value.has(parameter)) fail(target.at, "this parameter would be given by itself");
    // What is given may stand in what was given before.
    for (auto& [known, given] : result_.given) given = replaced(given, {{parameter, value}});
    result_.given[parameter] = value;
  }

  void assign(const Statement& statement) {
    const Expression& target = statement.expressions[0];
    const Expression& value = statement.expressions[1];
    const Reference reference = expressions_.resolve(target);
    if (scope_.chain && reference.name == "thetaddot" && reference.indices.size() == 1)
      return solved_equation(reference, target, value);
    if (is_direction(reference)) return assign_direction(reference, target, value);
    check_assignable(target, reference);
    if (value.kind == Expression::Kind::kMatrix) return assign_matrix(reference, value);
    const Target* known = scope_.chain ? target_named(reference.name) : nullptr;
    if (known != nullptr) {
      if (reference.indices.size() != known->indices)
        fail(target.at, known->indices == 0
                            ? reference.name + " is a scalar and has no entries"
                            : reference.name + " needs " + std::to_string(known->indices) +
                                  (known->indices == 1 ? " index" : " indices") +
                                  ", or a whole matrix in [ ]");
      for (const int index : reference.indices)
        expressions_.check_range(target.at, reference, index, 1, coordinates());
    }
    store(reference, expressions_.value(value), statement.at);
  }

  /// thetaddot_i = ...: an equation of motion solved for that acceleration.
  void solved_equation(const Reference& reference, const Expression& target,
                       const Expression& value) {
    const int number = reference.indices[0];
    expressions_.check_range(target.at, reference, number, 1, links());
    stated_.push_back({Quantity::kEquation,
                       number,
                       0,
                       reference.text(),
                       expressions_.read(target),
                       expressions_.value(value),
                       target.at,
                       {}});
  }

  void check_assignable(const Expression& target, const Reference& reference) const {
    const std::string& name = reference.name;
    if (scope_.indices.count(name) != 0)
      fail(target.at, "'" + name + "' is the index of a loop and cannot be assigned");
    const bool parameter =
        scope_.chain &&
        (name == "m_c" || name == "g" || name == "n" ||
         (is_family(name, *scope_.chain) && !(name == "T" && reference.indices.empty())) ||
         scope_.chain->effects.contains(name));
    if (parameter && name == "I" && reference.indices.size() == 2)
      fail(target.at, "the mass matrix is called M; I_i is the inertia of link i");
    if (parameter)
      fail(target.at, "'" + reference.text() +
                          "' is a symbol of the chain and cannot be assigned; to state a value "
                          "for a parameter write 'given'");
    if (name == "pi" || scope_.free_symbols.count(name) != 0)
      fail(target.at, "'" + name + "' is a symbol and cannot be assigned");
    if (functions().count(name) != 0) fail(target.at, "'" + name + "' is a function");
  }

  void assign_matrix(const Reference& reference, const Expression& matrix) {
    const Target* known = scope_.chain ? target_named(reference.name) : nullptr;
    if (known == nullptr || known->indices == 0 || !reference.indices.empty())
      fail(matrix.at, "only M, C, K, F and G can be given whole");
    std::vector<const Expression*> flat;
    const auto size = static_cast<std::size_t>(coordinates());
    bool square = matrix.children.size() == size;
    for (const Expression& row : matrix.children) {
      square = square && row.children.size() == size;
      for (const Expression& entry : row.children) flat.push_back(&entry);
    }
    const bool vector = flat.size() == size &&
                        (matrix.children.size() == 1 || matrix.children.size() == flat.size());
    if (known->indices == 2 ? !square : !vector)
      fail(matrix.at,
           reference.name + " has " + std::to_string(matrix.children.size()) + " rows and " +
               std::to_string(flat.size()) + " entries; expected " + std::to_string(size) +
               (known->indices == 2 ? " rows of as many entries (rows end with ;)" : " entries"));
    for (std::size_t index = 0; index < flat.size(); ++index) {
      const int row = static_cast<int>(index) / (known->indices == 2 ? coordinates() : 1) + 1;
      Reference entry{reference.name, {row}};
      if (known->indices == 2) entry.indices.push_back(static_cast<int>(index) % coordinates() + 1);
      store(entry, expressions_.value(*flat[index]), flat[index]->at);
    }
  }

  void store(const Reference& reference, ex value, Location at) {
    const auto [found, created] = scope_.values.try_emplace(reference);
    if (!created) found->second.overwritten.push_back(found->second.at);
    found->second.value = std::move(value);
    found->second.at = at;
  }

  void equation(const Statement& statement) {
    if (!scope_.chain) fail(statement.at, "equations of motion belong to a chain; set links first");
    const int number = expressions_.integer(statement.expressions[0], "the number of the equation");
    if (number < 1 || number > coordinates())
      fail(statement.at, "equation " + std::to_string(number) + ": there are " +
                             std::to_string(links()) + " links" +
                             (coordinates() > links() ? " with two angles each" : ""));
    stated_.push_back({Quantity::kEquation,
                       number,
                       0,
                       "equation " + std::to_string(number),
                       expressions_.value(statement.expressions[1]),
                       expressions_.value(statement.expressions[2]),
                       statement.at,
                       {}});
  }

  void identity(const Statement& statement) {
    std::string label = statement.names[0];
    if (label.empty()) label = "identity, line " + std::to_string(statement.at.line);
    stated_.push_back({Quantity::kIdentity,
                       0,
                       0,
                       label,
                       expressions_.value(statement.expressions[0]),
                       expressions_.value(statement.expressions[1]),
                       statement.at,
                       {}});
  }

  // ---- what is checked ----

  void mirror() {
    for (const std::string& name : symmetric_) {
      std::map<Reference, Scope::Stored> mirrored;
      for (const auto& [reference, stored] : scope_.values)
        if (reference.name == name)
          mirrored.emplace(Reference{name, {reference.indices[1], reference.indices[0]}}, stored);
      scope_.values.merge(mirrored);  // keeps what is written
    }
  }

  /// C, K, F and G divide the forces of the plain chain; those of an effect may belong to several.
  static bool is_of_plain_chain(Quantity quantity) {
    return quantity == Quantity::kDamping || quantity == Quantity::kStiffness ||
           quantity == Quantity::kCoriolis || quantity == Quantity::kGravity;
  }

  void collect() {
    if (scope_.chain) {
      for (std::size_t i = 0; i < scope_.chain->direction.size(); ++i)
        if (scope_.chain->direction[i].empty())
          throw InputError(
              scope_.file + ": error: q_" + std::to_string(i) +
              " is not set; say what the angles mean by q_i = [side, down, across] for "
              "i = 1..n");
      for (const Target& target : kTargets) {
        for (const auto& [reference, stored] : scope_.values) {
          if (reference.name != target.name) continue;
          if (!result_.effects.empty() && is_of_plain_chain(target.quantity))
            fail(stored.at, std::string(target.name) +
                                " is not defined for a chain with effects; state L, T, V, D, M or "
                                "the equations");
          const std::vector<int>& index = reference.indices;
          result_.entries.push_back({target.quantity, index.empty() ? 0 : index[0],
                                     index.size() < 2 ? 0 : index[1], reference.text(),
                                     stored.value, 0, stored.at, stored.overwritten});
        }
      }
    }
    for (Entry& entry : stated_) result_.entries.push_back(std::move(entry));
    std::stable_sort(result_.entries.begin(), result_.entries.end(),
                     [](const Entry& a, const Entry& b) { return a.quantity < b.quantity; });
    if (result_.entries.empty())
      throw InputError(scope_.file +
                       ": error: nothing to check; assign L, T, V, D, M, C, K, F or G, or "
                       "state an equation or identity");
  }

  std::optional<int> requested_links_;
  Scope scope_;
  ExpressionEvaluator expressions_{scope_};
  Derivation result_;
  std::vector<Entry> stated_;
  std::set<std::string> symmetric_;
};

}  // namespace

Derivation evaluate(const Program& program, const std::string& file, std::optional<int> links,
                    const std::vector<Effect>& effects) {
  return Evaluator(file, links, effects).run(program);
}

}  // namespace catena::checking
