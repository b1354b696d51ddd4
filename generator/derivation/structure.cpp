// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/structure.hpp"

#include <map>
#include <set>
#include <stdexcept>

namespace catena {

using GiNaC::ex;

namespace {

struct NotOfThisForm : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// A linear form over perturbations u_i and over definitions that carry perturbations along the
// chain.
struct Basis {
  enum Kind { kPerturbation, kCarriedDown, kCarriedUp } kind;
  std::string family;  // empty for u
  int index;
  auto operator<=>(const Basis&) const = default;
};
using Form = std::map<Basis, ex>;

void add(Form& form, const Basis& basis, const ex& coefficient) {
  if (coefficient.is_zero()) return;
  ex& entry = form[basis];
  entry = (entry + coefficient).expand();
  if (entry.is_zero()) form.erase(basis);
}

class Linearisation {
 public:
  Linearisation(Chain& chain, const Weights& weights)
      : chain_(chain), definitions_(chain.definitions()), weights_(weights), links_(chain.links()) {
    for (size_t k = 0; k < chain.states().size(); ++k) {
      state_rates_[definitions_.symbols_of(chain.states()[k]).front()] = chain.state_rates()[k];
    }
    for (const auto& [state, rate] : state_rates_) {
      for (const int number : reached_from({rate})) {
        if (number != state && state_rates_.count(number))
          throw NotOfThisForm("extra states depend on each other");
        reached_.insert(number);
      }
    }
    reached_.merge(reached_from(chain.residual()));
    for (const int k : reached_) {
      const Symbol& symbol = definitions_[k];
      if (symbol.is_input || symbol.index == kNoIndex) continue;
      for (const int argument : definitions_.symbols_of(symbol.value)) {
        if (definitions_[argument].family != symbol.family) continue;
        if (definitions_[argument].index == symbol.index - 1) down_.insert(symbol.family);
        if (definitions_[argument].index == symbol.index + 1) up_.insert(symbol.family);
      }
    }
    for (const auto& family : down_) {
      if (up_.count(family)) throw NotOfThisForm(family + " depends on both neighbouring links");
    }
    // From the first link on. Recursion from the last of thousands of links would overflow the
    // stack.
    for (const int k : reached_) change_of_symbol(k);
  }

  // The change of an expression, in terms that are allowed at link i.
  Form at_link(const ex& expression, int i) {
    Form form = change_of(expression);
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [basis, coefficient] : form) {
        const bool expand =
            (basis.kind == Basis::kCarriedDown && (basis.index >= i || basis.index == 0)) ||
            (basis.kind == Basis::kCarriedUp && (basis.index <= i || i == links_));
        if (!expand) continue;
        const ex factor = coefficient;
        const Form inner = definition_of(basis);
        form.erase(basis);
        for (const auto& [b, c] : inner) add(form, b, factor * c);
        changed = true;
        break;
      }
    }
    for (const auto& [basis, coefficient] : form) {
      const int reach = basis.index - i;
      const bool allowed = basis.kind == Basis::kPerturbation  ? reach >= -1 && reach <= 1
                           : basis.kind == Basis::kCarriedDown ? reach == -1
                                                               : reach == 1;
      if (!allowed) {
        throw NotOfThisForm("link " + std::to_string(i) + " depends on " +
                            (basis.family.empty() ? "the angle" : basis.family) + " of link " +
                            std::to_string(basis.index));
      }
    }
    return form;
  }

  const std::set<std::string>& down() const { return down_; }
  const std::set<std::string>& up() const { return up_; }

  // The change of a carried definition at link i, if it is there.
  Form carried(const std::string& family, int i) {
    for (const Basis::Kind kind : {Basis::kCarriedDown, Basis::kCarriedUp}) {
      const auto found = numbers().find({kind, family, i});
      if (found != numbers().end()) return at_link(definitions_[found->second].value, i);
    }
    return {};
  }

 private:
  std::set<int> reached_from(const std::vector<ex>& expressions) {
    std::set<int> reached;
    std::vector<int> open;
    const auto reach = [&](const ex& expression) {
      for (const int number : definitions_.symbols_of(expression)) {
        if (reached.insert(number).second) open.push_back(number);
      }
    };
    for (const ex& expression : expressions) reach(expression);
    while (!open.empty()) {
      const int number = open.back();
      open.pop_back();
      reach(definitions_[number].value);
    }
    return reached;
  }

