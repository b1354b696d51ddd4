// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/model_text.hpp"

#include <sstream>
#include <stdexcept>

#include "generator/emission/statement_text.hpp"

namespace catena {

namespace {

/// "20 additions, 12 multiplications, ..."
std::string operations_text(const OperationCount& count) {
  std::ostringstream out;
  out << affine_text(count.additions) << " additions, " << affine_text(count.multiplications)
      << " multiplications, " << affine_text(count.divisions) << " divisions, "
      << affine_text(count.functions) << " functions";
  return out.str();
}

/// Lines further in by two spaces; those of the preprocessor stay at the margin.
std::string indented(const std::string& text) {
  std::string out;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = text.find('\n', begin);
    const std::string line = text.substr(begin, end - begin);
    out += (line.empty() || line.front() == '#' ? "" : "  ") + line + "\n";
    begin = end + 1;
  }
  return out;
}

using Words = std::vector<std::string>;

// The heads of templates leave room for the indentation and the "const" of a member.
constexpr std::size_t kHeadWidth = 95;

std::string matrix_type(const MatrixForm& form, NumberOfLinks links) {
  const std::string size = links == NumberOfLinks::kAny ? "kAtRunTime, " : "kLinks, ";
  const std::string block = form.block > 1 ? "Block" : "";
  const std::string rank = std::to_string(form.lower_rank),
                    lower = rank + (form.block > 1 ? ", " + std::to_string(form.block) : "") + ">";
  if (form.border > 0)
    return "Bordered<T, " + size + std::to_string(form.upper_rank) + ", " +
           std::to_string(form.lower_rank) + ", " + std::to_string(form.block) + ", " +
           std::to_string(form.border) + ">";
  if (form.kind == MatrixForm::kSymmetricSemiseparable)
    return (form.block > 1 ? "Tangent" : "Symmetric") + std::string("Semiseparable<T, ") + size +
           rank + (form.isotropic ? ", true>" : ">");
  return block + "Quasiseparable<T, " + size + std::to_string(form.upper_rank) + ", " + lower;
}

std::string template_parameter(const Parameter& parameter) {
  const std::string type = parameter.type == Type::kDifferential ? "D" : "T";
  const std::string before = parameter.maybe_unused ? "[[maybe_unused]] " : "";
  switch (parameter.kind) {
    case ParameterKind::kPoint:
      return before + "const Point<" + type + ">& " + parameter.name;
    case ParameterKind::kNumber:
      return before + "const " + type + "& " + parameter.name;
    case ParameterKind::kNumbers:
      return before + "const " + type + "* " + parameter.name;
    case ParameterKind::kResults:
      return before + type + "* " + parameter.name;
    case ParameterKind::kTerm:
      return before + "int " + parameter.name;
    case ParameterKind::kMatrix:
      return before + "NewtonMatrix<" + type + ">& " + parameter.name;
  }
  return "";
}

bool returns_status(const Function& function) {
  return function.frame == Frame::kAcceleration || function.frame == Frame::kDenseAcceleration;
}

// ---- templates ------------------------------------------------------------------------------

class Templates {
 public:
  Templates(const ModelFunctions& model, NumberOfLinks links)
      : model_(model), any_(links == NumberOfLinks::kAny) {}

  std::string text() const {
    std::string out;
    for (const Function& function : model_.functions) out += text(function);
    return out;
  }

 private:
  std::string text(const Function& function) const {
    Words parameters;
    for (const Parameter& parameter : function.parameters)
      parameters.push_back(template_parameter(parameter));
    std::string head = "\n/// " + function.comment + "\n";
    if (!function.statements.empty())
      head += "/// " + operations_text(operations_of(function.statements)) + "\n";
    head += has_differentials(function) ? "template <class T, class D>\n" : "template <class T>\n";
    head += in_lines(result(function) + " " + function.name + "(", parameters,
                     any_ ? ") const {" : ") {", kHeadWidth);
    if (any_ && needs_links(function)) head += "  const int links = this->links();\n";
    head += before(function);
    const std::string after = this->after(function) + "}\n";
    const Arrays arrays = model_.space == Space::kPlane ? Arrays::kPlain : Arrays::kAligned;
    return (any_ ? indented(head) : head) +
           statements_text(function.statements, Language::kCpp, any_ ? 2 : 1, arrays) +
           (any_ ? indented(after) : after);
  }

