// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/model_functions.hpp"

#include <algorithm>
#include <stdexcept>

#include "generator/derivation/adjoint.hpp"
#include "generator/derivation/structure.hpp"
#include "generator/emission/parameter_table.hpp"

namespace catena {

using GiNaC::ex;

namespace {

std::string differential_family(const std::string& family) { return "d_" + family; }

class Builder {
 public:
  Builder(const Description& description, int links, Layout layout, Language language)
      : description_(description),
        links_(links),
        layout_(layout),
        language_(language),
        chain_(description, links),
        definitions_(chain_.definitions()),
        tangent_(definitions_, differential_family),
        at_(input_declarations(description, links, in_c() ? "at->" : "at.", "", language)),
        at_and_along_(at_) {
    at_and_along_.merge(
        input_declarations(description, links, in_c() ? "along->" : "along.", "d_", language));
    for (const char* weight : {"ca", "cv", "cq"}) at_and_along_[weight] = at_[weight] = "";
  }

  ModelFunctions build() {
    const ModelTable table = model_table(description_, links_);
    ModelSummary& s = result_.summary;
    s.name = model_name(description_, links_);
    s.links = links_;
    s.layout = layout_;
    s.coordinates = static_cast<int>(table.coordinates.size());
    s.states = static_cast<int>(table.states.size());
    s.signals = static_cast<int>(table.signals.size());
    s.parameters = static_cast<int>(table.parameters.size());
    seed_tangent();
    residual();
    terms();
    if (s.states > 0) state_rates();
    mass_and_acceleration();
    if (!in_c()) newton();
    energy();
    positions();
    internal_forces();
    if (chain_.sensor().given) sensor();
    adjoint();
    const std::vector<int> used = all_symbols();
    result_.uses_time = s.signals > 0 || std::any_of(used.begin(), used.end(), [&](int number) {
                          return definitions_[number].family == "time";
                        });
    result_.energies = chain_.energies();
    for (const EmittedFunction& function : result_.functions) {
      if (function.body.statements > 0) {
        s.functions.push_back({function.name, function.body.operations, function.body.statements});
      }
    }
    return std::move(result_);
  }

 private:
  bool in_c() const { return language_ == Language::kC; }

  static std::vector<Output> from_one(const std::string& array, const std::vector<ex>& values) {
    std::vector<Output> outputs;
    for (size_t i = 0; i < values.size(); ++i) {
      outputs.push_back({array + "[", static_cast<int>(i) + 1, -1, "]", values[i]});
    }
    return outputs;
  }

  // The derivatives of outputs, each under its name with a "d" before it.
  std::vector<Output> tangents_of(std::vector<Output> outputs) {
    for (Output& output : outputs) {
      output.before = "d" + output.before;
      output.value = tangent_.of(output.value);
    }
    return outputs;
  }

  FunctionBody body(const std::vector<Output>& outputs, const InputDeclarations& inputs) {
    return function_body(definitions_, outputs, inputs, layout_, language_);
  }

  void add(const std::string& name, const std::string& comment, const std::string& signature,
           FunctionBody text, const std::string& wrapper, const std::string& before = "",
           const std::string& after = "") {
    result_.functions.push_back(
        {name, comment, signature, before, std::move(text), after, wrapper});
  }

  std::vector<ex> each(const std::vector<ex>& values, const auto& act) {
    std::vector<ex> out;
    for (const ex& value : values) out.push_back(act(value));
    return out;
  }

  // The differential of every input is an input of its own, "d_<family>".
  void seed_tangent() {
    for (int k = 0, count = definitions_.size(); k < count; ++k) {
      const Symbol symbol = definitions_[k];
      if (symbol.is_input && symbol.family != "pi") {
        tangent_.set(symbol.symbol, definitions_.input("d_" + symbol.family, symbol.index));
      } else if (symbol.family == "sine" || symbol.family == "cosine") {
        const bool sine = symbol.family == "sine";
        const ex angle = symbol.value.op(0);
        const ex other = sine ? ex(definitions_.define("cosine", symbol.index, GiNaC::cos(angle)))
                              : ex(definitions_.define("sine", symbol.index, GiNaC::sin(angle)));
        const ex change = definitions_.input("d_theta", symbol.index) * other;
        tangent_.set(symbol.symbol, sine ? change : ex(-change));
      }
    }
  }

