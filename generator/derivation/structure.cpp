// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/structure.hpp"

#include <initializer_list>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace catena {

using GiNaC::ex;

namespace {

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

void require_only(const Form& form, const std::string& family, int i, bool up) {
  for (const auto& [basis, coefficient] : form) {
    const bool own = basis.family == family;
    const bool near = basis.index == i || basis.index == i - 1 || (up && basis.index == i + 1);
    const bool fine = (basis.kind == Basis::kPerturbation && near) ||
                      (own && coefficient.is_equal(1)) || (up && basis.kind == Basis::kCarriedDown);
    if (!fine) throw NotOfThisForm(family + " is not a running sum at link " + std::to_string(i));
  }
}

// The derivative along one coordinate of no link, in an implicit step. Extra states follow as
// Linearisation::change_of_state says.
Differential along_border(Chain& chain, const Weights& weights, size_t coordinate) {
  Definitions& definitions = chain.definitions();
  const auto along_coordinate = [&] {
    Differential along(definitions, [](const std::string& family) { return family + "_held"; });
    along.set(chain.coordinates()[coordinate], weights.position);
    along.set(chain.rates()[coordinate], weights.velocity);
    along.set(chain.accelerations()[coordinate], weights.acceleration);
    return along;
  };
  Differential along = along_coordinate(), with_states_held = along_coordinate();
  for (size_t k = 0; k < chain.states().size() && !weights.velocity.is_zero(); ++k) {
    const ex& state = chain.states()[k];
    const ex change = with_states_held.of(chain.state_rates()[k]);
    if (change.is_zero()) continue;
    Differential by_state(definitions,
                          [](const std::string& family) { return family + "_by_state"; });
    by_state.set(state, 1);
    const Symbol symbol = definitions[definitions.number_of(state)];
    const ex gain = definitions.define(
        symbol.family + "_gain", symbol.index,
        weights.velocity / (1 - weights.velocity * by_state.of(chain.state_rates()[k])));
    along.set(state, gain * change);
  }
  return along;
}

using Columns = std::vector<std::vector<ex>>;  // [component][rank] or [component][component]

/// [i][a]: of component a of link i.
using OfLinks = std::vector<std::vector<ex>>;

// A column times a row: one rank more in each triangle, and the diagonal.
void add_product(const OfLinks& column, const OfLinks& row, Quasiseparable& result) {
  for (size_t i = 1; i + 1 < result.diagonal.size(); ++i) {
    for (size_t a = 0; a < column[i].size(); ++a) {
      result.upper_row[i][a].push_back(column[i][a]);
      result.lower_row[i][a].push_back(column[i][a]);
      result.upper_column[i][a].push_back(row[i][a]);
      result.lower_column[i][a].push_back(row[i][a]);
      for (size_t b = 0; b < column[i].size(); ++b)
        result.diagonal[i][a][b] += column[i][a] * row[i][b];
    }
  }
  result.symmetric = false;
}

// What the elimination of the state of torsion adds: its column times its row.
void add_path(Chain& chain, const Weights& weights, const std::string& prefix,
              Linearisation& linearisation, Quasiseparable& result) {
  Definitions& definitions = chain.definitions();
  const size_t block = result.diagonal[1].size(), n = static_cast<size_t>(chain.links());
  Form rate;
  for (size_t k = 0; k < chain.states().size(); ++k)
    if (chain.states()[k].is_equal(chain.path()))
      rate = linearisation.along_links(chain.state_rates()[k]);
  Differential by_path(definitions, [](const std::string& family) { return family + "_by_path"; });
  by_path.set(chain.path(), 1);
  for (size_t k = block * n; k < chain.residual().size(); ++k)
    if (!by_path.of(chain.residual()[k]).is_zero())
      throw NotOfThisForm("an equation of no link depends on torsion");
  OfLinks column(n + 1), row(n + 1);
  for (size_t i = 1; i <= n; ++i) {
    const int link = static_cast<int>(i);
    for (size_t a = 0; a < block; ++a) {
      const auto named = [&](std::string family) {
        return family.append("_").append(std::to_string(a));
      };
      column[i].push_back(definitions.define(named(prefix + "path_column"), link,
                                             by_path.of(chain.residual()[a * n + i - 1])));
      const Basis moved{Basis::kPerturbation, "", link, static_cast<int>(a)};
      row[i].push_back(definitions.define(named(prefix + "path_row"), link,
                                          weights.velocity * entry(rate, moved)));
    }
  }
  add_product(column, row, result);
}

/// Finds the structure of one chain: what is carried along it is read link by link, downwards and upwards, and put
/// together to the two triangles. The letters are those of structure.hpp.
class StructureSearch {
 public:
  StructureSearch(Chain& chain, const Weights& weights, const std::string& prefix, Moving moving)
      : chain_(chain),
        weights_(weights),
        prefix_(prefix),
        definitions_(chain.definitions()),
        n_(chain.links()),
        first_own_(definitions_.size()),
        block_(chain.axes().size() == 2 ? 1 : 3),
        border_(chain.border()),
        links_(static_cast<size_t>(n_) + 2),
        linearisation_(checked(chain, block_), weights, moving),
        down_(linearisation_.down().begin(), linearisation_.down().end()),
        up_(linearisation_.up().begin(), linearisation_.up().end()) {}

