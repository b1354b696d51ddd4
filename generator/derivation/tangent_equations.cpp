// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/tangent_equations.hpp"

namespace catena {

using GiNaC::ex;

namespace {

// What the equations of one link are made of; vectors by axis.
struct LinkEquations {
  std::vector<ex> q, direction, force;
  ex scale;  // 1 / |q|
  ex square_acceleration, square_force;
};

LinkEquations link_of(Chain& chain, int i) {
  Definitions& definitions = chain.definitions();
  LinkEquations link;
  for (const Axis axis : chain.axes()) {
    link.q.push_back(definitions.input("direction" + ending(axis), i));
    link.direction.push_back(chain.directions()[axis][static_cast<size_t>(i)]);
    link.force.push_back(chain.direction_forces()[axis][static_cast<size_t>(i)]);
  }
  link.scale = definitions.input("direction_scale", i);
  link.square_acceleration = definitions.input("direction_square_acceleration", i);
  link.square_force = definitions.input("direction_square_force", i);
  return link;
}

ex value_of(const Definitions& definitions, const ex& symbol) {
  return definitions[definitions.number_of(symbol)].value;
}

// The inertia of q along itself, after the proof that r is what the header says.
ex proved_inertia_along(Chain& chain, const LinkEquations& link, int i) {
  Definitions& definitions = chain.definitions();
  ex scale_force = 0;
  for (const Axis axis : chain.axes()) {
    const size_t row = static_cast<size_t>(axis) * static_cast<size_t>(chain.links());
    const ex r = chain.residual()[row + static_cast<size_t>(i) - 1];
    const ex other = r - link.scale * link.force[axis] - 2 * link.q[axis] * link.square_force;
    if (!other.expand().is_zero()) throw NotOfThisForm("an equation is not that of a direction");
    scale_force += link.q[axis] * link.force[axis];
  }
  const ex force = value_of(definitions, link.square_force);
  const ex inertia = force.diff(GiNaC::ex_to<GiNaC::symbol>(link.square_acceleration));
  ex other = force - inertia * link.square_acceleration;
  for (const int number : definitions.symbols_of(other))
    if (definitions[number].family == "direction_scale_force")
      other = other.subs(definitions[number].symbol == definitions[number].value);
  other += GiNaC::pow(link.scale, 3) * scale_force / 2;
  if (!other.expand().is_zero()) throw NotOfThisForm("|q|^2 has a force of its own");
  return definitions.named(4 * inertia * definitions.input("direction_square", i), "along", i);
}

// [k][axis]
std::vector<std::vector<ex>> tangents_of(Definitions& definitions, const LinkEquations& link,
                                         int i) {
  const ex &x = link.direction[kSide], &y = link.direction[kAcross], &z = link.direction[kDown];
  const ex sign = definitions.define("tangent_sign", i, sign_or_one(z));
  const ex share = definitions.define("tangent_share", i, -1 / (sign + z));
  const ex both = definitions.define("tangent_product", i, x * y * share);
  const std::vector<std::vector<ex>> values = {{1 + sign * x * x * share, -sign * x, sign * both},
                                               {both, -y, sign + y * y * share}};
  std::vector<std::vector<ex>> tangents(2);
  for (size_t k = 0; k < 2; ++k) {
    for (const Axis axis : {kSide, kDown, kAcross})
      tangents[k].push_back(
          definitions.define("tangent_" + std::to_string(k) + ending(axis), i, values[k][axis]));
  }
  return tangents;
}

// E' times rows of three: [k][r]
std::vector<std::vector<ex>> projected(const std::vector<std::vector<ex>>& tangents,
                                       const std::vector<std::vector<ex>>& rows) {
  std::vector<std::vector<ex>> result(2, std::vector<ex>(rows[0].size()));
  for (size_t k = 0; k < 2; ++k)
    for (size_t r = 0; r < rows[0].size(); ++r)
      for (size_t c = 0; c < 3; ++c)
        result[k][r] = (result[k][r] + tangents[k][c] * rows[c][r]).expand();
  return result;
}

void find_by_tangents(Chain& chain, const std::string& prefix, TangentEquations& result) {
  if (chain.border() > 0) throw NotOfThisForm("there are coordinates of no link");
  Definitions& definitions = chain.definitions();
  const Quasiseparable whole =
      find_structure(chain, {1, 0, 0}, prefix + "direction_", Moving::kDirections);
  if (!whole.found) throw NotOfThisForm(whole.reason);
  if (!whole.symmetric) throw NotOfThisForm("the matrix of the directions is not symmetric");
  const auto links = static_cast<size_t>(chain.links());
  Quasiseparable& mass = result.mass;
  for (auto* list : {&mass.lower_row, &mass.lower_column, &mass.diagonal, &result.tangent,
                     &result.along, &result.force, &result.acceleration})
    list->resize(links + 2);
  for (int i = 1; i <= chain.links(); ++i) {
    const auto at = static_cast<size_t>(i);
    for (const auto* beside : {&whole.below, &whole.above})
      for (const auto& row : (*beside)[at])
        for (const ex& entry : row)
          if (!entry.is_zero()) throw NotOfThisForm("inertia of joints couples neighbours besides");
    const LinkEquations link = link_of(chain, i);
    result.along[at] = {{proved_inertia_along(chain, link, i)}};
    const auto& tangents = result.tangent[at] = tangents_of(definitions, link, i);
    // Names by the place in the block, with 1 / |q|.
    const auto scaled = [&](const char* what, const std::vector<std::vector<ex>>& entries) {
      std::vector<std::vector<ex>> named = entries;
      for (size_t a = 0; a < entries.size(); ++a)
        for (size_t b = 0; b < entries[a].size(); ++b)
          named[a][b] =
              definitions.define(prefix + what + "_" + std::to_string(a) + "_" + std::to_string(b),
                                 i, link.scale * entries[a][b]);
      return named;
    };
    mass.lower_row[at] = projected(tangents, scaled("row", whole.lower_row[at]));
    mass.lower_column[at] = projected(tangents, scaled("column", whole.lower_column[at]));
    // F_ii = (its first entry) 1 + rest, E' E = 1
    std::vector<std::vector<ex>> rest = whole.diagonal[at], turned(3);
    const ex first = rest[0][0];
    for (size_t a = 0; a < 3; ++a)
      for (size_t b = 0; b <= a; ++b)
        rest[a][b] = rest[b][a] = (rest[a][b] - (a == b ? first : ex(0))).expand();
    const auto left = scaled("turned_diagonal", projected(tangents, scaled("diagonal", rest)));
    for (size_t c = 0; c < 3; ++c)
      for (size_t k = 0; k < 2; ++k) turned[c].push_back(left[k][c]);
    mass.diagonal[at] = projected(tangents, turned);
    const ex equal = definitions.define(prefix + "diagonal", i, link.scale * link.scale * first);
    std::vector<std::vector<ex>> force;
    for (const ex& component : link.force) force.push_back({link.scale * component});
    result.force[at] = projected(tangents, force);
    for (size_t k = 0; k < 2; ++k) mass.diagonal[at][k][k] += equal;
    for (const ex& component : link.q)
      result.acceleration[at].push_back(
          {-GiNaC::pow(link.scale, 2) / 2 * link.square_acceleration * component});
  }
  mass.block = 2;
  mass.upper_rank = mass.lower_rank = whole.lower_rank;
  mass.found = mass.symmetric = true;
}

}  // namespace

TangentEquations find_tangent_equations(Chain& chain, const std::string& prefix) {
  TangentEquations result;
  try {
    find_by_tangents(chain, prefix, result);
  } catch (const NotOfThisForm& why) {
    result = {};
    result.mass.reason = why.what();
  }
  return result;
}

}  // namespace catena