  void residual() {
    const auto r = chain_.residual();
    add("residual", "r(t, q, v, a, z, u, p), the inverse dynamics.",
        "void residual(const Point<T>& at, T* r)", body(from_one("r", r), at_),
        "void c_residual(const catena_point* at, double* r) { residual(point(at), r); }\n");
    const auto dr = each(r, [&](const ex& e) { return tangent_.of(e); });
    add("residual_tangent", "Derivative of r along `along`.",
        "void residual_tangent(const Point<T>& at, const Point<T>& along, T* dr)",
        body(from_one("dr", dr), at_and_along_),
        "void c_residual_tangent(const catena_point* at, const catena_point* along, double* dr) {\n"
        "  residual_tangent(point(at), point(along), dr);\n}\n");
  }

  Substitution without_acceleration(Chain& chain) {
    Substitution substitution(chain.definitions(), "_bias");
    for (const ex& a : chain.accelerations()) substitution.set(a, 0);
    return substitution;
  }

  // Each term of r from a derivation that has this term alone.
  void terms() {
    const auto add_term = [&](const std::string& name, const Chain& chain, Definitions& definitions,
                              const std::vector<ex>& values) {
      (void)chain;
      result_.terms.push_back(name);
      add("term_" + name, "The term " + name + " of r alone.",
          "void term_" + name + "(const Point<T>& at, T* r)",
          function_body(definitions, from_one("r", values), at_, layout_, language_), "");
    };
    for (const std::string& name : Chain::term_names(description_)) {
      Chain chain(description_, links_, name);
      if (name == "kinetic") {
        Differential along_a(chain.definitions(),
                             [](const std::string& family) { return family + "_inertial"; });
        for (const ex& a : chain.accelerations()) along_a.set(a, a);
        add_term("inertia", chain, chain.definitions(),
                 each(chain.residual(), [&](const ex& e) { return along_a.of(e); }));
        Substitution bias = without_acceleration(chain);
        add_term("coriolis", chain, chain.definitions(),
                 each(chain.residual(), [&](const ex& e) { return bias.of(e); }));
      } else {
        add_term(name, chain, chain.definitions(), chain.residual());
      }
      if (name == "elastic" || name == "friction") note_tridiagonal(chain, name == "elastic");
    }
    std::string choose = "  switch (term) {\n";
    for (size_t k = 0; k < result_.terms.size(); ++k) {
      choose += "    case " + std::to_string(k) + ":\n      term_" + result_.terms[k] +
                "(at, r);\n      break;\n";
    }
    choose += "  }\n";
    add("residual_term", "One term of r, numbered as in the table; their sum is r.",
        "void residual_term(const Point<T>& at, int term, T* r)", {},
        "void c_residual_term(const catena_point* at, int32_t term, double* r) {\n"
        "  residual_term(point(at), term, r);\n}\n",
        choose);
  }

  // K (or C): the derivative of the elastic (friction) term with respect to q (v). Constant,
  // symmetric and tridiagonal are read off entry by entry.
  void note_tridiagonal(Chain& chain, bool stiffness) {
    const auto& variables = stiffness ? chain.coordinates() : chain.rates();
    const int n = static_cast<int>(variables.size());
    Definitions& definitions = chain.definitions();
    std::map<int, int> column;  // number of the variable's symbol -> j
    for (int j = 0; j < n; ++j) column[definitions.number_of(variables[static_cast<size_t>(j)])] = j;
    std::map<std::pair<int, int>, ex> entries;
    bool fine = n == links_;
    for (int i = 0; fine && i < n; ++i) {
      const ex flat = flattened(definitions, chain.residual()[static_cast<size_t>(i)]);
      for (const int number : definitions.symbols_of(flat)) {
        const auto found = column.find(number);
        if (found == column.end()) continue;
        const int j = found->second;
        const ex entry =
            flat.diff(GiNaC::ex_to<GiNaC::symbol>(variables[static_cast<size_t>(j)])).expand();
        fine = fine && std::abs(i - j) <= 1;
        for (const int inner : definitions.symbols_of(entry)) {
          const std::string& family = definitions[inner].family;
          fine = fine && (family == "stiffness" || family == "damping");
        }
        entries[{i, j}] = entry;
      }
    }
    for (const auto& [at, entry] : entries) {
      const auto mirrored = entries.find({at.second, at.first});
      fine = fine && mirrored != entries.end() && (mirrored->second - entry).expand().is_zero();
    }
    (stiffness ? result_.summary.stiffness_tridiagonal : result_.summary.damping_tridiagonal) =
        fine;
  }