  static bool needs_links(const Function& function) {
    bool needs = function.frame == Frame::kMassMatrix || function.frame == Frame::kAcceleration;
    Statements statements = function.statements;
    for_each_affine(statements, [&](const Affine& affine) { needs = needs || affine.slope != 0; });
    return needs;
  }

  static std::string result(const Function& function) {
    return returns_status(function) ? "int" : function.frame == Frame::kValue ? "T" : "void";
  }

  std::string before(const Function& function) const {
    const std::string n = any_ ? "n" : "kCoordinates";
    const std::string size = any_ ? "  const int n = coordinates();\n" : "";
    switch (function.frame) {
      case Frame::kStatements:
        return "";
      case Frame::kValue:
        return "  T out;\n";
      case Frame::kChooseTerm:
        return choice();
      case Frame::kMassMatrix:
      case Frame::kAcceleration:
        return mass_matrix();
      case Frame::kMassColumns:
        return size + "  T unit[" + n + "], column[" + n + "];\n" + "  for (int j = 0; j < " + n +
               "; ++j) unit[j] = T(0);\n"
               "  Point<T> moving = at;\n"
               "  moving.a = unit;\n"
               "  for (int j = 0; j < " +
               n +
               "; ++j) {\n"
               "    unit[j] = T(1);\n"
               "    inertial(moving, column);\n"
               "    unit[j] = T(0);\n"
               "    for (int i = 0; i < " +
               n + "; ++i) M[i * " + n + " + j] = column[i];\n  }\n";
      case Frame::kDenseAcceleration:
        return size + "  T mass[" + n + " * " + n +
               "];\n  mass_matrix(at, mass);\n  bias(at, a);\n  for (int i = 0; i < " + n +
               "; ++i) a[i] = -a[i];\n";
    }
    return "";
  }

  std::string after(const Function& function) const {
    switch (function.frame) {
      case Frame::kValue:
        return "  return out;\n";
      case Frame::kMassMatrix:
        return "  matrix.to_dense(M);\n";
      case Frame::kAcceleration:
        return model_.mass.kind == MatrixForm::kSymmetricSemiseparable
                   ? "  return matrix.solve(a);\n"
                   : "  const int failed = matrix.factor();\n"
                     "  if (failed == 0) matrix.solve(a);\n"
                     "  return failed;\n";
      case Frame::kDenseAcceleration:
        return any_ ? "  return solve_symmetric(n, mass, a);\n"
                    : "  return solve_symmetric<kCoordinates>(mass, a);\n";
      default:
        return "";
    }
  }

  std::string choice() const {
    std::string text = "  switch (term) {\n";
    for (std::size_t k = 0; k < model_.terms.size(); ++k) {
      text += "    case " + std::to_string(k) + ":\n      term_" + model_.terms[k] +
              "(at, r);\n      break;\n";
    }
    return text + "  }\n";
  }

  // The matrix that a function has for itself; for any number of links it needs arrays.
  std::string mass_matrix() const {
    if (!any_) return "  MassMatrix<T> matrix;\n";
    if (model_.mass.kind == MatrixForm::kQuasiseparable)
      return "  T numbers[MassMatrix<T>::numbers(links)];\n"
             "  MassMatrix<T> matrix(links, numbers);\n";
    const int rank = model_.mass.lower_rank;
    const auto arrays = [&](const std::string& name) {
      std::string list;
      for (int r = 0; r < rank; ++r)
        list += (r == 0 ? "" : ", ") + name + "[" + std::to_string(r) + "]";
      return "{" + list + "}";
    };
    const std::string of_rank = "[" + std::to_string(rank) + "][links]";
    return "  T row" + of_rank + ", column" + of_rank +
           ", diagonal[links];\n"
           "  const MassMatrix<T> matrix{links, " +
           arrays("row") + ", " + arrays("column") + ", diagonal};\n";
  }

  const ModelFunctions& model_;
  bool any_;
};

// ---- functions behind the table -------------------------------------------------------------

class TableFunctions {
 public:
  TableFunctions(const ModelFunctions& model, NumberOfLinks links)
      : model_(model), any_(links == NumberOfLinks::kAny) {}

