// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/tangent_equations.hpp"

namespace catena {

using GiNaC::ex;

namespace {

// What the equations of one link are made of; vectors by axis.
struct LinkEquations {
  std::vector<ex> q, rate, direction, direction_rate, force;
  ex scale;  // 1 / |q|
  ex square_acceleration, square_force;
};

LinkEquations link_of(Chain& chain, int i) {
  Definitions& definitions = chain.definitions();
  LinkEquations link;
  for (const Axis axis : chain.axes()) {
    link.q.push_back(definitions.input("direction" + ending(axis), i));
    link.rate.push_back(chain.rate(link.q.back()));
    link.direction.push_back(chain.directions()[axis][static_cast<size_t>(i)]);
    link.direction_rate.push_back(chain.rate(link.direction.back()));
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

ex product(const std::vector<ex>& a, const std::vector<ex>& b) {
  ex sum = 0;
  for (size_t c = 0; c < a.size(); ++c) sum += a[c] * b[c];
  return sum;
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

// The place r of the one entry of each row of a block, if they are equal and the others zero.
std::vector<size_t> places_of_one_number(const std::vector<std::vector<ex>>& block) {
  std::vector<size_t> places;
  for (const std::vector<ex>& row : block)
    for (size_t r = 0; r < row.size(); ++r)
      if (!row[r].is_zero()) places.push_back(r);
  if (places.size() != block.size() || block.size() != block[0].size()) return {};
  for (size_t a = 0; a < places.size(); ++a)
    if (!block[a][places[a]].is_equal(block[0][places[0]])) return {};
  return places;
}

// Takes the numbers where every block is one.
void find_numbers(const Quasiseparable& whole, TangentEquations& result) {
  const size_t end = whole.diagonal.size() - 1;
  const std::vector<size_t> places = places_of_one_number(whole.lower_row[1]), along = {0, 1, 2};
  for (size_t i = 1; i < end; ++i)
    if (places.empty() || places_of_one_number(whole.lower_row[i]) != places ||
        places_of_one_number(whole.lower_column[i]) != places ||
        places_of_one_number(whole.diagonal[i]) != along)
      return;
  result.isotropic = true;
  const auto take = [&](const Quasiseparable::Entries& blocks, size_t place,
                        Quasiseparable::Entries& numbers) {
    numbers.resize(blocks.size());
    for (size_t i = 1; i < end; ++i) numbers[i] = {{blocks[i][0][place]}};
  };
  take(whole.lower_row, places[0], result.number_of_row);
  take(whole.lower_column, places[0], result.number_of_column);
  take(whole.diagonal, 0, result.number_of_diagonal);
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
                     &result.size, &result.along, &result.force, &result.acceleration})
    list->resize(links + 2);
  // What is known of e'' in its place.
  Substitution known(definitions, "_known");
  for (int i = 1; i <= chain.links(); ++i) {
    const LinkEquations link = link_of(chain, i);
    const ex turning =
        definitions.define("turning_square", i, product(link.direction_rate, link.direction_rate));
    for (const Axis axis : chain.axes())
      known.set(chain.rate(link.direction_rate[axis]),
                definitions.define("unit" + ending(axis) + "_acceleration_known", i,
                                   -turning * link.direction[axis]));
  }
  for (int i = 1; i <= chain.links(); ++i) {
    const auto at = static_cast<size_t>(i);
    for (const auto* beside : {&whole.below, &whole.above})
      for (const auto& row : (*beside)[at])
        for (const ex& entry : row)
          if (!entry.is_zero()) throw NotOfThisForm("inertia of joints couples neighbours besides");
    const LinkEquations link = link_of(chain, i);
    result.along[at] = {{proved_inertia_along(chain, link, i)}};
    const auto& tangents = result.tangent[at] = tangents_of(definitions, link, i);
    result.size[at] = {{definitions.define("direction_size", i,
                                           definitions.input("direction_square", i) * link.scale)}};
    // Names by the place in the block.
    const auto named = [&](const char* what, std::vector<std::vector<ex>> entries) {
      for (size_t a = 0; a < entries.size(); ++a)
        for (size_t b = 0; b < entries[a].size(); ++b)
          entries[a][b] = definitions.define(
              prefix + what + "_" + std::to_string(a) + "_" + std::to_string(b), i, entries[a][b]);
      return entries;
    };
    mass.lower_row[at] = projected(tangents, named("row", whole.lower_row[at]));
    mass.lower_column[at] = projected(tangents, named("column", whole.lower_column[at]));
    // F_ii = (its first entry) 1 + rest, E' E = 1
    std::vector<std::vector<ex>> rest = whole.diagonal[at], turned(3);
    const ex first = rest[0][0];
    for (size_t a = 0; a < 3; ++a)
      for (size_t b = 0; b <= a; ++b)
        rest[a][b] = rest[b][a] = (rest[a][b] - (a == b ? first : ex(0))).expand();
    const auto left = named("turned_diagonal", projected(tangents, named("diagonal", rest)));
    for (size_t c = 0; c < 3; ++c)
      for (size_t k = 0; k < 2; ++k) turned[c].push_back(left[k][c]);
    mass.diagonal[at] = projected(tangents, turned);
    const ex equal = definitions.define(prefix + "diagonal", i, first);
    for (size_t k = 0; k < 2; ++k) mass.diagonal[at][k][k] += equal;
    std::vector<std::vector<ex>> force;
    for (const ex& component : link.force) force.push_back({known.of(component)});
    result.force[at] = projected(tangents, force);
    const ex square = definitions.define("direction_rate_square", i, product(link.rate, link.rate));
    const ex growing = definitions.input("direction_square_velocity", i);  // 2 q.q'
    for (const Axis axis : chain.axes())
      result.acceleration[at].push_back(
          {(link.scale * (growing * link.direction_rate[axis] - square * link.direction[axis]))
               .expand()});
  }
  find_numbers(whole, result);
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