  Quasiseparable find() {
    for (int i = 1; i <= n_; ++i) {
      read_carried_down(i);
      for (size_t a = 0; a < block_; ++a) read_equation(i, a);
    }
    read_border();
    for (int i = n_; i >= 1; --i) read_carried_up(i);
    for (int i = 1; i <= n_; ++i)
      for (size_t a = 0; a < block_; ++a) put_together(i, a);
    drop_empty_columns();
    write_triangles();
    write_neighbours();
    add_chords();
    if (!chain_.path().is_zero() && !weights_.velocity.is_zero())
      add_path(chain_, weights_, prefix_, linearisation_, result_);
    finish();
    return std::move(result_);
  }

 private:
  static Chain& checked(Chain& chain, size_t block) {
    if (chain.coordinates().size() != block * static_cast<size_t>(chain.links()) + chain.border())
      throw NotOfThisForm("there are coordinates besides one angle a link");
    return chain;
  }

  std::vector<Columns> table(size_t columns) const {
    return std::vector<Columns>(links_, Columns(block_, std::vector<ex>(columns)));
  }
  static Basis perturbation(size_t component, int i) {
    return Basis{Basis::kPerturbation, "", i, static_cast<int>(component)};
  }
  /// Of the names of what belongs to a row, or to a row and a column, of a block.
  std::string ending(size_t a) const { return block_ == 1 ? "" : "_" + std::to_string(a); }
  std::string joined(std::initializer_list<std::string_view> parts) const {
    std::string name = prefix_;
    for (const std::string_view part : parts) name += part;
    return name;
  }
  const ex& equation(int i, size_t a) const {
    return linearisation_.equations()[a * static_cast<size_t>(n_) + static_cast<size_t>(i) - 1];
  }
  const ex& equation_of_border(size_t k) const {
    return linearisation_.equations()[block_ * static_cast<size_t>(n_) + k];
  }

  void read_carried_down(int i) {
    for (size_t f = 0; f < down_.size(); ++f) {
      const Form form = linearisation_.carried(down_[f], i);
      require_only(form, down_[f], i, false);
      for (size_t b = 0; b < block_; ++b) {
        const std::string name = prefix_ + down_[f] + "_gain" + ending(b);
        B_value_[i][b][f] = definitions_.named(entry(form, perturbation(b, i)), name, i);
        B_[i][b][f] = block_ == 1 ? definitions_.define(name, i, B_value_[i][b][f])
                                  : linearisation_.one_name(name, i, B_value_[i][b][f]);
        B_before_[i][b][f] =
            linearisation_.one_name(name + "_before", i, entry(form, perturbation(b, i - 1)));
      }
    }
  }

  void read_equation(int i, size_t a) {
    Form r = linearisation_.at_link(equation(i, a), i);
    for (auto term = r.begin(); term != r.end();) {
      if (term->first.kind != Basis::kChordForce) {
        ++term;
        continue;
      }
      OfLinks& column =
          chord_columns_.try_emplace(term->first, links_, std::vector<ex>(block_)).first->second;
      column[i][a] =
          definitions_.define(joined({term->first.family, "_column", ending(a)}), i, term->second);
      term = r.erase(term);
    }
    for (auto& [basis, coefficient] : r) {
      const std::string by =
          basis.family.empty() ? ending(static_cast<size_t>(basis.component)) : basis.family;
      const std::string place = std::to_string(basis.index - i + 1);
      if (block_ > 1)
        coefficient = linearisation_.one_name(
            joined({"residual", ending(a), "_by_", by, "_", place}), i, coefficient);
    }
    for (size_t b = 0; b < block_; ++b) {
      D_[i][a][b] = entry(r, perturbation(b, i));
      below_[i][a][b] = definitions_.named(entry(r, perturbation(b, i - 1)),
                                           joined({"below", ending(a), ending(b)}), i);
      above_[i][a][b] = definitions_.named(entry(r, perturbation(b, i + 1)),
                                           joined({"above", ending(a), ending(b)}), i);
    }
    for (size_t f = 0; f < down_.size(); ++f)
      Hx_[i][a][f] = entry(r, {Basis::kCarriedDown, down_[f], i - 1});
    for (size_t g = 0; g < up_.size(); ++g)
      Hy_[i][a][g] = entry(r, {Basis::kCarriedUp, up_[g], i + 1});
  }