  static ex flattened(Definitions& definitions, const ex& e) {
    GiNaC::exmap values;
    for (const int number : definitions.symbols_of(e)) {
      const Symbol symbol = definitions[number];
      if (symbol.is_input || symbol.family == "sine" || symbol.family == "cosine") continue;
      values[symbol.symbol] = flattened(definitions, symbol.value);
    }
    return e.subs(values, GiNaC::subs_options::no_pattern).expand();
  }

  void state_rates() {
    const auto f = chain_.state_rates();
    add("state_rate", "zdot = f(t, q, v, z, u, p), the rates of the extra states.",
        "void state_rate(const Point<T>& at, T* zdot)", body(from_one("zdot", f), at_),
        "void c_state_rate(const catena_point* at, double* zdot) { state_rate(point(at), zdot); "
        "}\n");
    const auto df = each(f, [&](const ex& e) { return tangent_.of(e); });
    add("state_rate_tangent", "Derivative of zdot along `along`.",
        "void state_rate_tangent(const Point<T>& at, const Point<T>& along, T* dzdot)",
        body(from_one("dzdot", df), at_and_along_),
        "void c_state_rate_tangent(const catena_point* at, const catena_point* along,\n"
        "                          double* dzdot) {\n"
        "  state_rate_tangent(point(at), point(along), dzdot);\n}\n");
  }

  static void add_entries(std::vector<Output>& outputs, const std::string& array,
                          const std::vector<std::vector<ex>>& rows) {
    for (size_t i = 1; i + 1 < rows.size(); ++i) {
      for (size_t r = 0; r < rows[i].size(); ++r) {
        outputs.push_back({"matrix." + array + "[", static_cast<int>(i), -1,
                           "][" + std::to_string(r) + "]", rows[i][r]});
      }
    }
  }

  static void add_entries(std::vector<Output>& outputs, const std::string& array,
                          const std::vector<ex>& entries) {
    for (size_t i = 1; i + 1 < entries.size(); ++i) {
      outputs.push_back({"matrix." + array + "[", static_cast<int>(i), -1, "]", entries[i]});
    }
  }

  static std::vector<Output> all_entries(const Quasiseparable& q, bool symmetric) {
    std::vector<Output> outputs;
    if (symmetric) {
      add_entries(outputs, "row", q.lower_row);
      add_entries(outputs, "column", q.lower_column);
      add_entries(outputs, "diagonal", q.diagonal);
      return outputs;
    }
    add_entries(outputs, "upper_row", q.upper_row);
    add_entries(outputs, "upper_column", q.upper_column);
    add_entries(outputs, "lower_row", q.lower_row);
    add_entries(outputs, "lower_column", q.lower_column);
    add_entries(outputs, "diagonal", q.diagonal);
    add_entries(outputs, "below", q.below);
    add_entries(outputs, "above", q.above);
    return outputs;
  }

