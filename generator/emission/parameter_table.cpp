// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/parameter_table.hpp"

#include <limits>
#include <string_view>

namespace catena {

namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct ChainFamily {
  const char *family, *unit, *description;
  double default_value, lower;
};

constexpr ChainFamily kPerLink[] = {
    {"length", "m", "length of link", kNone, 0},
    {"mass", "kg", "mass of link", kNone, 0},
    {"inertia", "kg m^2", "rotational inertia about its own centre of link", kNone, 0},
    {"stiffness", "N m/rad", "stiffness of joint", kNone, 0},
    {"damping", "N m s/rad", "damping of joint", kNone, 0},
    {"torque", "N m", "external torque on the angle of link", 0, -kInfinity},
};
constexpr ChainFamily kShared[] = {
    {"load_mass", "kg", "mass of the load at the free end", kNone, 0},
    {"gravity", "m/s^2", "acceleration of gravity", 9.81, -kInfinity},
};

// The coordinates of the constraint of a held place: twice integrated, the force that holds it, with the
// opposite sign.
std::vector<std::string> hold_names(const HeldEnd& held) {
  if (!held.holds()) return {};
  const std::string name = held.named("hold");
  return {name + "_side", name + "_down", name + "_across"};
}

// Torques act on the angles of the plane.
bool has_family(const Description& description, const ChainFamily& row) {
  return description.space == Space::kPlane || std::string_view(row.family) != "torque";
}

// The chain's own coordinates.
std::vector<QuantityRow> chain_coordinates(const Description& description) {
  if (description.space == Space::kPlane) return {{"theta", "rad"}};
  return {{"direction_side", "1"}, {"direction_down", "1"}, {"direction_across", "1"}};
}

int copies(const EffectParameter& parameter, int links) {
  return parameter.scope == Scope::kModel ? 1 : links;
}

int copies(const ExtraState& state, int links) { return state.at == Place::kJoint ? links : 1; }

// What follows the name of a state: in space that of a joint is a vector.
std::vector<std::string> components_of(const ExtraState& state, const Description& description) {
  if (description.space == Space::kPlane || state.at == Place::kLoad) return {""};
  return {"_side", "_down", "_across"};
}

}  // namespace

TableFamilies table_families(const Description& description) {
  TableFamilies table;
  const auto chain_parameters = [&](const auto& rows, bool of_each_link) {
    for (const ChainFamily& row : rows) {
      if (!has_family(description, row)) continue;
      table.parameters.push_back(
          {{row.family, row.unit, row.description, row.default_value, row.lower, kInfinity, kNone},
           of_each_link,
           of_each_link});
    }
  };
  chain_parameters(kPerLink, true);
  chain_parameters(kShared, false);
  for (const QuantityRow& row : chain_coordinates(description))
    table.coordinates.push_back({row, true});
  for (const Effect& effect : description.effects) {
    const std::string id = effect.id + ".";
    for (const EffectParameter& parameter : effect.parameters) {
      table.parameters.push_back(
          {{id + parameter.name, parameter.unit, parameter.description, parameter.default_value,
            parameter.lower, parameter.upper, parameter.neutral},
           parameter.scope != Scope::kModel});
    }
    for (const Coordinate& coordinate : effect.coordinates)
      if (coordinate.at == Place::kLink)
        table.coordinates.push_back({{id + coordinate.name, coordinate.unit}, true});
    for (const std::string& name : hold_names(effect.held_end))
      table.coordinates.push_back({{name, "N s^2"}});
    for (const ExtraState& state : effect.states) {
      const std::string number = state.at == Place::kPivot ? "_1" : "";
      for (const std::string& component : components_of(state, description))
        table.states.push_back(
            {{std::string(id).append(state.name).append(component).append(number), state.unit},
             state.at == Place::kJoint});
    }
    if (effect.held_end.twists()) table.states.push_back({{id + "twist_of_path", "rad"}});
    for (const SignalChannel& signal : effect.signals)
      table.signals.push_back({{id + signal.name, signal.unit}});
  }
  for (const Effect& effect : description.effects)
    for (const Coordinate& coordinate : effect.coordinates)
      if (coordinate.at == Place::kLoad)
        table.coordinates.push_back({{effect.id + "." + coordinate.name, coordinate.unit}});
  for (const bool of_each_link : {false, true})
    for (const Effect& effect : description.effects)
      for (const EventValue& event : effect.events)
        if (is_of_each_link(event.at) == of_each_link)
          table.events.push_back({{effect.id + "." + event.name, event.unit}, of_each_link});
  return table;
}

