// SPDX-License-Identifier: BSD-3-Clause
#include "description/description.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "common/toml_quoted.hpp"
#include "common/toml_reader.hpp"
#include "common/whole_file.hpp"
#include "description/effect_checks.hpp"
#include "description/expression_syntax.hpp"

namespace catena {
namespace {

const std::string kBuiltInPrefix = "built in: ";

Effect named_effect(const TomlTable& file, const std::string& name) {
  if (name.ends_with(".toml")) {
    const auto path = std::filesystem::path(file.file()).parent_path() / name;
    if (!is_file(path)) {
      file.fail("effects", "there is no file \"" + shortened(path.string(), kLongestPath) +
                               "\"; effects are given by path relative to this file, or by the id "
                               "of a built-in one");
    }
    return read_effect(path);
  }
  const auto ids = built_in_effect_ids();
  if (std::find(ids.begin(), ids.end(), name) == ids.end()) {
    file.fail("effects", in_quotes(name) + " is not a built-in effect" + suggestion(name, ids) +
                             " A file is given by its path, ending in .toml");
  }
  return built_in_effect(name);
}

bool is_identifier(const std::string& text) {
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return std::isalnum(c) || c == '_'; });
}

Description description_in(const TomlTable& file) {
  Description description;
  description.source_file = file.file();
  description.id = file.text("id");
  if (!is_identifier(description.id)) {
    file.fail("id", in_quotes(description.id) +
                        " is not a name; a name is a letter, then letters, digits, _");
  }
  for (const long count : file.integers("links")) {
    if (count < 1 || count > 100000) {
      file.fail("links", std::to_string(count) + " is not a link count; give whole numbers from 1");
    }
    description.links.push_back(static_cast<int>(count));
  }
  description.space = static_cast<Space>(file.choice("space", space_words(), false));
  const auto names = file.texts("effects");
  file.optional_text("title");
  file.optional_text("description");
  file.finish();
  for (const std::string& name : names) description.effects.push_back(named_effect(file, name));
  if (const std::string conflict = conflict_in(description); !conflict.empty()) {
    file.fail("effects", conflict);
  }
  return description;
}

// What of an effect has a meaning in the plane only; empty: nothing.
std::string plane_alone(const Effect& effect) {
  const Sensor& sensor = effect.sensor;
  const auto at = [](const Expression& where, const std::string& why) {
    return where.file + ":" + std::to_string(where.line) + ": " + where.key + ": " + why;
  };
  if (effect.kinematics.extension.given())
    return at(effect.kinematics.extension, "links in space do not stretch yet");
  if (sensor.moves() && !sensor.across.given())
    return at(sensor.side.given() ? sensor.side : sensor.down,
              "it says nothing of what is across; in space a sensor gives `across`, too");
  if (sensor.angle.given() && !sensor.moves())
    return at(sensor.angle, "links have no angle in space");
  for (const Coordinate& coordinate : effect.coordinates)
    if (coordinate.at == Place::kLink)
      return "it adds coordinates to links, which links in space do not have yet";
  std::vector<const Expression*> expressions;
  std::set<std::string> vectors = {"joint_rate"};  // and what may be made of them
  for (const ExtraState& state : effect.states) vectors.insert(state.name);
  for (const Definition& definition : effect.definitions) vectors.insert(definition.name);
  for (const ScalarTerm& term : effect.scalars) {
    const std::set<std::string> names = names_in(term.value);
    if (term.kind == ScalarKind::kTorque &&
        (!(term.at == Place::kJoint || term.at == Place::kPivot) ||
         std::none_of(names.begin(), names.end(),
                      [&](const std::string& name) { return vectors.contains(name); })))
      return at(
          term.value,
          "a torque without joint_rate or a state has no direction in space; a potential or a "
          "dissipation has");
    expressions.push_back(&term.value);
  }
  for (const ForceTerm& force : effect.forces)
    for (const Expression* part : {&force.side, &force.down, &force.across, &force.normal,
                                   &force.tangential, &force.along, &force.value})
      expressions.push_back(part);
  for (const Definition& definition : effect.definitions) expressions.push_back(&definition.value);
  for (const EventValue& event : effect.events) expressions.push_back(&event.value);
  for (const Expression* part : {&sensor.side, &sensor.down, &sensor.across})
    expressions.push_back(part);
  for (const Expression* expression : expressions)
    if (names_in(*expression).contains("angle"))
      return at(*expression,
                "links have no angle in space; velocities and positions have components");
  return "";
}

}  // namespace

Description plain_chain() {
  Description description;
  description.id = "chain";
  description.source_file = kBuiltInPrefix + "chain";
  return description;
}

bool is_plain_chain(const Description& description) {
  return description.effects.empty() && description.space == Space::kPlane;
}

Description read_description(const std::filesystem::path& path) {
  return description_in(TomlTable::read(path, "model"));
}

Description parse_description(const std::string& text, const std::string& name) {
  return description_in(TomlTable::parse(text, name, "model"));
}

std::vector<std::string> space_words() { return {"plane", "3d"}; }