  void mass_and_acceleration() {
    ModelSummary& s = result_.summary;
    Substitution bias = without_acceleration(chain_);
    const auto h = each(chain_.residual(), [&](const ex& e) { return bias.of(e); });
    add("bias", "r with a = 0.", "void bias(const Point<T>& at, T* h)", body(from_one("h", h), at_),
        "void c_bias(const catena_point* at, double* h) { bias(point(at), h); }\n");

    const Quasiseparable mass = find_structure(chain_, {1, 0, 0}, "mass_");
    s.mass_structured = mass.found;
    s.why_not = mass.reason;
    const std::string mass_wrapper =
        "void c_mass_matrix(const catena_point* at, double* mass) {\n"
        "  mass_matrix(point(at), mass);\n}\n";
    const std::string acceleration_comment =
        "a such that r = 0. Returns 0, or the 1-based coordinate whose pivot is not positive.";
    const std::string acceleration_wrapper =
        "int32_t c_acceleration(const catena_point* at, double* a) {\n"
        "  return acceleration(point(at), a);\n}\n";
    if (!mass.found) {
      Differential along_a(definitions_,
                           [](const std::string& family) { return family + "_inertial"; });
      for (const ex& a : chain_.accelerations()) along_a.set(a, a);
      const auto inertial = each(chain_.residual(), [&](const ex& e) { return along_a.of(e); });
      add("inertial", "M a, of the chain and of every effect.",
          "void inertial(const Point<T>& at, T* r)", body(from_one("r", inertial), at_), "");
      add("mass_matrix", "M, row by row: its columns are M a for unit accelerations.",
          "void mass_matrix(const Point<T>& at, T* M)", {}, mass_wrapper,
          in_c()
              ? "  double unit[kCoordinates], column[kCoordinates];\n"
                "  for (int j = 0; j < kCoordinates; ++j) unit[j] = 0.0;\n"
                "  catena_point moving = *at;\n"
                "  moving.a = unit;\n"
                "  for (int j = 0; j < kCoordinates; ++j) {\n"
                "    unit[j] = 1.0;\n"
                "    inertial(&moving, column);\n"
                "    unit[j] = 0.0;\n"
                "    for (int i = 0; i < kCoordinates; ++i) M[i * kCoordinates + j] = column[i];\n"
                "  }\n"
              : "  T unit[kCoordinates], column[kCoordinates];\n"
                "  for (int j = 0; j < kCoordinates; ++j) unit[j] = T(0);\n"
                "  Point<T> moving = at;\n"
                "  moving.a = unit;\n"
                "  for (int j = 0; j < kCoordinates; ++j) {\n"
                "    unit[j] = T(1);\n"
                "    inertial(moving, column);\n"
                "    unit[j] = T(0);\n"
                "    for (int i = 0; i < kCoordinates; ++i) M[i * kCoordinates + j] = column[i];\n"
                "  }\n");
      add("acceleration", acceleration_comment, "int acceleration(const Point<T>& at, T* a)", {},
          acceleration_wrapper,
          std::string(in_c() ? "  double" : "  T") +
              " mass[kCoordinates * kCoordinates];\n"
              "  mass_matrix(at, mass);\n"
              "  bias(at, a);\n"
              "  for (int i = 0; i < kCoordinates; ++i) a[i] = -a[i];\n" +
              (in_c() ? "  return solve_symmetric(mass, a);\n"
                      : "  return solve_symmetric<kCoordinates>(mass, a);\n"));
      return;
    }
    bool tridiagonal_part = false;
    for (const auto* entries : {&mass.below, &mass.above}) {
      for (const ex& entry : *entries) tridiagonal_part = tridiagonal_part || !entry.is_zero();
    }
    const bool symmetric = mass.symmetric && !tridiagonal_part;
    s.mass_symmetric = mass.symmetric;
    s.mass_rank = mass.lower_rank;
    result_.mass_type =
        symmetric ? "SymmetricSemiseparable<T, kLinks, " + std::to_string(mass.lower_rank) + ">"
                  : quasiseparable_type(mass);
    if (in_c() && !symmetric) throw std::logic_error("C: a mass matrix that is not symmetric");
    const std::string matrix = !in_c() ? "  MassMatrix<T> matrix;\n"
                               : mass.lower_rank == 0
                                   ? "  MassMatrix matrix = {{{0.0}}, {{0.0}}, {0.0}};\n"
                                   : "  MassMatrix matrix;\n";
    const std::vector<Output> entries = all_entries(mass, symmetric);
    add("mass_matrix", "M, row by row.", "void mass_matrix(const Point<T>& at, T* M)",
        body(entries, at_), mass_wrapper, matrix,
        in_c() ? "  to_dense(&matrix, M);\n" : "  matrix.to_dense(M);\n");
    std::vector<Output> all = entries;
    for (const Output& output : from_one("a", each(h, [](const ex& e) { return ex(-e); }))) {
      all.push_back(output);
    }
    add("acceleration", acceleration_comment, "int acceleration(const Point<T>& at, T* a)",
        body(all, at_), acceleration_wrapper, matrix,
        in_c()      ? "  return solve_in_place(&matrix, a);\n"
        : symmetric ? "  return matrix.solve(a);\n"
                    : "  const int failed = matrix.factor();\n"
                      "  if (failed == 0) matrix.solve(a);\n"
                      "  return failed;\n");
  }

  static std::string quasiseparable_type(const Quasiseparable& q) {
    return "Quasiseparable<T, kLinks, " + std::to_string(q.upper_rank) + ", " +
           std::to_string(q.lower_rank) + ">";
  }