  const std::map<Basis, int>& numbers() {
    if (numbers_.empty()) {
      for (const int k : reached_) {
        const Symbol& symbol = definitions_[k];
        if (symbol.is_input) continue;
        if (down_.count(symbol.family))
          numbers_[{Basis::kCarriedDown, symbol.family, symbol.index}] = k;
        if (up_.count(symbol.family))
          numbers_[{Basis::kCarriedUp, symbol.family, symbol.index}] = k;
      }
    }
    return numbers_;
  }

  Form definition_of(const Basis& basis) {
    return change_of(definitions_[numbers().at(basis)].value);
  }

  Form change_of(const ex& expression) {
    Form form;
    for (const int number : definitions_.symbols_of(expression)) {
      const Form inner = change_of_symbol(number);
      if (inner.empty()) continue;
      const ex partial = expression.diff(GiNaC::ex_to<GiNaC::symbol>(definitions_[number].symbol));
      for (const auto& [basis, coefficient] : inner) add(form, basis, partial * coefficient);
    }
    return form;
  }

  Form change_of_symbol(int number) {
    const auto found = known_.find(number);
    if (found != known_.end()) return found->second;
    const Symbol symbol = definitions_[number];
    Form form;
    if (state_rates_.count(number)) {
      form = change_of_state(number);
    } else if (symbol.family == "theta") {
      add(form, {Basis::kPerturbation, "", symbol.index}, weights_.position);
    } else if (symbol.family == "theta_dot") {
      add(form, {Basis::kPerturbation, "", symbol.index}, weights_.velocity);
    } else if (symbol.family == "theta_ddot") {
      add(form, {Basis::kPerturbation, "", symbol.index}, weights_.acceleration);
    } else if (symbol.family == "sine") {
      add(form, {Basis::kPerturbation, "", symbol.index},
          weights_.position *
              definitions_.define("cosine", symbol.index, GiNaC::cos(symbol.value.op(0))));
    } else if (symbol.family == "cosine") {
      add(form, {Basis::kPerturbation, "", symbol.index},
          -weights_.position *
              definitions_.define("sine", symbol.index, GiNaC::sin(symbol.value.op(0))));
    } else if (!symbol.is_input) {
      const Form inner = change_of(symbol.value);
      if (inner.empty()) {
        // no change
      } else if (down_.count(symbol.family)) {
        form[{Basis::kCarriedDown, symbol.family, symbol.index}] = 1;
      } else if (up_.count(symbol.family)) {
        form[{Basis::kCarriedUp, symbol.family, symbol.index}] = 1;
      } else {
        for (const auto& [basis, coefficient] : inner) {
          // Functions and roots in derivatives get names too; the slope of a force apart is apart.
          add(form, basis,
              chain_.is_effect_force(number)
                  ? definitions_.define(slope_family(symbol, basis), symbol.index, coefficient)
                  : definitions_.named(coefficient, symbol.family + "_slope", symbol.index));
        }
      }
    }
    known_[number] = form;
    return form;
  }

  // A name that is the same at every link.
  static std::string slope_family(const Symbol& symbol, const Basis& basis) {
    const std::string by = basis.family.empty() ? "angle" : basis.family;
    if (symbol.index == kNoIndex || basis.index == symbol.index)
      return symbol.family + "_slope_by_" + by;
    return symbol.family + "_slope_by_" + by + (basis.index < symbol.index ? "_before" : "_after");
  }

  // delta z = cv (f' u + df/dz delta z), f' the change of the rate f with z held.
  Form change_of_state(int number) {
    if (weights_.velocity.is_zero()) return {};
    const Basis itself{Basis::kPerturbation, "", -1};
    // Within a rate, other definitions depend on z than outside.
    std::map<int, Form> outside{{number, {{itself, 1}}}};
    known_.swap(outside);
    Form rate = change_of(state_rates_.at(number));
    known_.swap(outside);
    const Symbol symbol = definitions_[number];
    const ex slope = rate.count(itself) ? rate.at(itself) : ex(0);
    rate.erase(itself);
    const ex gain = definitions_.define(symbol.family + "_gain", symbol.index,
                                        weights_.velocity / (1 - weights_.velocity * slope));
    Form form;
    for (const auto& [basis, coefficient] : rate) {
      add(form, basis,
          gain * definitions_.named(coefficient, symbol.family + "_rate_slope", symbol.index));
    }
    return form;
  }