  /// What a form that belongs to no link has of component a of link i.
  ex by_link(const Form& form, size_t a, int i) const {
    ex sum = entry(form, perturbation(a, i));
    for (size_t f = 0; f < down_.size(); ++f)
      for (auto carried = form.lower_bound({Basis::kCarriedDown, down_[f], i});
           carried != form.end() && carried->first.family == down_[f]; ++carried)
        sum += carried->second *
               (B_[i][a][f] + (carried->first.index > i ? B_before_[i + 1][a][f] : ex(0)));
    return sum;
  }

  void read_border() {
    result_.border = static_cast<int>(border_);
    result_.border_column = result_.border_row = table(border_);
    result_.corner.assign(border_, std::vector<ex>(border_));
    const auto numbered = [](size_t k) { return "_" + std::to_string(k); };
    for (size_t k = 0; k < border_; ++k) {
      Differential along = along_border(chain_, weights_, block_ * static_cast<size_t>(n_) + k);
      const Form row = linearisation_.of_no_link(equation_of_border(k));
      for (int i = 1; i <= n_; ++i) {
        for (size_t a = 0; a < block_; ++a) {
          result_.border_column[i][a][k] = definitions_.named(
              along.of(equation(i, a)), joined({"border_column", ending(a), numbered(k)}), i);
          result_.border_row[i][a][k] = definitions_.named(
              by_link(row, a, i), joined({"border_row", ending(a), numbered(k)}), i);
        }
      }
      for (size_t l = 0; l < border_; ++l)
        result_.corner[l][k] =
            definitions_.named(along.of(equation_of_border(l)),
                               joined({"corner", numbered(l), numbered(k)}), kNoIndex);
    }
  }

  void read_carried_up(int i) {
    for (size_t g = 0; g < up_.size(); ++g) {
      const Form form = linearisation_.carried(up_[g], i);
      require_only(form, up_[g], i, true);
      for (size_t b = 0; b < block_; ++b) {
        const auto gain = [&](const char* where, int of) {
          return linearisation_.one_name(joined({up_[g], "_gain", where, ending(b)}), i,
                                         entry(form, perturbation(b, of)));
        };
        G_[i][b][g] = entry(form, perturbation(b, i));
        G_before_[i][b][g] = gain("_before", i - 1);
        G_after_[i][b][g] = gain("_after", i + 1);
      }
      for (size_t f = 0; f < down_.size(); ++f) {
        const ex F = entry(form, {Basis::kCarriedDown, down_[f], i - 1});
        S_[i][g][f] =
            definitions_.define(prefix_ + up_[g] + "_per_" + down_[f], i, S_[i + 1][g][f] + F);
        // With one summand it is no sum, but perhaps a name that something else has, too.
        const bool is_sum = !F.is_zero() && !S_[i + 1][g][f].is_zero();
        if (is_sum && GiNaC::is_a<GiNaC::symbol>(S_[i][g][f]))
          sums_.insert(definitions_.number_of(S_[i][g][f]));
      }
    }
  }