  void newton() {
    ModelSummary& s = result_.summary;
    const Weights weights{definitions_.input("ca"), definitions_.input("cv"),
                          definitions_.input("cq")};
    const Quasiseparable newton = find_structure(chain_, weights, "newton_");
    s.structured = newton.found;
    if (!newton.found) {
      s.why_not = newton.reason;
      return;
    }
    s.newton_upper_rank = newton.upper_rank;
    s.newton_lower_rank = newton.lower_rank;
    result_.newton_type = quasiseparable_type(newton);
    add("newton_matrix", "ca dr/da + cv dr/dv + cq dr/dq at the point (at.a is read).",
        "void newton_matrix(const Point<T>& at, const T& ca, const T& cv, const T& cq,\n"
        "                   NewtonMatrix<T>& matrix)",
        body(all_entries(newton, false), at_),
        "int32_t c_newton_factor(const catena_point* at, double ca, double cv, double cq,\n"
        "                        double* work) {\n"
        "  auto& matrix = *reinterpret_cast<NewtonMatrix<double>*>(work);\n"
        "  newton_matrix(point(at), ca, cv, cq, matrix);\n"
        "  return matrix.factor();\n}\n"
        "CATENA_EACH_PROCESSOR void c_newton_solve(const double* work, double* x) {\n"
        "  reinterpret_cast<const NewtonMatrix<double>*>(work)->solve(x);\n}\n"
        "CATENA_EACH_PROCESSOR void c_newton_solve_transposed(const double* work, double* x) {\n"
        "  reinterpret_cast<const NewtonMatrix<double>*>(work)->solve_transposed(x);\n}\n");
  }

  void energy() {
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
      outputs.push_back({"e[" + std::to_string(item_index++), kNoIndex, 0, "]", sum});
    }
    add("energy", "Energies (J) and powers (W), in the order of the table.",
        "void energy(const Point<T>& at, T* e)", body(outputs, at_),
        "void c_energy(const catena_point* at, double* e) { energy(point(at), e); }\n");
    add("energy_tangent", "Derivative of the energies and powers along `along`.",
        "void energy_tangent(const Point<T>& at, const Point<T>& along, T* de)",
        body(tangents_of(outputs), at_and_along_),
        "void c_energy_tangent(const catena_point* at, const catena_point* along, double* de) {\n"
        "  energy_tangent(point(at), point(along), de);\n}\n");
  }

  std::vector<Output> point_outputs(const std::string& side, const std::string& down,
                                    const auto& act) {
    std::vector<Output> outputs;
    for (size_t k = 0; k < chain_.side().size(); ++k) {
      outputs.push_back({side + "[", static_cast<int>(k), 0, "]", act(chain_.side()[k])});
      outputs.push_back({down + "[", static_cast<int>(k), 0, "]", act(chain_.down()[k])});
    }
    return outputs;
  }

  void positions() {
    const std::vector<Output> position =
        point_outputs("side", "down", [](const ex& e) { return e; });
    add("positions", "Support (0), far end of each link (1..), load (last): side and down, m.",
        "void positions(const Point<T>& at, T* side, T* down)", body(position, at_),
        "void c_positions(const catena_point* at, double* side, double* down) {\n"
        "  positions(point(at), side, down);\n}\n");
    add("positions_tangent", "Derivative of the positions along `along`.",
        "void positions_tangent(const Point<T>& at, const Point<T>& along, T* dside, T* ddown)",
        body(tangents_of(position), at_and_along_),
        "void c_positions_tangent(const catena_point* at, const catena_point* along,\n"
        "                         double* dside, double* ddown) {\n"
        "  positions_tangent(point(at), point(along), dside, ddown);\n}\n");
    const std::vector<Output> velocity =
        point_outputs("side_rate", "down_rate", [&](const ex& e) { return chain_.rate(e); });
    add("velocities", "Velocities of the same points, m/s.",
        "void velocities(const Point<T>& at, T* side_rate, T* down_rate)", body(velocity, at_),
        "void c_velocities(const catena_point* at, double* side_rate, double* down_rate) {\n"
        "  velocities(point(at), side_rate, down_rate);\n}\n");
    add("velocities_tangent", "Derivative of the velocities along `along`.",
        "void velocities_tangent(const Point<T>& at, const Point<T>& along, T* dside_rate,\n"
        "                        T* ddown_rate)",
        body(tangents_of(velocity), at_and_along_),
        "void c_velocities_tangent(const catena_point* at, const catena_point* along,\n"
        "                          double* dside_rate, double* ddown_rate) {\n"
        "  velocities_tangent(point(at), point(along), dside_rate, ddown_rate);\n}\n");
  }

