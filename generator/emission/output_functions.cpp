// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/function_builder.hpp"

namespace catena {

using GiNaC::ex;

namespace {

std::vector<Output> point_outputs(const Chain& chain, const std::vector<Axis>& axes,
                                  const std::vector<std::string>& arrays, const auto& act) {
  std::vector<Output> outputs;
  for (size_t k = 0; k < chain.position(axes.front()).size(); ++k) {
    for (size_t c = 0; c < axes.size(); ++c)
      outputs.push_back({{"", arrays[c], {}},
                         static_cast<int>(k),
                         ArrayPlace{{}, true, 0},
                         act(chain.position(axes[c])[k])});
  }
  return outputs;
}

}  // namespace

void FunctionBuilder::energy() {
  std::vector<Output> outputs;
  int item_index = 0;
  for (const EnergyItem& item : chain_.energies()) {
    const std::string kind = item.kind == EnergyItem::kStored ? "_energy" : "_power";
    ex sum = 0;
    int k = 0;
    for (const ex& part : item.parts) {
      const std::string family = item.name + kind;
      ++k;
      sum = definitions_.define(family + "_sum", k,
                                sum + definitions_.named(part, family + "_part", k));
    }
    outputs.push_back({{"", "e", {}}, kNoIndex, ArrayPlace{{}, false, item_index++}, sum});
  }
  add("energy", "Energies (J) and powers (W), in the order of the table.", {at(), result("e")},
      body(outputs, at_));
}

void FunctionBuilder::positions() {
  const auto itself = [](const ex& e) { return e; };
  const auto rate = [&](const ex& e) { return chain_.rate(e); };
  const std::vector<Axis> plane{kSide, kDown};
  const std::vector<Output> position = point_outputs(chain_, plane, {"side", "down"}, itself);
  add("positions", "Support (0), far end of each link (1..), load (last): side and down, m.",
      {at(), result("side"), result("down")}, body(position, at_));
  add("positions_tangent", "Derivative of the positions along `along`.",
      {at(), along(), change("dside"), change("ddown")},
      body(tangents_of(position), at_and_along_));
  add("velocities", "Velocities of the same points, m/s.",
      {at(), result("side_rate"), result("down_rate")},
      body(point_outputs(chain_, plane, {"side_rate", "down_rate"}, rate), at_));
  if (!in_space()) return;
  const std::vector<Output> across = point_outputs(chain_, {kAcross}, {"across"}, itself);
  add("positions_across", "The same points: across, m.", {at(), result("across")},
      body(across, at_));
  add("positions_across_tangent", "Its derivative along `along`.",
      {at(), along(), change("dacross")}, body(tangents_of(across), at_and_along_));
  add("velocities_across", "Velocities across of the same points, m/s.",
      {at(), result("across_rate")},
      body(point_outputs(chain_, {kAcross}, {"across_rate"}, rate), at_));
}

void FunctionBuilder::internal_forces() {
  std::vector<Output> outputs = from_one("moment", chain_.moments());
  for (const Output& output : from_one("tension", chain_.tensions())) outputs.push_back(output);
  for (const Output& output : from_one("curvature", chain_.curvatures())) outputs.push_back(output);
  add("internal_forces", "Joint moments (N m), link tensions (N), curvatures at joints (rad/m).",
      {at(), result("moment"), result("tension"), result("curvature")}, body(outputs, at_));
}

void FunctionBuilder::reactions() {
  std::vector<Output> outputs;
  const auto add_all = [&](const std::string& array, std::vector<ex> Chain::Reaction::*what) {
    int place = 0;
    for (const Chain::Reaction& reaction : chain_.reactions())
      for (const ex& component : reaction.*what)
        outputs.push_back({{"", array, {}}, kNoIndex, ArrayPlace{{}, false, place++}, component});
  };
  add_all("force", &Chain::Reaction::force);
  add_all("moment", &Chain::Reaction::moment);
  add("reactions", "What holds the support, then a held end: forces (N) and moments (N m).",
      {at(), result("force"), result("moment")}, body(outputs, at_));
}

void FunctionBuilder::gap() {
  std::vector<Output> outputs;
  const auto add_all = [&](const std::string& array, const auto& act) {
    int place = 0;
    for (const ex& component : chain_.gap())
      outputs.push_back(
          {{"", array, {}}, kNoIndex, ArrayPlace{{}, false, place++}, act(component)});
  };
  add_all("apart", [](const ex& e) { return e; });
  add_all("rate", [&](const ex& e) { return chain_.rate(e); });
  add("gap", "From where the end is held to the end of the last link, m, and its rate, m/s.",
      {at(), result("apart"), result("rate")}, body(outputs, at_));
}

void FunctionBuilder::events() {
  std::vector<Output> outputs;
  int place = 0;
  for (const Chain::Event& event : chain_.events()) {
    const bool of_each_link = is_of_each_link(event.at);
    int link = 1;
    for (const ex& value : event.values)
      outputs.push_back({{"", "value", {}},
                         of_each_link ? link++ : kNoIndex,
                         ArrayPlace{place, of_each_link, of_each_link ? -1 : 0},
                         value});
    place += static_cast<int>(event.values.size());
  }
  add("event_values", "What changes its sign at events, in the order of the table.",
      {at(), result("value")}, body(outputs, at_));
}

void FunctionBuilder::sensor() {
  result_.observes = true;
  const Chain::Sensor& sensor = chain_.sensor();
  Inputs inputs = inputs_of(description_, links_, "", false, Type::kScalar);
  inputs.merge(inputs_of(description_, links_, "", true, Type::kScalar));
  inputs["d_time"] = Input{InputKind::kZero, Type::kScalar, "d_time", {}, {}};
  int k = 0;
  for (const std::string& name : sensor.seen) {
    const std::string differential = "d_" + name;
    inputs[name] = Input{InputKind::kEntry, Type::kScalar, name, {"", "in", {}}, k};
    inputs[differential] =
        Input{InputKind::kEntry, Type::kScalar, differential, {"", "din", {}}, k};
    ++k;
  }
  const Parameter t = maybe_unused(number("t")), p = maybe_unused(numbers("p")),
                  dp = maybe_unused(numbers("dp")), in = numbers("in");
  add("observe",
      in_space() ? "What the sensor reports of side, down and across (m)."
                 : "What the sensor reports of side, down (m) and angle (rad).",
      {t, p, in, result("out")}, body(from_one("out", sensor.reported), inputs));
  add("observe_tangent", "Its derivative along dp and din.",
      {t, p, dp, maybe_unused(in), numbers("din"), result("dout")},
      body(from_one("dout", each(sensor.reported, [&](const ex& e) { return tangent_.of(e); })),
           inputs));
  const auto value = [&](const ex& e) {
    return body({{{"", "out", {}}, kNoIndex, {}, e}}, inputs);
  };
  add("clock", "Model time at which what was recorded at t happened, s.", {number("t"), p},
      value(sensor.clock), Frame::kValue);
  add("clock_tangent", "Its derivative along dp.", {t, p, dp}, value(tangent_.of(sensor.clock)),
      Frame::kValue);
}

}  // namespace catena