  std::string text() const {
    std::string out = processors_text();
    if (any_)
      out +=
          "const Chain& chain(const void* context) {\n"
          "  return *static_cast<const Chain*>(context);\n}\n\n";
    for (const Function& function : model_.functions) {
      if (!function.in_table) continue;
      out += text(function, function.name, "");
      if (function.name == "residual_tangent" || function.name == "state_rate_tangent")
        out += text(function, function.name + "s", "directions");
    }
    if (model_.summary.structured) out += newton_text();
    if (any_ || model_.has_batch()) out += batch_text();
    return out;
  }

 private:
  static std::string processors_text() {
    return "#if !defined(__GNUC__) || defined(__clang__) || defined(__SANITIZE_ADDRESS__)\n"
           "#define CATENA_EACH_PROCESSOR\n"
           "#elif defined(__x86_64__) && !(defined(__AVX2__) && defined(__FMA__))\n"
           "// Compiled twice, for processors with AVX2 and fused multiply-add too; the bits are "
           "the "
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

  std::string head(const std::string& result, const std::string& name, Words arguments) const {
    arguments.insert(arguments.begin(), any_ ? "const void* context" : "const void*");
    return in_lines(result + " c_" + name + "(", arguments, ") {");
  }

  // `differentials`: what makes several directions of `along` and of results; empty: one.
  std::string text(const Function& function, const std::string& name,
                   const std::string& differentials) const {
    Words arguments, passed;
    for (const Parameter& parameter : function.parameters) {
      const bool several = parameter.type == Type::kDifferential && !differentials.empty();
      const std::string& argument = parameter.name;
      switch (parameter.kind) {
        case ParameterKind::kPoint:
          arguments.push_back("const catena_point* " + argument);
          passed.push_back((several ? differentials : "point") + "(" + argument + ")");
          continue;
        case ParameterKind::kNumber:
          arguments.push_back("double " + argument);
          break;
        case ParameterKind::kNumbers:
          arguments.push_back("const double* " + argument);
          break;
        case ParameterKind::kResults:
          arguments.push_back("double* " + argument);
          break;
        case ParameterKind::kTerm:
          arguments.push_back("int32_t " + argument);
          break;
        case ParameterKind::kMatrix:
          throw std::logic_error("a matrix in the table");
      }
      std::string several_of = differentials;
      several_of.append("(").append(argument).append(")");
      passed.push_back(several ? several_of : argument);
    }
    const std::string result = returns_status(function)          ? "int32_t"
                               : function.frame == Frame::kValue ? "double"
                                                                 : "void";
    return "CATENA_EACH_PROCESSOR\n" + head(result, name, arguments) +
           in_lines((result == "void" ? "  " : "  return ") + object() + function.name + "(",
                    passed, ");") +
           "}\n";
  }

  // Of which the functions are members.
  std::string object() const { return any_ ? "chain(context)." : ""; }
  // What functions that are not in the table take and are given first.
  Words with_context(Words arguments) const {
    if (any_) arguments.insert(arguments.begin(), "const void* context");
    return arguments;
  }
  std::string given(const std::string& arguments) const {
    return (any_ ? "(context, " : "(") + arguments + ")";
  }

  std::string newton_text() const {
    const std::string each = "CATENA_EACH_PROCESSOR\n";
    const std::string type = any_ ? "NewtonMatrix<double>" : "NewtonMatrix<double>&";
    const auto solve = [&](const std::string& name, const std::string& call) {
      return each + head("void", name, {"const double* work", "double* x"}) + "  factored" +
             given("work") + "." + call + ";\n}\n";
    };
    return in_lines(type + " matrix_in(", with_context({"double* work"}), ") {") + "  return " +
           (any_ ? "{chain(context).links(), work}"
                 : "*reinterpret_cast<NewtonMatrix<double>*>(work)") +
           ";\n}\n" +
           in_lines("const " + type + " factored(", with_context({"const double* work"}), ") {") +
           "  return matrix_in" + given("const_cast<double*>(work)") +
           ";  // solving only reads\n}\n" + each +
           head("int32_t", "newton_factor",
                {"const catena_point* at", "double ca", "double cv", "double cq",
                 "double* __restrict work"}) +  // so that loops need not ask whether arrays overlap
           "  auto&& matrix = matrix_in" +
           given("work") + ";\n  " + object() +
           "newton_matrix(point(at), ca, cv, cq, matrix);\n  return matrix.factor();\n}\n" +
           solve("newton_solve", "solve(x)") + solve("newton_solves", "solve(directions(x))") +
           (model_.set == FunctionSet::kAll
                ? solve("newton_solve_transposed", "solve_transposed(x)")
                : "");
  }

  std::string batch_text() const {
    const Words point{"const catena_point* at", "double* a"}, arguments = with_context(point);
    const std::string passed = given("at, a");
    const auto on = [&](const std::string& processor, const std::string& name,
                        const std::string& batch) {
      return "__attribute__((target(\"" + processor + "\"), flatten))\n" +
             in_lines("int32_t " + name + "(", arguments, ") {") + "  return batch_of<" + batch +
             ">" + passed + ";\n}\n";
    };
    const std::string entry = head("int32_t", "accelerations", point);
    return "template <int size>\n" + in_lines("int32_t batch_of(", arguments, ") {") +
           "  using Number = Batch<size>;\n"
           "  const auto numbers = [](const double* first) {\n"
           "    return reinterpret_cast<const Number*>(first);\n"
           "  };\n"
           "  const Point<Number> points{Number(at->t),  numbers(at->q), numbers(at->v), "
           "numbers(at->a),\n"
           "                             numbers(at->z), numbers(at->u), numbers(at->p)};\n"
           "  return " +
           object() + model_.accelerations +
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
                    {"const void* context", "const catena_point* at", "double* a"}, ") {") +
           "  return c_acceleration(context, at, a);\n}\n#endif\n";
  }