  void internal_forces() {
    std::vector<Output> outputs = from_one("moment", chain_.moments());
    for (const Output& output : from_one("tension", chain_.tensions())) outputs.push_back(output);
    for (const Output& output : from_one("curvature", chain_.curvatures()))
      outputs.push_back(output);
    add("internal_forces", "Joint moments (N m), link tensions (N), curvatures at joints (rad/m).",
        "void internal_forces(const Point<T>& at, T* moment, T* tension, T* curvature)",
        body(outputs, at_),
        "void c_internal_forces(const catena_point* at, double* moment, double* tension,\n"
        "                       double* curvature) {\n"
        "  internal_forces(point(at), moment, tension, curvature);\n}\n");
    add("internal_forces_tangent", "Derivative of moments, tensions and curvatures along `along`.",
        "void internal_forces_tangent(const Point<T>& at, const Point<T>& along, T* dmoment,\n"
        "                             T* dtension, T* dcurvature)",
        body(tangents_of(outputs), at_and_along_),
        "void c_internal_forces_tangent(const catena_point* at, const catena_point* along,\n"
        "                               double* dmoment, double* dtension, double* dcurvature) {\n"
        "  internal_forces_tangent(point(at), point(along), dmoment, dtension, dcurvature);\n}\n");
  }

  void sensor() {
    result_.observes = true;
    const Chain::Sensor& sensor = chain_.sensor();
    InputDeclarations inputs = input_declarations(description_, links_, "", "", language_);
    inputs.merge(input_declarations(description_, links_, "d", "d_", language_));
    const std::string type = in_c() ? "const double " : "const T ";
    inputs["time"] = type + "time = t;";
    inputs["d_time"] = type + "d_time = " + (in_c() ? "0.0;" : "T(0);");
    const char* const names[] = {"side", "down", "angle"};
    for (int k = 0; k < 3; ++k) {
      const std::string at = std::to_string(k);
      inputs[names[k]] = type + names[k] + " = in[" + at + "];";
      inputs[std::string("d_") + names[k]] = type + "d_" + names[k] + " = din[" + at + "];";
    }
    const std::vector<ex> reported{sensor.side, sensor.down, sensor.angle};
    add("observe", "What the sensor reports of side, down (m) and angle (rad).",
        "void observe([[maybe_unused]] const T& t, [[maybe_unused]] const T* p, const T* in, T* "
        "out)",
        body(from_one("out", reported), inputs),
        "void c_observe(double t, const double* p, const double in[3], double out[3]) {\n"
        "  observe(t, p, in, out);\n}\n");
    add("observe_tangent", "Its derivative along dp and din.",
        "void observe_tangent([[maybe_unused]] const T& t, [[maybe_unused]] const T* p,\n"
        "                     [[maybe_unused]] const T* dp, [[maybe_unused]] const T* in,\n"
        "                     const T* din, T* dout)",
        body(from_one("dout", each(reported, [&](const ex& e) { return tangent_.of(e); })), inputs),
        "void c_observe_tangent(double t, const double* p, const double* dp, const double in[3],\n"
        "                       const double din[3], double dout[3]) {\n"
        "  observe_tangent(t, p, dp, in, din, dout);\n}\n");
    const std::string before = in_c() ? "  double out;\n" : "  T out;\n";
    const std::string after = "  return out;\n";
    add("clock", "Model time at which what was recorded at t happened, s.",
        "T clock(const T& t, [[maybe_unused]] const T* p)",
        body({{"out", kNoIndex, 0, "", sensor.clock}}, inputs),
        "double c_clock(double t, const double* p) { return clock(t, p); }\n", before, after);
    add("clock_tangent", "Its derivative along dp.",
        "T clock_tangent([[maybe_unused]] const T& t, [[maybe_unused]] const T* p,\n"
        "                [[maybe_unused]] const T* dp)",
        body({{"out", kNoIndex, 0, "", tangent_.of(sensor.clock)}}, inputs),
        "double c_clock_tangent(double t, const double* p, const double* dp) {\n"
        "  return clock_tangent(t, p, dp);\n}\n",
        before, after);
  }

