// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/model_text.hpp"

#include <sstream>

namespace catena {

std::string operations_text(const OperationCount& count) {
  std::ostringstream out;
  out << affine_text(count.additions) << " additions, " << affine_text(count.multiplications)
      << " multiplications, " << affine_text(count.divisions) << " divisions, "
      << affine_text(count.functions) << " functions";
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

std::string processors_text() {
  return "#if !defined(__GNUC__) || defined(__clang__) || defined(__SANITIZE_ADDRESS__)\n"
         "#define CATENA_EACH_PROCESSOR\n"
         "#elif defined(__x86_64__) && !(defined(__AVX2__) && defined(__FMA__))\n"
         "// Compiled twice, for processors with AVX2 and fused multiply-add too; the bits are the "
         "same.\n"
         "#define CATENA_PROCESSORS\n"
         "#define CATENA_EACH_PROCESSOR \\\n"
         "  __attribute__((target_clones(\"arch=x86-64-v3\", \"default\"), flatten))\n"
         "#else\n"
         "#define CATENA_EACH_PROCESSOR __attribute__((flatten))\n"
         "#endif\n\n"
         "Point<double> point(const catena_point* p) {\n"
         "  return {p->t, p->q, p->v, p->a, p->z, p->u, p->p};\n}\n\n";
}

std::string newton_text(const std::string& matrix, const std::string& factored) {
  return "int32_t c_newton_factor(const catena_point* at, double ca, double cv, double cq,\n"
         "                        double* work) {\n" +
         matrix +
         "  newton_matrix(point(at), ca, cv, cq, matrix);\n"
         "  return matrix.factor();\n}\n" +
         factored +
         "CATENA_EACH_PROCESSOR void c_newton_solve(const double* work, double* x) {\n"
         "  factored(work).solve(x);\n}\n"
         "CATENA_EACH_PROCESSOR void c_newton_solves(const double* work, double* x) {\n"
         "  factored(work).solve(directions(x));\n}\n"
         "CATENA_EACH_PROCESSOR void c_newton_solve_transposed(const double* work, double* x) {\n"
         "  factored(work).solve_transposed(x);\n}\n";
}

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
         "__attribute__((target(\"arch=x86-64-v3\"), flatten)) int32_t four(const catena_point* "
         "at,\n"
         "                                                               double* a) {\n"
         "  return several<4>(at, a);\n}\n"
         "int32_t sets_at_once() {\n"
         "  return __builtin_cpu_supports(\"x86-64-v4\")   ? 8\n"
         "         : __builtin_cpu_supports(\"x86-64-v3\") ? 4\n"
         "                                                 : 2;\n}\n"
         "int32_t c_accelerations(const catena_point* at, double* a) {\n"
         "  static const int32_t sets = sets_at_once();\n"
         "  return sets == 8 ? eight(at, a) : sets == 4 ? four(at, a) : several<2>(at, a);\n}\n"
         "#elif defined(__GNUC__)\n"
         "#if defined(__AVX512F__)\n"
         "static constexpr int kSets = 8;\n"
         "#elif defined(__AVX2__)\n"
         "static constexpr int kSets = 4;\n"
         "#else\n"
         "static constexpr int kSets = 2;\n"
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

}  // namespace catena