ModelTable model_table(const Description& description, int links) {
  const TableFamilies families = table_families(description);
  ModelTable table;
  const auto add = [&](auto& rows, const auto& listed) {
    for (const auto& family : listed) {
      for (int i = 1; i <= (family.of_each_link ? links : 1); ++i) {
        auto& row = rows.emplace_back(family.row);
        if (family.of_each_link) row.name += "_" + std::to_string(i);
        if constexpr (requires { row.description; }) {
          if (family.description_numbered) row.description += " " + std::to_string(i);
        }
      }
    }
  };
  add(table.parameters, families.parameters);
  add(table.coordinates, families.coordinates);
  add(table.states, families.states);
  add(table.signals, families.signals);
  add(table.events, families.events);
  return table;
}

std::vector<InputPlace> input_places(const Description& description, int links) {
  std::vector<InputPlace> places;
  int p = 0, q = 0, z = 0, u = 0;
  const auto parameter = [&](const std::string& family, int count, bool indexed) {
    places.push_back({family, 'p', p, count, indexed});
    p += count;
  };
  const auto coordinate = [&](const std::string& family, bool of_each_link) {
    const int count = of_each_link ? links : 1;
    places.push_back({family, 'q', q, count, of_each_link});
    places.push_back({family + "_dot", 'v', q, count, of_each_link});
    places.push_back({family + "_ddot", 'a', q, count, of_each_link});
    q += count;
  };
  for (const ChainFamily& row : kPerLink)
    if (has_family(description, row)) parameter(row.family, links, true);
  for (const ChainFamily& row : kShared) parameter(row.family, 1, false);
  for (const QuantityRow& row : chain_coordinates(description)) coordinate(row.name, true);
  for (const Effect& effect : description.effects) {
    const auto name = [&](const auto& what) { return effect.id + "_" + what.name; };
    for (const EffectParameter& row : effect.parameters) {
      parameter(name(row), copies(row, links), row.scope != Scope::kModel);
    }
    for (const Coordinate& row : effect.coordinates)
      if (row.at == Place::kLink) coordinate(name(row), true);
    for (const std::string& name : hold_names(effect.held_end)) coordinate(name, false);
    for (const ExtraState& state : effect.states) {
      for (const std::string& component : components_of(state, description)) {
        places.push_back(
            {name(state) + component, 'z', z, copies(state, links), state.at != Place::kLoad});
        z += copies(state, links);
      }
    }
    if (effect.held_end.twists())
      places.push_back({effect.id + "_twist_of_path", 'z', z++, 1, false});
    for (const SignalChannel& signal : effect.signals) {
      for (const char* what : {"", "_rate", "_acceleration"}) {
        places.push_back({name(signal) + what, 'u', u++, 1, false});
      }
    }
  }
  for (const Effect& effect : description.effects)
    for (const Coordinate& row : effect.coordinates)
      if (row.at == Place::kLoad) coordinate(effect.id + "_" + row.name, false);
  return places;
}

Inputs inputs_of(const Description& description, int links, const std::string& point,
                 bool differentials, Type type) {
  Inputs inputs;
  const std::string prefix = differentials ? "d_" : "";
  const auto argument = [&](char member) {
    return Array{point, (differentials && point.empty() ? "d" : "") + std::string(1, member), {}};
  };
  for (const InputPlace& place : input_places(description, links)) {
    const std::string name = prefix + place.family;
    inputs[name] = Input{place.indexed ? InputKind::kArray : InputKind::kEntry, type, name,
                         argument(place.member), place.offset};
  }
  inputs[prefix + "time"] = Input{InputKind::kNumber, type, prefix + "time", argument('t'), {}};
  if (!differentials && description.space == Space::kPlane) {
    inputs["sine"] = inputs["cosine"] =
        Input{InputKind::kSinesAndCosines, type, "sine", argument('q'), links};
  }
  inputs["pi"] = Input{InputKind::kPi, Type::kScalar, "pi", {}, {}};
  return inputs;
}

}  // namespace catena