  // The gradient of weight . r + rate_weight . zdot.
  void adjoint() {
    Adjoint gradient(definitions_, "adjoint_");
    const auto add_all = [&](const std::vector<ex>& values, const std::string& weight) {
      for (size_t i = 0; i < values.size(); ++i) {
        const int link = static_cast<int>(i) + 1;
        gradient.add(values[i], definitions_.input(weight, link), link);
      }
    };
    add_all(chain_.residual(), "weight");
    add_all(chain_.state_rates(), "rate_weight");
    gradient.accumulate();
    std::vector<Output> outputs;
    for (const InputPlace& place : input_places(description_, links_)) {
      if (std::string("qvzp").find(place.member) == std::string::npos) continue;
      const std::string array = std::string("d") + place.member + "[";
      const std::string offset = std::to_string(place.offset);
      for (int i = 1; i <= place.count; ++i) {
        const ex symbol = definitions_.input(place.family, place.indexed ? i : kNoIndex);
        if (place.indexed) {
          outputs.push_back({array + (place.offset == 0 ? "" : offset + " + "), i, -1, "]",
                             gradient.of(symbol)});
        } else {
          outputs.push_back({array + offset, kNoIndex, 0, "]", gradient.of(symbol)});
        }
      }
    }
    InputDeclarations inputs = at_;
    inputs["weight"] = in_c() ? "const double* const weight = weights;"
                              : "const FromOne<T> weight(weights);";
    inputs["rate_weight"] = in_c() ? "const double* const rate_weight = rate_weights;"
                                   : "const FromOne<T> rate_weight(rate_weights);";
    add("residual_adjoint",
        "Gradient of weights . r + rate_weights . zdot with respect to q, v, z and p.",
        "void residual_adjoint(const Point<T>& at, const T* weights,\n"
        "                      [[maybe_unused]] const T* rate_weights, T* dq, T* dv,\n"
        "                      [[maybe_unused]] T* dz, T* dp)",
        body(outputs, inputs),
        "void c_residual_adjoint(const catena_point* at, const double* weights,\n"
        "                        const double* rate_weights, double* dq, double* dv, double* dz,\n"
        "                        double* dp) {\n"
        "  residual_adjoint(point(at), weights, rate_weights, dq, dv, dz, dp);\n}\n");
  }

  // Symbols the equations depend on.
  std::vector<int> all_symbols() {
    std::set<int> seen;
    std::vector<int> open;
    const auto visit = [&](const ex& e) {
      for (const int number : definitions_.symbols_of(e)) {
        if (seen.insert(number).second) open.push_back(number);
      }
    };
    for (const ex& e : chain_.residual()) visit(e);
    for (const ex& e : chain_.state_rates()) visit(e);
    while (!open.empty()) {
      const int number = open.back();
      open.pop_back();
      visit(definitions_[number].value);
    }
    return {seen.begin(), seen.end()};
  }

  const Description& description_;
  int links_;
  Layout layout_;
  Language language_;
  Chain chain_;
  Definitions& definitions_;
  Differential tangent_;
  InputDeclarations at_, at_and_along_;
  ModelFunctions result_;
};

}  // namespace

std::vector<std::string> ModelFunctions::table_entries() const {
  const bool states = summary.states > 0;
  const auto maybe = [](bool there, const char* name) {
    return std::string(there ? name : "nullptr");
  };
  return {"c_residual",
          "c_residual_tangent",
          "c_residual_term",
          maybe(states, "c_state_rate"),
          maybe(states, "c_state_rate_tangent"),
          "c_mass_matrix",
          "c_bias",
          "c_acceleration",
          maybe(summary.structured, "c_newton_factor"),
          maybe(summary.structured, "c_newton_solve"),
          "c_energy",
          "c_positions",
          "c_positions_tangent",
          "c_velocities",
          "c_internal_forces",
          maybe(observes, "c_observe"),
          maybe(observes, "c_observe_tangent"),
          maybe(observes, "c_clock"),
          maybe(observes, "c_clock_tangent"),
          "c_velocities_tangent",
          "c_energy_tangent",
          "c_internal_forces_tangent",
          "c_residual_adjoint",
          maybe(summary.structured, "c_newton_solve_transposed")};
}

ModelFunctions model_functions(const Description& description, int links, Layout layout,
                               Language language) {
  return Builder(description, links, layout, language).build();
}

}  // namespace catena