  const ModelFunctions& model_;
  bool any_;
};

}  // namespace

std::string structure_text(const ModelFunctions& functions) {
  const ModelSummary& s = functions.summary;
  std::ostringstream out;
  if (s.mass_structured) {
    const std::string rows = std::to_string(s.block);
    out << "//   M: semiseparable of rank " << s.mass_rank
        << (s.block > 1 ? ", in blocks of " + rows + " x " + rows : "")
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
  if (s.border > 0 && s.structured)
    out << "//   both bordered by " << s.border
        << " rows and columns of no link, which a Schur complement eliminates\n";
  if (s.stiffness_tridiagonal) out << "//   K: constant, symmetric, tridiagonal\n";
  if (s.damping_tridiagonal) out << "//   C: constant, symmetric, tridiagonal\n";
  return out.str();
}

std::string in_lines(std::string head, const std::vector<std::string>& arguments,
                     const std::string& end, std::size_t width) {
  const std::string indent(head.find_last_of('(') + 1, ' ');
  std::string text;
  for (std::size_t k = 0; k < arguments.size(); ++k) {
    const bool last = k + 1 == arguments.size();
    const std::string argument = arguments[k] + (last ? end : ",");
    if (head.size() + argument.size() > width && k > 0) {
      text += head.substr(0, head.size() - 1) + "\n";
      head = indent;
    }
    head += argument + (last ? "\n" : " ");
  }
  return text + head;
}

std::string space_include(const ModelFunctions& functions) {
  std::string bordered = functions.summary.border > 0 ? "#include \"bordered.hpp\"\n" : "";
  if (functions.space == Space::kPlane) return bordered;
  return "#include \"angle_over_sine.hpp\"\n"
         "#include \"block_quasiseparable.hpp\"\n" +
         bordered +
         "#include \"link_array.hpp\"\n"
         "#include \"tangent_semiseparable.hpp\"\n";
}

std::string matrix_types_text(const ModelFunctions& functions, NumberOfLinks links) {
  std::string out;
  if (functions.mass.kind != MatrixForm::kDense)
    out +=
        "\n/// Mass matrix in the form in which it is factored.\ntemplate <class T>\nusing "
        "MassMatrix = " +
        matrix_type(functions.mass, links) + ";\n";
  if (functions.newton.kind != MatrixForm::kDense)
    out +=
        "\n/// ca dr/da + cv dr/dv + cq dr/dq in the form in which it is factored.\n"
        "template <class T>\nusing NewtonMatrix = " +
        matrix_type(functions.newton, links) + ";\n";
  return out;
}

std::string functions_text(const ModelFunctions& functions, NumberOfLinks links) {
  return Templates(functions, links).text();
}

std::string table_functions_text(const ModelFunctions& functions, NumberOfLinks links) {
  return TableFunctions(functions, links).text();
}

}  // namespace catena
