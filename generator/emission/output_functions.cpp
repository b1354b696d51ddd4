// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/function_builder.hpp"

namespace catena {

using GiNaC::ex;

namespace {

std::vector<Output> point_outputs(const Chain& chain, const std::string& side,
                                  const std::string& down, const auto& act) {
  std::vector<Output> outputs;
  for (size_t k = 0; k < chain.side().size(); ++k) {
    const ArrayPlace here{{}, true, 0};
    outputs.push_back({{"", side, {}}, static_cast<int>(k), here, act(chain.side()[k])});
    outputs.push_back({{"", down, {}}, static_cast<int>(k), here, act(chain.down()[k])});
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
  const std::vector<Output> position =
      point_outputs(chain_, "side", "down", [](const ex& e) { return e; });
  add("positions", "Support (0), far end of each link (1..), load (last): side and down, m.",
      {at(), result("side"), result("down")}, body(position, at_));
  add("positions_tangent", "Derivative of the positions along `along`.",
      {at(), along(), change("dside"), change("ddown")},
      body(tangents_of(position), at_and_along_));
  const std::vector<Output> velocity =
      point_outputs(chain_, "side_rate", "down_rate", [&](const ex& e) { return chain_.rate(e); });
  add("velocities", "Velocities of the same points, m/s.",
      {at(), result("side_rate"), result("down_rate")}, body(velocity, at_));
}

void FunctionBuilder::internal_forces() {
  std::vector<Output> outputs = from_one("moment", chain_.moments());
  for (const Output& output : from_one("tension", chain_.tensions())) outputs.push_back(output);
  for (const Output& output : from_one("curvature", chain_.curvatures())) outputs.push_back(output);
  add("internal_forces", "Joint moments (N m), link tensions (N), curvatures at joints (rad/m).",
      {at(), result("moment"), result("tension"), result("curvature")}, body(outputs, at_));
}

void FunctionBuilder::sensor() {
  result_.observes = true;
  const Chain::Sensor& sensor = chain_.sensor();
  Inputs inputs = inputs_of(description_, links_, "", false, Type::kScalar);
  inputs.merge(inputs_of(description_, links_, "", true, Type::kScalar));
  inputs["d_time"] = Input{InputKind::kZero, Type::kScalar, "d_time", {}, {}};
  const std::string names[] = {"side", "down", "angle"};
  for (int k = 0; k < 3; ++k) {
    const std::string name = names[k], differential = "d_" + name;
    inputs[name] = Input{InputKind::kEntry, Type::kScalar, name, {"", "in", {}}, k};
    inputs[differential] =
        Input{InputKind::kEntry, Type::kScalar, differential, {"", "din", {}}, k};
  }
  const std::vector<ex> reported{sensor.side, sensor.down, sensor.angle};
  const Parameter t = maybe_unused(number("t")), p = maybe_unused(numbers("p")),
                  dp = maybe_unused(numbers("dp")), in = numbers("in");
  add("observe", "What the sensor reports of side, down (m) and angle (rad).",
      {t, p, in, result("out")}, body(from_one("out", reported), inputs));
  add("observe_tangent", "Its derivative along dp and din.",
      {t, p, dp, maybe_unused(in), numbers("din"), result("dout")},
      body(from_one("dout", each(reported, [&](const ex& e) { return tangent_.of(e); })), inputs));
  const auto value = [&](const ex& e) {
    return body({{{"", "out", {}}, kNoIndex, {}, e}}, inputs);
  };
  add("clock", "Model time at which what was recorded at t happened, s.", {number("t"), p},
      value(sensor.clock), Frame::kValue);
  add("clock_tangent", "Its derivative along dp.", {t, p, dp}, value(tangent_.of(sensor.clock)),
      Frame::kValue);
}

}  // namespace catena
