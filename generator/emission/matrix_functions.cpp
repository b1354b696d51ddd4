// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/structure.hpp"
#include "generator/emission/function_builder.hpp"

namespace catena {

using GiNaC::ex;

namespace {

void add_entries(std::vector<Output>& outputs, const std::string& array,
                 const std::vector<std::vector<ex>>& rows) {
  for (size_t i = 1; i + 1 < rows.size(); ++i) {
    for (size_t r = 0; r < rows[i].size(); ++r) {
      outputs.push_back({{"matrix", array, static_cast<int>(r)},
                         static_cast<int>(i),
                         ArrayPlace{{}, true, -1},
                         rows[i][r]});
    }
  }
}

void add_entries(std::vector<Output>& outputs, const std::string& array,
                 const std::vector<ex>& entries) {
  for (size_t i = 1; i + 1 < entries.size(); ++i) {
    outputs.push_back(
        {{"matrix", array, {}}, static_cast<int>(i), ArrayPlace{{}, true, -1}, entries[i]});
  }
}

std::vector<Output> all_entries(const Quasiseparable& q, bool symmetric) {
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

std::string quasiseparable_type(const Quasiseparable& q) {
  return "Quasiseparable<T, kLinks, " + std::to_string(q.upper_rank) + ", " +
         std::to_string(q.lower_rank) + ">";
}

}  // namespace

void FunctionBuilder::mass_and_acceleration() {
  if (!in_c()) result_.accelerations = "acceleration";
  ModelSummary& s = result_.summary;
  Substitution bias = without_acceleration(chain_);
  const auto h = each(chain_.residual(), [&](const ex& e) { return bias.of(e); });
  add("bias", "r with a = 0.", "void bias(const Point<T>& at, T* h)", body(from_one("h", h), at_),
      {{"void", "bias", "const catena_point* at, double* h", "bias(point(at), h)"}});

  const Quasiseparable mass = find_structure(chain_, {1, 0, 0}, "mass_");
  s.mass_structured = mass.found;
  s.why_not = mass.reason;
  const TableFunction mass_entry = {"void", "mass_matrix", "const catena_point* at, double* mass",
                                    "mass_matrix(point(at), mass)"};
  const std::string acceleration_comment =
      "a such that r = 0. Returns 0, or the 1-based coordinate whose pivot is not positive.";
  const TableFunction acceleration_entry = {
      "int32_t", "acceleration", "const catena_point* at, double* a", "acceleration(point(at), a)"};
  if (!mass.found) {
    Differential along_a(definitions_,
                         [](const std::string& family) { return family + "_inertial"; });
    for (const ex& a : chain_.accelerations()) along_a.set(a, a);
    const auto inertial = each(chain_.residual(), [&](const ex& e) { return along_a.of(e); });
    add("inertial", "M a, of the chain and of every effect.",
        "void inertial(const Point<T>& at, T* r)", body(from_one("r", inertial), at_), {});
    add("mass_matrix", "M, row by row: its columns are M a for unit accelerations.",
        "void mass_matrix(const Point<T>& at, T* M)", {}, {mass_entry},
        in_c() ? "  double unit[kCoordinates], column[kCoordinates];\n"
                 "  for (int j = 0; j < kCoordinates; ++j) unit[j] = 0.0;\n"
                 "  catena_point moving = *at;\n"
                 "  moving.a = unit;\n"
                 "  for (int j = 0; j < kCoordinates; ++j) {\n"
                 "    unit[j] = 1.0;\n"
                 "    inertial(context, &moving, column);\n"
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
        {acceleration_entry},
        std::string(in_c() ? "  double" : "  T") +
            " mass[kCoordinates * kCoordinates];\n"
            "  mass_matrix(" +
            context() + "at, mass);\n  bias(" + context() +
            "at, a);\n"
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
  const std::string matrix =
      !in_c()                ? "  MassMatrix<T> matrix;\n"
      : mass.lower_rank == 0 ? "  MassMatrix in = {{{0.0}}, {{0.0}}, {0.0}}, *const matrix = &in;\n"
                             : "  MassMatrix in, *const matrix = &in;\n";
  const std::vector<Output> entries = all_entries(mass, symmetric);
  add("mass_matrix", "M, row by row.", "void mass_matrix(const Point<T>& at, T* M)",
      body(entries, at_), {mass_entry}, matrix,
      in_c() ? "  to_dense(matrix, M);\n" : "  matrix.to_dense(M);\n");
  std::vector<Output> all = entries;
  for (const Output& output : from_one("a", each(h, [](const ex& e) { return ex(-e); }))) {
    all.push_back(output);
  }
  const std::string solve = in_c()      ? "  return solve_in_place(matrix, a);\n"
                            : symmetric ? "  return matrix.solve(a);\n"
                                        : "  const int failed = matrix.factor();\n"
                                          "  if (failed == 0) matrix.solve(a);\n"
                                          "  return failed;\n";
  add("acceleration", acceleration_comment, "int acceleration(const Point<T>& at, T* a)",
      body(all, at_), {acceleration_entry}, matrix, solve);
  if (in_c() || layout_ != Layout::kLoops) return;
  result_.accelerations = "accelerations";
  add("accelerations", "The same, bit for bit, in the order that suits a T of several numbers.",
      "int accelerations(const Point<T>& at, T* a)",
      function_body(definitions_, all, at_, Layout::kWholeSweeps), {}, matrix, solve);
}

void FunctionBuilder::newton() {
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
      body(all_entries(newton, false), at_), {});
}

}  // namespace catena