std::string why_not_in(Space space, const Effect& effect) {
  const std::string word = space_words()[static_cast<std::size_t>(space)];
  if (!effect.space.empty() && effect.space != word)
    return "needs space = \"" + effect.space + "\", as its file says, and space is \"" + word +
           "\"";
  if (space == Space::kPlane) {
    if (effect.held_end.holds()) return "holds a point of the cable, which needs space = \"3d\"";
    if (effect.kinematics.load_across.given())
      return "moves the load across the plane, which needs space = \"3d\"";
    if (effect.support.across.given() || effect.support.turns() || effect.support.has_bend_axis())
      return "moves the support across the plane or turns its clamp, which needs space = \"3d\"";
    return "";
  }
  const std::string why = plane_alone(effect);
  return why.empty()
             ? ""
             : "acts in the plane only: " + why + ". Space is \"3d\"; leave one of them away";
}

std::string conflict_in(const Description& description) {
  bool clamped = false, has_axis = false, swings = false;
  std::map<int, std::string> held;  // by link: what holds it
  std::string tension;              // what uses the tension
  for (const Effect& effect : description.effects) {
    if (const std::string why = why_not_in(description.space, effect); !why.empty())
      return in_quotes(effect.id) + " " + why;
    if (effect.support.turns() && clamped)
      return in_quotes(effect.id) +
             " is the second effect that gives the direction of the clamp; leave "
             "one away";
    clamped = clamped || effect.support.turns();
    if (effect.support.has_bend_axis() && has_axis)
      return in_quotes(effect.id) +
             " is the second effect that gives the axis of rest angles; leave one away";
    has_axis = has_axis || effect.support.has_bend_axis();
    if (effect.held_end.holds()) {
      const int link = effect.held_end.link;
      if (!held.emplace(link, effect.id).second)
        return in_quotes(effect.id) + " is the second effect that holds the far end" +
               (link > 0 ? " of link " + std::to_string(link) : "") + ", beside " +
               in_quotes(held.at(link)) + "; leave one away";
    }
    tension = names_in(effect).contains(kSteadyTension) ? effect.id : tension;
    if (!held.empty() && !tension.empty())
      return in_quotes(tension) + " uses " + kSteadyTension +
             ", which is what hangs below a joint; beside " + in_quotes(held.begin()->second) +
             ", which holds the cable, too, it has no meaning. Leave one away";
    swings = swings || effect.moves_load();
    if (!held.empty() && swings)
      return in_quotes(effect.id) +
             ": a cable that is held besides at its support has no load with coordinates of its "
             "own "
             "(per = \"load\"); leave one away";
  }
  // What a held place adds to a model has names of these kinds.
  for (const Effect& effect : description.effects)
    for (const Effect* holding : description.holding())
      for (const char* const taken : {"end", "gap", "hold"})
        if (effect.id == holding->held_end.named(taken))
          return in_quotes(effect.id) +
                 " is a name of what holds the cable; give the effect another id in its file";
  return conflict_between(description.effects);
}

std::string conflict_between(const std::vector<Effect>& effects) {
  std::set<std::string> ids, names;
  std::string conflict;
  for (const Effect& effect : effects) {
    if (!ids.insert(effect.id).second) {
      return in_quotes(effect.id) + " stands there twice; name each effect once";
    }
    // Signals are columns of data by their own names, coordinates and states are told apart alike.
    const auto check = [&](const std::string& name) {
      if (!names.insert(name).second) {
        conflict = "two effects both add " + in_quotes(name) + "; rename one in its file";
      }
    };
    for (const Coordinate& coordinate : effect.coordinates) check(coordinate.name);
    for (const ExtraState& state : effect.states) check(state.name);
    if (effect.held_end.twists()) check("twist_of_path");
    for (const SignalChannel& signal : effect.signals) check(signal.name);
  }
  return conflict;
}

std::string description_text(const Description& description, const std::filesystem::path& folder) {
  std::string text = "format = 1\nkind = \"model\"\nid = \"" + description.id + "\"\n";
  if (!description.links.empty()) {
    text += "links = [";
    for (std::size_t i = 0; i < description.links.size(); ++i) {
      text += (i > 0 ? ", " : "") + std::to_string(description.links[i]);
    }
    text += "]\n";
  }
  if (description.space != Space::kPlane)
    text += "space = \"" + space_words()[static_cast<std::size_t>(description.space)] + "\"\n";
  text += "effects = [";
  for (std::size_t i = 0; i < description.effects.size(); ++i) {
    const Effect& effect = description.effects[i];
    std::string name = effect.id;
    if (!effect.source_file.starts_with(kBuiltInPrefix)) {
      name = std::filesystem::relative(std::filesystem::absolute(effect.source_file),
                                       std::filesystem::absolute(folder))
                 .string();
    }
    text += (i > 0 ? ", " : "") + toml_quoted(name);
  }
  return text + "]\n";
}

void write_description(const Description& description, const std::filesystem::path& path) {
  write_whole_file(path, description_text(description, path.parent_path()));
}

Description copy_as_read(const Description& description, const std::filesystem::path& folder) {
  Description copy = description;
  for (std::size_t i = 0; i < copy.effects.size(); ++i) {
    std::string& source = copy.effects[i].source_file;
    if (source.starts_with(kBuiltInPrefix)) continue;
    const std::filesystem::path file =
        folder / std::to_string(i) / std::filesystem::path(source).filename();
    std::filesystem::create_directories(file.parent_path());
    write_whole_file(file, read_whole_file(source));
    source = file.string();
  }
  copy.source_file = (folder / "model.toml").string();
  write_description(copy, copy.source_file);
  return copy;
}

}  // namespace catena
