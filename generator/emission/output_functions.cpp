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
  add("energy", "Energies (J) and powers (W), in the order of the table.",
      "void energy(const Point<T>& at, T* e)", body(outputs, at_),
      {{"void", "energy", "const catena_point* at, double* e", "energy(point(at), e)"}});
}

void FunctionBuilder::positions() {
  const std::vector<Output> position =
      point_outputs(chain_, "side", "down", [](const ex& e) { return e; });
  add("positions", "Support (0), far end of each link (1..), load (last): side and down, m.",
      "void positions(const Point<T>& at, T* side, T* down)", body(position, at_),
      {{"void", "positions", "const catena_point* at, double* side, double* down",
        "positions(point(at), side, down)"}});
  add("positions_tangent", "Derivative of the positions along `along`.",
      "void positions_tangent(const Point<T>& at, const Point<D>& along, D* dside, D* ddown)",
      body(tangents_of(position), at_and_along_),
      {{"void", "positions_tangent",
        "const catena_point* at, const catena_point* along, double* dside, double* ddown",
        "positions_tangent(point(at), point(along), dside, ddown)"}});
  const std::vector<Output> velocity =
      point_outputs(chain_, "side_rate", "down_rate", [&](const ex& e) { return chain_.rate(e); });
  add("velocities", "Velocities of the same points, m/s.",
      "void velocities(const Point<T>& at, T* side_rate, T* down_rate)", body(velocity, at_),
      {{"void", "velocities", "const catena_point* at, double* side_rate, double* down_rate",
        "velocities(point(at), side_rate, down_rate)"}});
}

void FunctionBuilder::internal_forces() {
  std::vector<Output> outputs = from_one("moment", chain_.moments());
  for (const Output& output : from_one("tension", chain_.tensions())) outputs.push_back(output);
  for (const Output& output : from_one("curvature", chain_.curvatures())) outputs.push_back(output);
  add("internal_forces", "Joint moments (N m), link tensions (N), curvatures at joints (rad/m).",
      "void internal_forces(const Point<T>& at, T* moment, T* tension, T* curvature)",
      body(outputs, at_),
      {{"void", "internal_forces",
        "const catena_point* at, double* moment, double* tension, double* curvature",
        "internal_forces(point(at), moment, tension, curvature)"}});
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
  add("observe", "What the sensor reports of side, down (m) and angle (rad).",
      "void observe([[maybe_unused]] const T& t, [[maybe_unused]] const T* p, const T* in, T* "
      "out)",
      body(from_one("out", reported), inputs),
      {{"void", "observe", "double t, const double* p, const double in[3], double out[3]",
        "observe(t, p, in, out)"}});
  add("observe_tangent", "Its derivative along dp and din.",
      "void observe_tangent([[maybe_unused]] const T& t, [[maybe_unused]] const T* p,\n"
      "                     [[maybe_unused]] const T* dp, [[maybe_unused]] const T* in,\n"
      "                     const T* din, T* dout)",
      body(from_one("dout", each(reported, [&](const ex& e) { return tangent_.of(e); })), inputs),
      {{"void", "observe_tangent",
        "double t, const double* p, const double* dp, const double in[3], const double din[3], "
        "double dout[3]",
        "observe_tangent(t, p, dp, in, din, dout)"}});
  const std::string before = in_c() ? "  double out;\n" : "  T out;\n";
  const std::string after = "  return out;\n";
  add("clock", "Model time at which what was recorded at t happened, s.",
      "T clock(const T& t, [[maybe_unused]] const T* p)",
      body({{{"", "out", {}}, kNoIndex, {}, sensor.clock}}, inputs),
      {{"double", "clock", "double t, const double* p", "clock(t, p)"}}, before, after);
  add("clock_tangent", "Its derivative along dp.",
      "T clock_tangent([[maybe_unused]] const T& t, [[maybe_unused]] const T* p,\n"
      "                [[maybe_unused]] const T* dp)",
      body({{{"", "out", {}}, kNoIndex, {}, tangent_.of(sensor.clock)}}, inputs),
      {{"double", "clock_tangent", "double t, const double* p, const double* dp",
        "clock_tangent(t, p, dp)"}},
      before, after);
}

}  // namespace catena