  /// Component a of link i: its rows and columns of the two triangles, and its row of the diagonal.
  void put_together(int i, size_t a) {
    std::vector<ex> written_out = D_[i][a];
    for (size_t f = 0; f < down_.size(); ++f) {
      P_[i][a][f] = Hx_[i][a][f];
      for (size_t g = 0; g < up_.size(); ++g) P_[i][a][f] += Hy_[i][a][g] * S_[i + 1][g][f];
      P_[i][a][f] = P_[i][a][f].expand();
      if (i > 1 && !P_[i][a][f].is_zero()) keep_lower_[f] = true;
      const ex below_here = P_[i][a][f] - Hx_[i][a][f];
      for (size_t b = 0; b < block_; ++b) {
        D_[i][a][b] += below_here * B_[i][b][f];
        written_out[b] += below_here * B_value_[i][b][f];
        below_[i][a][b] -= Hx_[i][a][f] * B_before_[i][b][f];
      }
      C_[i][a][f] = B_[i][a][f];
      if (!B_before_[i + 1][a][f].is_zero())
        C_[i][a][f] = definitions_.define(joined({down_[f], "_gain_of_both", ending(a)}), i,
                                          B_[i][a][f] + B_before_[i + 1][a][f]);
    }
    if (block_ == 1) {
      // sin^2 + cos^2 = 1 may make the written-out form shorter.
      const ex shorter = without_sine_squares(definitions_, written_out[0]);
      if (length_of(shorter) <= length_of(D_[i][0][0].expand())) D_[i][0][0] = shorter;
    }
    for (size_t g = 0; g < up_.size(); ++g) {
      V_[i][a][g] = G_[i][a][g] + G_before_[i + 1][a][g] + G_after_[i - 1][a][g];
      for (size_t f = 0; f < down_.size(); ++f)
        V_[i][a][g] += S_[i + 1][g][f] * B_[i][a][f] + S_[i + 2][g][f] * B_before_[i + 1][a][f];
      V_[i][a][g] = V_[i][a][g].expand();
      for (size_t b = 0; b < block_; ++b) {
        above_[i][a][b] -= Hy_[i][a][g] * G_after_[i][b][g];
        D_[i][a][b] += Hy_[i][a][g] * G_before_[i + 1][b][g];
        for (size_t f = 0; f < down_.size(); ++f)
          D_[i][a][b] += Hy_[i][a][g] * S_[i + 2][g][f] * B_before_[i + 1][b][f];
      }
      if (i < n_ && !Hy_[i][a][g].is_zero()) keep_upper_[g] = true;
    }
  }

  /// Of the lower triangle, where they are zero for every link.
  void drop_empty_columns() {
    for (size_t f = 0; f < down_.size(); ++f) {
      bool column = false;
      for (int i = 1; i < n_; ++i)
        for (size_t b = 0; b < block_; ++b) column = column || !C_[i][b][f].is_zero();
      keep_lower_[f] = keep_lower_[f] && column;
    }
  }

  /// What was named here written out, but for the sums over links.
  ex opened(const ex& e) const {
    GiNaC::exmap values;
    for (const int number : definitions_.symbols_of(e))
      if (number >= first_own_ && !sums_.contains(number) && !definitions_[number].is_input)
        values[definitions_[number].symbol] = definitions_[number].value;
    return values.empty() ? e : opened(e.subs(values, GiNaC::subs_options::no_pattern).expand());
  }
  bool equal(const ex& a, const ex& b) const {
    return a.is_equal(b) || (opened(a) - opened(b)).expand().is_zero();
  }

  void write_triangles() {
    for (auto* list :
         {&result_.upper_row, &result_.upper_column, &result_.lower_row, &result_.lower_column})
      list->assign(links_, Columns(block_));
    result_.diagonal = table(block_);
    result_.symmetric = true;
    for (int i = 1; i <= n_; ++i) {
      bool same = true;
      for (size_t a = 0; a < block_; ++a) {
        write_rows(i, a);
        same = same && is_symmetric(i, a);
      }
      for (size_t a = 0; a < block_; ++a)
        for (size_t k = 0; same && k < border_; ++k)
          same = equal(result_.border_row[i][a][k], result_.border_column[i][a][k]);
      result_.symmetric = result_.symmetric && same;
    }
    for (size_t k = 0; k < border_; ++k)
      for (size_t l = 0; l < k; ++l)
        result_.symmetric = result_.symmetric && equal(result_.corner[k][l], result_.corner[l][k]);
  }

  void write_rows(int i, size_t a) {
    const auto named = [&](const ex& e, const std::string& what) {
      return definitions_.named(e, prefix_ + what, i);
    };
    for (size_t f = 0; f < down_.size(); ++f) {
      if (!keep_lower_[f]) continue;
      result_.lower_row[i][a].push_back(named(P_[i][a][f], "lower_row" + ending(a)));
      result_.lower_column[i][a].push_back(C_[i][a][f]);
    }
    for (size_t g = 0; g < up_.size(); ++g) {
      if (!keep_upper_[g]) continue;
      result_.upper_row[i][a].push_back(named(Hy_[i][a][g], "upper_row" + ending(a)));
      result_.upper_column[i][a].push_back(named(V_[i][a][g], "upper_column" + ending(a)));
    }
    for (size_t b = 0; b < block_; ++b)
      result_.diagonal[i][a][b] = named(D_[i][a][b], "diagonal" + ending(a) + ending(b));
  }

