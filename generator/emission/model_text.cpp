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

namespace {

constexpr std::size_t kColumns = 100;

// The arguments of a head behind its name, in lines that end before the margin.
std::string in_lines(std::string head, const std::string& arguments) {
  const std::string indent(head.size(), ' ');
  std::istringstream rest(arguments);
  std::string text, argument;
  while (std::getline(rest, argument, ',')) {
    argument.erase(0, argument.find_first_not_of(' '));
    const bool more = rest.good();
    argument += more ? "," : ") {";
    if (head.size() + argument.size() > kColumns) {
      head.erase(head.find_last_not_of(' ') + 1);
      text += head + "\n";
      head = indent;
    }
    head += argument + (more ? " " : "");
  }
  return text + head + "\n";
}

std::string head(const Context& context, const std::string& result, const std::string& name,
                 const std::string& arguments) {
  return in_lines(result + " c_" + name + "(", context.parameter + ", " + arguments);
}

}  // namespace

std::string table_function_text(const TableFunction& function, const Context& context) {
  return "CATENA_EACH_PROCESSOR\n" +
         head(context, function.result, function.name, function.arguments) +
         (function.result == "void" ? "  " : "  return ") + context.object + function.call +
         ";\n}\n";
}

std::string newton_text(const Context& context, const std::string& matrix_type,
                        const std::string& matrix_in_work) {
  const std::string each = "CATENA_EACH_PROCESSOR\n", passed = context.argument;
  const auto solve = [&](const std::string& name, const std::string& call) {
    return each + head(context, "void", name, "const double* work, double* x") + "  factored(" +
           passed + "work)." + call + ";\n}\n";
  };
  return matrix_type + " matrix_in(" + context.inner_parameter + "double* work) {\n  return " +
         matrix_in_work + ";\n}\nconst " + matrix_type + " factored(" + context.inner_parameter +
         "const double* work) {\n  return matrix_in(" + passed +
         "const_cast<double*>(work));  // solving only reads\n}\n" + each +
         head(context, "int32_t", "newton_factor",
              "const catena_point* at, double ca, double cv, double cq, double* work") +
         "  auto&& matrix = matrix_in(" + passed + "work);\n  " + context.object +
         "newton_matrix(point(at), ca, cv, cq, matrix);\n  return matrix.factor();\n}\n" +
         solve("newton_solve", "solve(x)") + solve("newton_solves", "solve(directions(x))") +
         solve("newton_solve_transposed", "solve_transposed(x)");
}

std::string batch_text(const Context& context, const std::string& accelerations) {
  const std::string arguments = context.inner_parameter + "const catena_point* at, double* a";
  const std::string passed = "(" + context.argument + "at, a)";
  const auto on = [&](const std::string& processor, const std::string& name,
                      const std::string& batch) {
    return "__attribute__((target(\"" + processor + "\"), flatten))\n" +
           in_lines("int32_t " + name + "(", arguments) + "  return batch_of<" + batch + ">" +
           passed + ";\n}\n";
  };
  const std::string entry =
      head(context, "int32_t", "accelerations", "const catena_point* at, double* a");
  return "template <int batch>\n" + in_lines("int32_t batch_of(", arguments) +
         "  using Number = Lanes<batch>;\n"
         "  const auto numbers = [](const double* first) {\n"
         "    return reinterpret_cast<const Number*>(first);\n"
         "  };\n"
         "  const Point<Number> points{Number(at->t),  numbers(at->q), numbers(at->v), "
         "numbers(at->a),\n"
         "                             numbers(at->z), numbers(at->u), numbers(at->p)};\n"
         "  return " +
         context.object + accelerations +
         "(points, reinterpret_cast<Number*>(a));\n}\n"
         "#ifdef CATENA_PROCESSORS\n" +
         on("arch=x86-64-v4", "eight", "8") + on("arch=x86-64-v3", "four", "4") +
         "int32_t batch_size() {\n"
         "  return __builtin_cpu_supports(\"x86-64-v4\")   ? 8\n"
         "         : __builtin_cpu_supports(\"x86-64-v3\") ? 4\n"
         "                                                 : 2;\n}\n" +
         entry +
         "  static const int32_t batch = batch_size();\n"
         "  return batch == 8 ? eight" +
         passed + " : batch == 4 ? four" + passed + " : batch_of<2>" + passed +
         ";\n}\n"
         "#elif defined(__GNUC__)\n"
         "#if defined(__AVX512F__)\n"
         "static constexpr int kBatch = 8;\n"
         "#elif defined(__AVX2__)\n"
         "static constexpr int kBatch = 4;\n"
         "#else\n"
         "static constexpr int kBatch = 2;\n"
         "#endif\n"
         "int32_t batch_size() { return kBatch; }\n"
         "CATENA_EACH_PROCESSOR\n" +
         entry + "  return batch_of<kBatch>" + passed +
         ";\n}\n"
         "#else\n"
         "int32_t batch_size() { return 1; }\n" +
         in_lines("int32_t c_accelerations(",
                  "const void* context, const catena_point* at, double* a") +
         "  return c_acceleration(context, at, a);\n}\n#endif\n";
}

}  // namespace catena