  const Chain& chain_;
  Definitions& definitions_;
  Weights weights_;
  int links_;
  std::map<int, ex> state_rates_;  // of extra states, by the state's number
  std::set<int> reached_;          // definitions that the residual needs
  std::set<std::string> down_, up_;
  std::map<Basis, int> numbers_;
  std::map<int, Form> known_;
};

ex entry(const Form& form, const Basis& basis) {
  const auto found = form.find(basis);
  return found == form.end() ? ex(0) : found->second;
}

// sin^2 replaced by 1 - cos^2, expanded
ex without_sine_squares(Definitions& definitions, const ex& expression) {
  GiNaC::exmap squares;
  for (const int number : definitions.symbols_of(expression)) {
    const Symbol symbol = definitions[number];
    if (symbol.family != "sine") continue;
    const ex cosine = definitions.define("cosine", symbol.index, GiNaC::cos(symbol.value.op(0)));
    squares[GiNaC::pow(symbol.symbol, 2)] = 1 - GiNaC::pow(cosine, 2);
  }
  return expression.expand().subs(squares, GiNaC::subs_options::no_pattern).expand();
}

size_t length_of(const ex& expression) {
  return GiNaC::is_a<GiNaC::add>(expression) ? expression.nops() : 1;
}

void require_only(const Form& form, const std::string& family, int i, bool allow_carried) {
  for (const auto& [basis, coefficient] : form) {
    const bool own = basis.family == family;
    const bool fine = (basis.kind == Basis::kPerturbation && basis.index == i) ||
                      (own && coefficient.is_equal(1)) ||
                      (allow_carried && basis.kind == Basis::kCarriedDown);
    if (!fine) throw NotOfThisForm(family + " is not a running sum at link " + std::to_string(i));
  }
}