  /// Whether the rows of each triangle are the columns of the other, coefficient by coefficient.
  bool is_symmetric(int i, size_t a) const {
    const std::vector<ex>&lower = result_.lower_row[i][a], &upper = result_.upper_row[i][a];
    bool same = lower.size() == upper.size();
    for (size_t r = 0; same && r < lower.size(); ++r)
      same = (i == n_ || equal(result_.lower_column[i][a][r], upper[r])) &&
             (i == 1 || equal(lower[r], result_.upper_column[i][a][r]));
    for (size_t b = 0; same && b < block_; ++b)
      same = i == 1 || equal(below_[i][a][b], above_[i - 1][b][a]);
    for (size_t b = 0; same && b < a; ++b)
      same = equal(result_.diagonal[i][a][b], result_.diagonal[i][b][a]);
    return same;
  }

  void write_neighbours() {
    for (int i = 1; i <= n_; ++i)
      for (size_t a = 0; a < block_; ++a)
        for (size_t b = 0; b < block_; ++b) {
          below_[i][a][b] = definitions_.named(below_[i][a][b], prefix_ + "below", i);
          above_[i][a][b] = definitions_.named(above_[i][a][b], prefix_ + "above", i);
        }
    result_.below = below_;
    result_.above = above_;
  }

  void add_chords() {
    for (const auto& [force, form] : linearisation_.chord_forces()) {
      OfLinks row(links_, std::vector<ex>(block_));
      for (int i = 1; i <= n_; ++i)
        for (size_t a = 0; a < block_; ++a)
          row[i][a] = definitions_.define(joined({force.family, "_row", ending(a)}), i,
                                          by_link(form, a, i));
      add_product(chord_columns_.at(force), row, result_);
    }
  }

  void finish() {
    // One link has nothing to couple. Blocks, and what has a border, have arrays all the same, of zeros.
    for (auto* list :
         {&result_.upper_row, &result_.upper_column, &result_.lower_row, &result_.lower_column}) {
      for (Columns& rows : *list)
        for (std::vector<ex>& row : rows)
          if ((block_ > 1 || border_ > 0) && row.empty()) row.push_back(0);
    }
    result_.block = static_cast<int>(block_);
    result_.upper_rank = static_cast<int>(result_.upper_row[1][0].size());
    result_.lower_rank = static_cast<int>(result_.lower_row[1][0].size());
    result_.found = true;
  }

  Chain& chain_;
  const Weights& weights_;
  const std::string& prefix_;
  Definitions& definitions_;
  int n_, first_own_;  // links; number of the first definition made here
  size_t block_, border_, links_;
  Linearisation linearisation_;
  std::vector<std::string> down_, up_;  // what is carried
  std::vector<Columns> B_ = table(down_.size()), B_value_ = B_, B_before_ = B_, Hx_ = B_;
  std::vector<Columns> G_ = table(up_.size()), G_before_ = G_, G_after_ = G_, Hy_ = G_;
  std::vector<Columns> S_{links_ + 1, Columns(up_.size(), std::vector<ex>(down_.size()))};
  std::vector<Columns> D_ = table(block_), below_ = D_, above_ = D_;
  std::map<Basis, OfLinks> chord_columns_;  // what equations have of each force along a chord
  std::set<int> sums_;
  std::vector<Columns> P_ = B_, C_ = B_, V_ = G_;  // rows and columns of the triangles
  std::vector<bool> keep_lower_ = std::vector<bool>(down_.size()),
                    keep_upper_ = std::vector<bool>(up_.size());  // what some link has
  Quasiseparable result_;
};

}  // namespace

Quasiseparable find_structure(Chain& chain, const Weights& weights, const std::string& prefix,
                              Moving moving) {
  try {
    return StructureSearch(chain, weights, prefix, moving).find();
  } catch (const NotOfThisForm& why) {
    Quasiseparable none;
    none.reason = why.what();
    return none;
  }
}

}  // namespace catena
