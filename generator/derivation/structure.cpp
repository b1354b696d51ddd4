// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/structure.hpp"

#include <functional>
#include <initializer_list>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

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

void find(Chain& chain, const Weights& weights, const std::string& prefix, Moving moving,
          Quasiseparable& result) {
  Definitions& definitions = chain.definitions();
  const int n = chain.links(), before = definitions.size();
  const size_t block = chain.axes().size() == 2 ? 1 : 3;
  const size_t inner = block * static_cast<size_t>(n), border = chain.border();
  if (chain.coordinates().size() != inner + border) {
    throw NotOfThisForm("there are coordinates besides one angle a link");
  }
  Linearisation linearisation(chain, weights, moving);
  const std::vector<ex>& equations = linearisation.equations();
  const std::vector<std::string> down(linearisation.down().begin(), linearisation.down().end());
  const std::vector<std::string> up(linearisation.up().begin(), linearisation.up().end());
  const size_t links = static_cast<size_t>(n) + 2;
  const auto table = [&](size_t columns) {
    return std::vector<Columns>(links, Columns(block, std::vector<ex>(columns)));
  };
  const auto perturbation = [](size_t component, int i) {
    return Basis{Basis::kPerturbation, "", i, static_cast<int>(component)};
  };
  // Names of what belongs to a row, or to a row and a column, of a block.
  const auto ending = [&](auto a) { return block == 1 ? "" : "_" + std::to_string(a); };
  const auto joined = [&](std::initializer_list<std::string_view> parts) {
    std::string name = prefix;
    for (const std::string_view part : parts) name += part;
    return name;
  };
  auto B = table(down.size()), B_value = B, B_before = B, Hx = B;
  auto G = table(up.size()), G_before = G, G_after = G, Hy = G;
  std::vector<Columns> S(links + 1, Columns(up.size(), std::vector<ex>(down.size())));
  auto D = table(block), below = D, above = D;
  // What the equation of link i has of each force along a chord.
  std::map<Basis, OfLinks> chord_columns;

  for (int i = 1; i <= n; ++i) {
    for (size_t f = 0; f < down.size(); ++f) {
      const Form form = linearisation.carried(down[f], i);
      require_only(form, down[f], i, false);
      for (size_t b = 0; b < block; ++b) {
        const std::string name = prefix + down[f] + "_gain" + ending(b);
        B_value[i][b][f] = definitions.named(entry(form, perturbation(b, i)), name, i);
        B[i][b][f] = block == 1 ? definitions.define(name, i, B_value[i][b][f])
                                : linearisation.one_name(name, i, B_value[i][b][f]);
        B_before[i][b][f] =
            linearisation.one_name(name + "_before", i, entry(form, perturbation(b, i - 1)));
      }
    }
    for (size_t a = 0; a < block; ++a) {
      const size_t row = a * static_cast<size_t>(n) + static_cast<size_t>(i) - 1;
      Form r = linearisation.at_link(equations[row], i);
      for (auto term = r.begin(); term != r.end();) {
        if (term->first.kind != Basis::kChordForce) {
          ++term;
          continue;
        }
        OfLinks& column =
            chord_columns.try_emplace(term->first, links, std::vector<ex>(block)).first->second;
        column[i][a] =
            definitions.define(joined({term->first.family, "_column", ending(a)}), i, term->second);
        term = r.erase(term);
      }
      for (auto& [basis, coefficient] : r) {
        const std::string by = basis.family.empty() ? ending(basis.component) : basis.family;
        const std::string place = std::to_string(basis.index - i + 1);
        if (block > 1)
          coefficient = linearisation.one_name(
              joined({"residual", ending(a), "_by_", by, "_", place}), i, coefficient);
      }
      for (size_t b = 0; b < block; ++b) {
        D[i][a][b] = entry(r, perturbation(b, i));
        below[i][a][b] = definitions.named(entry(r, perturbation(b, i - 1)),
                                           joined({"below", ending(a), ending(b)}), i);
        above[i][a][b] = definitions.named(entry(r, perturbation(b, i + 1)),
                                           joined({"above", ending(a), ending(b)}), i);
      }
      for (size_t f = 0; f < down.size(); ++f)
        Hx[i][a][f] = entry(r, {Basis::kCarriedDown, down[f], i - 1});
      for (size_t g = 0; g < up.size(); ++g)
        Hy[i][a][g] = entry(r, {Basis::kCarriedUp, up[g], i + 1});
    }
  }
  // What a form that belongs to no link has of component a of link i.
  const auto by_link = [&](const Form& form, size_t a, int i) {
    ex sum = entry(form, perturbation(a, i));
    for (size_t f = 0; f < down.size(); ++f)
      for (auto carried = form.lower_bound({Basis::kCarriedDown, down[f], i});
           carried != form.end() && carried->first.family == down[f]; ++carried)
        sum += carried->second *
               (B[i][a][f] + (carried->first.index > i ? B_before[i + 1][a][f] : ex(0)));
    return sum;
  };
  result.border = static_cast<int>(border);
  result.border_column = result.border_row = table(border);
  result.corner.assign(border, std::vector<ex>(border));
  const auto numbered = [](size_t k) { return "_" + std::to_string(k); };
  for (size_t k = 0; k < border; ++k) {
    Differential along = along_border(chain, weights, inner + k);
    const Form row = linearisation.of_no_link(equations[inner + k]);
    for (int i = 1; i <= n; ++i) {
      for (size_t a = 0; a < block; ++a) {
        const ex& r = equations[a * static_cast<size_t>(n) + static_cast<size_t>(i) - 1];
        result.border_column[i][a][k] =
            definitions.named(along.of(r), joined({"border_column", ending(a), numbered(k)}), i);
        result.border_row[i][a][k] = definitions.named(
            by_link(row, a, i), joined({"border_row", ending(a), numbered(k)}), i);
      }
    }
    for (size_t l = 0; l < border; ++l)
      result.corner[l][k] = definitions.named(
          along.of(equations[inner + l]), joined({"corner", numbered(l), numbered(k)}), kNoIndex);
  }
  std::set<int> sums;
  for (int i = n; i >= 1; --i) {
    for (size_t g = 0; g < up.size(); ++g) {
      const Form form = linearisation.carried(up[g], i);
      require_only(form, up[g], i, true);
      for (size_t b = 0; b < block; ++b) {
        const auto gain = [&](const char* where, int of) {
          return linearisation.one_name(joined({up[g], "_gain", where, ending(b)}), i,
                                        entry(form, perturbation(b, of)));
        };
        G[i][b][g] = entry(form, perturbation(b, i));
        G_before[i][b][g] = gain("_before", i - 1);
        G_after[i][b][g] = gain("_after", i + 1);
      }
      for (size_t f = 0; f < down.size(); ++f) {
        const ex F = entry(form, {Basis::kCarriedDown, down[f], i - 1});
        S[i][g][f] = definitions.define(prefix + up[g] + "_per_" + down[f], i, S[i + 1][g][f] + F);
        // With one summand it is no sum, but perhaps a name that something else has, too.
        const bool is_sum = !F.is_zero() && !S[i + 1][g][f].is_zero();
        if (is_sum && GiNaC::is_a<GiNaC::symbol>(S[i][g][f]))
          sums.insert(definitions.number_of(S[i][g][f]));
      }
    }
  }
  // Rows and columns of the two triangles, without those that are zero for every link.
  auto P = table(down.size()), C = P, V = table(up.size());
  std::vector<bool> keep_lower(down.size()), keep_upper(up.size());
  for (int i = 1; i <= n; ++i) {
    for (size_t a = 0; a < block; ++a) {
      std::vector<ex> written_out = D[i][a];
      for (size_t f = 0; f < down.size(); ++f) {
        P[i][a][f] = Hx[i][a][f];
        for (size_t g = 0; g < up.size(); ++g) P[i][a][f] += Hy[i][a][g] * S[i + 1][g][f];
        P[i][a][f] = P[i][a][f].expand();
        if (i > 1 && !P[i][a][f].is_zero()) keep_lower[f] = true;
        const ex below_here = P[i][a][f] - Hx[i][a][f];
        for (size_t b = 0; b < block; ++b) {
          D[i][a][b] += below_here * B[i][b][f];
          written_out[b] += below_here * B_value[i][b][f];
          below[i][a][b] -= Hx[i][a][f] * B_before[i][b][f];
        }
        C[i][a][f] = B[i][a][f];
        if (!B_before[i + 1][a][f].is_zero())
          C[i][a][f] = definitions.define(joined({down[f], "_gain_of_both", ending(a)}), i,
                                          B[i][a][f] + B_before[i + 1][a][f]);
      }
      if (block == 1) {
        // sin^2 + cos^2 = 1 may make the written-out form shorter.
        const ex shorter = without_sine_squares(definitions, written_out[0]);
        if (length_of(shorter) <= length_of(D[i][0][0].expand())) D[i][0][0] = shorter;
      }
      for (size_t g = 0; g < up.size(); ++g) {
        V[i][a][g] = G[i][a][g] + G_before[i + 1][a][g] + G_after[i - 1][a][g];
        for (size_t f = 0; f < down.size(); ++f)
          V[i][a][g] += S[i + 1][g][f] * B[i][a][f] + S[i + 2][g][f] * B_before[i + 1][a][f];
        V[i][a][g] = V[i][a][g].expand();
        for (size_t b = 0; b < block; ++b) {
          above[i][a][b] -= Hy[i][a][g] * G_after[i][b][g];
          D[i][a][b] += Hy[i][a][g] * G_before[i + 1][b][g];
          for (size_t f = 0; f < down.size(); ++f)
            D[i][a][b] += Hy[i][a][g] * S[i + 2][g][f] * B_before[i + 1][b][f];
        }
        if (i < n && !Hy[i][a][g].is_zero()) keep_upper[g] = true;
      }
    }
  }
  for (size_t f = 0; f < down.size(); ++f) {
    bool column = false;
    for (int i = 1; i < n; ++i)
      for (size_t b = 0; b < block; ++b) column = column || !C[i][b][f].is_zero();
    keep_lower[f] = keep_lower[f] && column;
  }
  // Symmetric if the rows of each triangle are the columns of the other, coefficient by
  // coefficient, with what was named here written out but for the sums over links.
  const std::function<ex(const ex&)> open = [&](const ex& e) {
    GiNaC::exmap values;
    for (const int number : definitions.symbols_of(e)) {
      if (number >= before && !sums.contains(number) && !definitions[number].is_input)
        values[definitions[number].symbol] = definitions[number].value;
    }
    return values.empty() ? e : open(e.subs(values, GiNaC::subs_options::no_pattern).expand());
  };
  const auto equal = [&](const ex& a, const ex& b) {
    return a.is_equal(b) || (open(a) - open(b)).expand().is_zero();
  };
  for (auto* list :
       {&result.upper_row, &result.upper_column, &result.lower_row, &result.lower_column}) {
    list->assign(links, Columns(block));
  }
  result.diagonal = table(block);
  result.symmetric = true;
  for (int i = 1; i <= n; ++i) {
    bool same = true;
    for (size_t a = 0; a < block; ++a) {
      const auto named = [&](const ex& e, const std::string& what) {
        return definitions.named(e, prefix + what, i);
      };
      std::vector<ex>& lower_row = result.lower_row[i][a];
      std::vector<ex>& upper_row = result.upper_row[i][a];
      for (size_t f = 0; f < down.size(); ++f) {
        if (!keep_lower[f]) continue;
        lower_row.push_back(named(P[i][a][f], "lower_row" + ending(a)));
        result.lower_column[i][a].push_back(C[i][a][f]);
      }
      for (size_t g = 0; g < up.size(); ++g) {
        if (!keep_upper[g]) continue;
        upper_row.push_back(named(Hy[i][a][g], "upper_row" + ending(a)));
        result.upper_column[i][a].push_back(named(V[i][a][g], "upper_column" + ending(a)));
      }
      for (size_t b = 0; b < block; ++b)
        result.diagonal[i][a][b] = named(D[i][a][b], "diagonal" + ending(a) + ending(b));
      same = same && lower_row.size() == upper_row.size();
      for (size_t r = 0; same && r < lower_row.size(); ++r) {
        same = (i == n || equal(result.lower_column[i][a][r], upper_row[r])) &&
               (i == 1 || equal(lower_row[r], result.upper_column[i][a][r]));
      }
      for (size_t b = 0; same && b < block; ++b)
        same = i == 1 || equal(below[i][a][b], above[i - 1][b][a]);
      for (size_t b = 0; same && b < a; ++b)
        same = equal(result.diagonal[i][a][b], result.diagonal[i][b][a]);
    }
    for (size_t a = 0; a < block; ++a)
      for (size_t k = 0; same && k < border; ++k)
        same = equal(result.border_row[i][a][k], result.border_column[i][a][k]);
    result.symmetric = result.symmetric && same;
  }
  for (size_t k = 0; k < border; ++k)
    for (size_t l = 0; l < k; ++l)
      result.symmetric = result.symmetric && equal(result.corner[k][l], result.corner[l][k]);
  for (int i = 1; i <= n; ++i)
    for (size_t a = 0; a < block; ++a)
      for (size_t b = 0; b < block; ++b) {
        below[i][a][b] = definitions.named(below[i][a][b], prefix + "below", i);
        above[i][a][b] = definitions.named(above[i][a][b], prefix + "above", i);
      }
  result.below = below;
  result.above = above;
  for (const auto& [force, form] : linearisation.chord_forces()) {
    OfLinks row(links, std::vector<ex>(block));
    for (int i = 1; i <= n; ++i)
      for (size_t a = 0; a < block; ++a)
        row[i][a] =
            definitions.define(joined({force.family, "_row", ending(a)}), i, by_link(form, a, i));
    add_product(chord_columns.at(force), row, result);
  }
  if (!chain.path().is_zero() && !weights.velocity.is_zero())
    add_path(chain, weights, prefix, linearisation, result);
  // One link has nothing to couple. Blocks, and what has a border, have arrays all the same, of zeros.
  for (auto* list :
       {&result.upper_row, &result.upper_column, &result.lower_row, &result.lower_column}) {
    for (Columns& rows : *list)
      for (std::vector<ex>& row : rows)
        if ((block > 1 || border > 0) && row.empty()) row.push_back(0);
  }
  result.block = static_cast<int>(block);
  result.upper_rank = static_cast<int>(result.upper_row[1][0].size());
  result.lower_rank = static_cast<int>(result.lower_row[1][0].size());
  result.found = true;
}

}  // namespace

Quasiseparable find_structure(Chain& chain, const Weights& weights, const std::string& prefix,
                              Moving moving) {
  Quasiseparable result;
  try {
    find(chain, weights, prefix, moving, result);
  } catch (const NotOfThisForm& why) {
    result = {};
    result.reason = why.what();
  }
  return result;
}

}  // namespace catena