void find(Chain& chain, const Weights& weights, const std::string& prefix, Quasiseparable& result) {
  Definitions& definitions = chain.definitions();
  const int n = chain.links();
  if (static_cast<int>(chain.coordinates().size()) != n) {
    throw NotOfThisForm("there are coordinates besides one angle a link");
  }
  Linearisation linearisation(chain, weights);
  const std::vector<std::string> down(linearisation.down().begin(), linearisation.down().end());
  const std::vector<std::string> up(linearisation.up().begin(), linearisation.up().end());
  const size_t links = static_cast<size_t>(n) + 2;
  const auto table = [&](size_t columns) {
    return std::vector<std::vector<ex>>(links, std::vector<ex>(columns));
  };
  auto B = table(down.size()), B_value = B, Hx = B;
  auto G = table(up.size()), Hy = G;
  std::vector<std::vector<std::vector<ex>>> S(
      links, std::vector<std::vector<ex>>(up.size(), std::vector<ex>(down.size())));
  std::vector<ex> D(links), below(links), above(links);

  for (int i = 1; i <= n; ++i) {
    const Basis own{Basis::kPerturbation, "", i};
    for (size_t f = 0; f < down.size(); ++f) {
      const Form form = linearisation.carried(down[f], i);
      require_only(form, down[f], i, false);
      B_value[i][f] = definitions.named(entry(form, own), prefix + down[f] + "_gain", i);
      B[i][f] = definitions.define(prefix + down[f] + "_gain", i, B_value[i][f]);
    }
    const Form r = linearisation.at_link(chain.residual()[static_cast<size_t>(i) - 1], i);
    D[i] = entry(r, own);
    below[i] = definitions.named(entry(r, {Basis::kPerturbation, "", i - 1}), prefix + "below", i);
    above[i] = definitions.named(entry(r, {Basis::kPerturbation, "", i + 1}), prefix + "above", i);
    for (size_t f = 0; f < down.size(); ++f) {
      Hx[i][f] = entry(r, {Basis::kCarriedDown, down[f], i - 1});
    }
    for (size_t g = 0; g < up.size(); ++g) Hy[i][g] = entry(r, {Basis::kCarriedUp, up[g], i + 1});
  }
  for (int i = n; i >= 1; --i) {
    for (size_t g = 0; g < up.size(); ++g) {
      const Form form = linearisation.carried(up[g], i);
      require_only(form, up[g], i, true);
      G[i][g] = entry(form, {Basis::kPerturbation, "", i});
      for (size_t f = 0; f < down.size(); ++f) {
        const ex F = entry(form, {Basis::kCarriedDown, down[f], i - 1});
        S[i][g][f] = definitions.define(prefix + up[g] + "_per_" + down[f], i, S[i + 1][g][f] + F);
      }
    }
  }
  // Rows and columns of the two triangles, without those that are zero for every link.
  auto P = table(down.size()), V = table(up.size());
  std::vector<bool> keep_lower(down.size()), keep_upper(up.size());
  result.diagonal.resize(links);
  for (int i = 1; i <= n; ++i) {
    ex D_written_out = D[i];
    for (size_t f = 0; f < down.size(); ++f) {
      P[i][f] = Hx[i][f];
      for (size_t g = 0; g < up.size(); ++g) P[i][f] += Hy[i][g] * S[i + 1][g][f];
      P[i][f] = P[i][f].expand();
      if (i > 1 && !P[i][f].is_zero()) keep_lower[f] = true;
      const ex below_here = P[i][f] - Hx[i][f];
      D[i] += below_here * B[i][f];
      D_written_out += below_here * B_value[i][f];
    }
    // sin^2 + cos^2 = 1 may make the written-out form shorter.
    D_written_out = without_sine_squares(definitions, D_written_out);
    if (length_of(D_written_out) <= length_of(D[i].expand())) D[i] = D_written_out;
    for (size_t g = 0; g < up.size(); ++g) {
      V[i][g] = G[i][g];
      for (size_t f = 0; f < down.size(); ++f) V[i][g] += S[i + 1][g][f] * B[i][f];
      V[i][g] = V[i][g].expand();
      if (i < n && !Hy[i][g].is_zero()) keep_upper[g] = true;
    }
  }
  for (size_t f = 0; f < down.size(); ++f) {
    bool column = false;
    for (int i = 1; i < n; ++i) column = column || !B[i][f].is_zero();
    keep_lower[f] = keep_lower[f] && column;
  }
  for (auto* list :
       {&result.upper_row, &result.upper_column, &result.lower_row, &result.lower_column}) {
    list->resize(links);
  }
  result.symmetric = true;
  const auto named = [&](const ex& e, const char* what, int i) {
    return definitions.named(e, prefix + what, i);
  };
  for (int i = 1; i <= n; ++i) {
    std::vector<ex> lower_column_values;
    for (size_t f = 0; f < down.size(); ++f) {
      if (!keep_lower[f]) continue;
      result.lower_row[i].push_back(named(P[i][f], "lower_row", i));
      result.lower_column[i].push_back(B[i][f]);
      lower_column_values.push_back(B_value[i][f]);
    }
    for (size_t g = 0; g < up.size(); ++g) {
      if (!keep_upper[g]) continue;
      result.upper_row[i].push_back(named(Hy[i][g], "upper_row", i));
      result.upper_column[i].push_back(named(V[i][g], "upper_column", i));
    }
    result.diagonal[i] = named(D[i], "diagonal", i);
    // Symmetric if the rows of each triangle are the columns of the other, coefficient by
    // coefficient.
    GiNaC::exmap values;
    for (size_t f = 0; f < down.size(); ++f) {
      if (GiNaC::is_a<GiNaC::symbol>(B[i][f])) values[B[i][f]] = B_value[i][f];
    }
    const auto equal = [&](const ex& a, const ex& b) {
      return (a.subs(values, GiNaC::subs_options::no_pattern) -
              b.subs(values, GiNaC::subs_options::no_pattern))
          .expand()
          .is_zero();
    };
    bool same = result.lower_row[i].size() == result.upper_row[i].size();
    for (size_t r = 0; same && r < result.lower_row[i].size(); ++r) {
      same = (i == n || equal(lower_column_values[r], result.upper_row[i][r])) &&
             (i == 1 || equal(result.lower_row[i][r], result.upper_column[i][r]));
    }
    if (i > 1) same = same && equal(below[i], above[i - 1]);
    result.symmetric = result.symmetric && same;
  }
  result.below = below;
  result.above = above;
  result.upper_rank = static_cast<int>(result.upper_row[1].size());
  result.lower_rank = static_cast<int>(result.lower_row[1].size());
  result.found = true;
}

}  // namespace

Quasiseparable find_structure(Chain& chain, const Weights& weights, const std::string& prefix) {
  Quasiseparable result;
  try {
    find(chain, weights, prefix, result);
  } catch (const NotOfThisForm& why) {
    result = {};
    result.reason = why.what();
  }
  return result;
}

}  // namespace catena
