// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/model_writer.hpp"

#include <sstream>

#include "generator/derivation/chain.hpp"
#include "generator/derivation/structure.hpp"
#include "generator/emission/model_functions.hpp"
#include "generator/emission/table_text.hpp"

namespace catena {

namespace {

const char* const kBanner =
    "// Written by catena-derive. Do not edit: change the model description and derive again.\n";

std::string operations_text(const FunctionBody& body) {
  const OperationCount& count = body.operations;
  std::ostringstream out;
  out << count.additions << " additions, " << count.multiplications << " multiplications, "
      << count.divisions << " divisions, " << count.functions << " functions";
  return out.str();
}

std::string structure_text(const ModelFunctions& functions) {
  const ModelSummary& s = functions.summary;
  std::ostringstream out;
  if (s.mass_structured) {
    out << "//   M: semiseparable of rank " << s.mass_rank
        << (s.mass_symmetric ? ", symmetric" : "") << " (proved for every pair of links)\n";
  } else {
    out << "//   M: no structure used: " << s.why_not << "\n";
  }
  if (s.structured) {
    out << "//   ca dr/da + cv dr/dv + cq dr/dq: tridiagonal plus semiseparable, ranks "
        << s.newton_upper_rank << " (above) and " << s.newton_lower_rank
        << " (below the diagonal)\n";
  } else {
    out << "//   Newton matrix: general form: " << s.why_not << "\n";
  }
  if (s.stiffness_tridiagonal) out << "//   K: constant, symmetric, tridiagonal\n";
  if (s.damping_tridiagonal) out << "//   C: constant, symmetric, tridiagonal\n";
  return out.str();
}

std::string header_text(const Description& description, const ModelFunctions& functions) {
  const ModelSummary& s = functions.summary;
  std::ostringstream out;
  out << "// SPDX-License-Identifier: BSD-3-Clause\n" << kBanner << "//\n";
  out << "// Equations of motion of a hanging chain of " << s.links << " rigid link"
      << (s.links == 1 ? "" : "s") << " with elastic, damped joints and a load";
  if (!description.effects.empty()) {
    out << ",\n// with";
    for (const Effect& effect : description.effects) out << " " << effect.id;
  }
  out << ".\n// Arguments, shapes, units and signs: catena_model.h. T is any scalar type, see "
         "scalar.hpp;\n// D, of differentials, is T or one that holds several directions, see "
         "directions.hpp.\n//\n// Structure found:\n"
      << structure_text(functions)
      << "#pragma once\n\n#include \"dense.hpp\"\n#include \"lanes.hpp\"\n#include "
         "\"quasiseparable.hpp\"\n"
         "#include \"scalar.hpp\"\n#include \"semiseparable.hpp\"\n\n";
  out << "extern \"C\" {\nstruct catena_model;\n}\n\n";
  out << "namespace catena::" << s.name << " {\n\n";
  out << "inline constexpr int kLinks = " << s.links << ";\n"
      << "inline constexpr int kCoordinates = " << s.coordinates << ";\n"
      << "inline constexpr int kStates = " << s.states << ";\n"
      << "inline constexpr int kSignals = " << s.signals << ";\n"
      << "inline constexpr int kParameters = " << s.parameters << ";\n\n"
      << "/// The same functions behind the table of catena_model.h, in double precision.\n"
      << "const ::catena_model& table();\n";
  if (!functions.mass_type.empty()) {
    out << "\n/// Mass matrix in the form in which it is factored.\ntemplate <class T>\nusing "
           "MassMatrix = "
        << functions.mass_type << ";\n";
  }
  if (!functions.newton_type.empty()) {
    out << "\n/// ca dr/da + cv dr/dv + cq dr/dq in the form in which it is factored.\n"
           "template <class T>\nusing NewtonMatrix = "
        << functions.newton_type << ";\n";
  }
  for (const EmittedFunction& function : functions.functions) {
    out << "\n/// " << function.comment;
    if (function.body.statements > 0) out << "\n/// " << operations_text(function.body);
    out << (function.body.along ? "\ntemplate <class T, class D>\n" : "\ntemplate <class T>\n")
        << function.signature << " {\n"
        << function.before << function.body.text << function.after << "}\n";
  }
  out << "\n}  // namespace catena::" << s.name << "\n";
  return out.str();
}

// As many points as a register of the processor holds numbers.
std::string several_at_once_text(const std::string& accelerations) {
  return "template <int sets>\n"
         "int32_t several(const catena_point* at, double* a) {\n"
         "  using Number = Lanes<sets>;\n"
         "  const auto numbers = [](const double* first) {\n"
         "    return reinterpret_cast<const Number*>(first);\n"
         "  };\n"
         "  const Point<Number> points{Number(at->t),  numbers(at->q), numbers(at->v), "
         "numbers(at->a),\n"
         "                             numbers(at->z), numbers(at->u), numbers(at->p)};\n"
         "  return " +
         accelerations +
         "(points, reinterpret_cast<Number*>(a));\n}\n"
         "#ifdef CATENA_PROCESSORS\n"
         "__attribute__((target(\"arch=x86-64-v4\"), flatten)) int32_t eight(const catena_point* "
         "at,\n"
         "                                                                double* a) {\n"
         "  return several<8>(at, a);\n}\n"
         "__attribute__((target(\"avx2\"), flatten)) int32_t four(const catena_point* at, double* "
         "a) {\n"
         "  return several<4>(at, a);\n}\n"
         "bool has_avx512() {  // what arch=x86-64-v4 stands for\n"
         "  return __builtin_cpu_supports(\"avx512f\") && __builtin_cpu_supports(\"avx512bw\") &&\n"
         "         __builtin_cpu_supports(\"avx512cd\") && __builtin_cpu_supports(\"avx512dq\") "
         "&&\n"
         "         __builtin_cpu_supports(\"avx512vl\");\n}\n"
         "int32_t sets_at_once() {\n"
         "  return has_avx512() ? 8 : __builtin_cpu_supports(\"avx2\") ? 4 : 2;\n}\n"
         "int32_t c_accelerations(const catena_point* at, double* a) {\n"
         "  static const int32_t sets = sets_at_once();\n"
         "  return sets == 8 ? eight(at, a) : sets == 4 ? four(at, a) : several<2>(at, a);\n}\n"
         "#elif defined(__GNUC__)\n"
         "#if defined(__AVX512F__)\n"
         "constexpr int kSets = 8;\n"
         "#elif defined(__AVX2__)\n"
         "constexpr int kSets = 4;\n"
         "#else\n"
         "constexpr int kSets = 2;\n"
         "#endif\n"
         "int32_t sets_at_once() { return kSets; }\n"
         "CATENA_EACH_PROCESSOR int32_t c_accelerations(const catena_point* at, double* a) {\n"
         "  return several<kSets>(at, a);\n}\n"
         "#else\n"
         "int32_t sets_at_once() { return 1; }\n"
         "int32_t c_accelerations(const catena_point* at, double* a) { return c_acceleration(at, "
         "a); }\n"
         "#endif\n";
}

std::string source_text(const Description& description, const ModelFunctions& functions) {
  const ModelSummary& s = functions.summary;
  std::ostringstream out;
  out << "// SPDX-License-Identifier: BSD-3-Clause\n"
      << kBanner << "#include \"" << s.name
      << ".hpp\"\n\n#include \"catena_model.h\"\n#include \"directions.hpp\"\n\nnamespace catena::"
      << s.name << " {\n\nnamespace {\n\n";
  out << table_arrays(description, functions);
  // Without fused multiply-adds, which -ffp-contract=off forbids, all give the same bits.
  out << "#if !defined(__GNUC__) || defined(__clang__) || defined(__SANITIZE_ADDRESS__)\n"
         "#define CATENA_EACH_PROCESSOR\n"
         "#elif defined(__x86_64__) && !defined(__AVX2__)\n"
         "// Compiled twice, for AVX2 where the processor has it; the bits are the same.\n"
         "#define CATENA_PROCESSORS\n"
         "#define CATENA_EACH_PROCESSOR __attribute__((target_clones(\"avx2\", \"default\"), "
         "flatten))\n"
         "#else\n"
         "#define CATENA_EACH_PROCESSOR __attribute__((flatten))\n"
         "#endif\n\n";
  out << "Point<double> point(const catena_point* p) {\n"
         "  return {p->t, p->q, p->v, p->a, p->z, p->u, p->p};\n}\n\n";
  for (const EmittedFunction& function : functions.functions) {
    if (!function.wrapper.empty()) out << "CATENA_EACH_PROCESSOR " << function.wrapper;
  }
  if (functions.several_at_once()) out << several_at_once_text(functions.accelerations);
  out << "}  // namespace\n\nconst ::catena_model& table() {\n"
         "  static const ::catena_model model = {\n";
  out << table_entries(description, functions, Language::kCpp);
  out << "  };\n  return model;\n}\n\n}  // namespace catena::" << s.name << "\n\n"
      << "#ifdef CATENA_SHARED_LIBRARY\n"
         "// The one entry of a shared library that holds this model alone.\n"
         "extern \"C\" const catena_model* catena_model_table() {\n  return &catena::"
      << s.name << "::table();\n}\n#endif\n";
  return out.str();
}

}  // namespace

std::string model_name(const Description& description, int links) {
  return description.id + "_" + std::to_string(links);
}

EmittedModel emit_model(const Description& description, int links, Layout layout) {
  const ModelFunctions functions = model_functions(description, links, layout, Language::kCpp);
  EmittedModel model;
  model.summary = functions.summary;
  const std::string name = functions.summary.name;
  model.files[name + ".hpp"] = header_text(description, functions);
  model.files[name + ".cpp"] = source_text(description, functions);
  return model;
}

}  // namespace catena
