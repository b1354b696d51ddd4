// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/c_writer.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include "generator/emission/c_block_matrices.hpp"
#include "generator/emission/model_functions.hpp"
#include "generator/emission/model_text.hpp"
#include "generator/emission/statement_text.hpp"
#include "generator/emission/table_text.hpp"

namespace catena {

namespace {

const char* const kCBanner =
    "/* SPDX-License-Identifier: BSD-3-Clause\n"
    " *\n"
    " * Written by catena-derive. Do not edit: change the model description and derive again. */\n";

const char* const kSinesAndCosines = R"(
static void sines_and_cosines(const double* angle, double* sine, double* cosine) {
  for (int i = 0; i < kLinks; ++i) {
    sine[i] = sin(angle[i]);
    cosine[i] = cos(angle[i]);
  }
}
)";

// Those of generator/emission/support/angle_over_sine.hpp, which says more. Only a chain that is bent at rest
// uses the last one.
const char* const kAngleOverSine = R"(
static double inverse_square_root(double x) { return 1.0 / sqrt(x); }

static double sign_or_one(double x) { return x < 0.0 ? -1.0 : 1.0; }

static double squared_angle(double cosine) {
  const double rest = 1.0 - cosine;
  double sum = 1.0;
  if (!(rest < 1.0 / 64.0)) return acos(cosine) * acos(cosine);
  for (int k = 12; k > 0; --k)
    sum = 1.0 + (double)(k * k) / ((k + 1) * (2 * k + 1)) * rest * sum;
  return 2.0 * rest * sum;
}

static double angle_over_sine(double cosine) {
  const double rest = 1.0 - cosine;
  double sum = 1.0;
  if (!(rest < 1.0 / 64.0)) return acos(cosine) / sqrt(rest * (1.0 + cosine));
  for (int k = 12; k > 0; --k) sum = 1.0 + (double)k / (2 * k + 1) * rest * sum;
  return sum;
}

static double angle_over_sine_slope(double cosine) {
  const double rest = 1.0 - cosine;
  double sum = 1.0;
  if (!(rest < 1.0 / 8.0))
    return (cosine * angle_over_sine(cosine) - 1.0) / (rest * (1.0 + cosine));
  for (int k = 16; k > 0; --k)
    sum = 1.0 + (double)((k + 1) * (k + 1)) / (k * (2 * k + 3)) * rest * sum;
  return -sum / 3.0;
}

static inline double angle_over_sine_curvature(double cosine) {
  const double rest = 1.0 - cosine;
  double sum = 1.0;
  if (!(rest < 1.0 / 4.0))
    return (3.0 * cosine * angle_over_sine_slope(cosine) + angle_over_sine(cosine)) /
           (rest * (1.0 + cosine));
  for (int k = 20; k > 0; --k)
    sum = 1.0 + (double)((k + 2) * (k + 2)) / (k * (2 * k + 5)) * rest * sum;
  return 4.0 * sum / 15.0;
}
)";

// A_ij = row_i . column_j for j < i, symmetric, positive definite: rows are eliminated from the
// last up.
const char* const kSemiseparable = R"(
typedef struct {
  double row[kRank][kLinks], column[kRank][kLinks], diagonal[kLinks];
} MassMatrix; /* M_ij = row_i . column_j for j < i, symmetric */

static void to_dense(const MassMatrix* matrix, double* M) {
  for (int i = 0; i < kLinks; ++i) {
    M[i * kLinks + i] = matrix->diagonal[i];
    for (int j = 0; j < i; ++j) {
      double entry = 0.0;
      for (int r = 0; r < kRank; ++r) entry += matrix->row[r][i] * matrix->column[r][j];
      M[i * kLinks + j] = entry;
      M[j * kLinks + i] = entry;
    }
  }
}

/* Overwrites x, the right-hand side, with the solution; uses the matrix up. Returns 0, or the
   1-based row whose pivot is not positive. */
static int32_t solve_in_place(MassMatrix* matrix, double* x) {
  double w[kRank][kRank] = {{0.0}}, carried[kRank] = {0.0}, sum[kRank] = {0.0};
  for (int j = kLinks - 1; j >= 0; --j) {
    double column[kRank], row[kRank];
    for (int r = 0; r < kRank; ++r) {
      column[r] = matrix->column[r][j];
      row[r] = matrix->row[r][j];
    }
    double pivot = matrix->diagonal[j];
    for (int r = 0; r < kRank; ++r) {
      double product = 0.0;
      for (int s = 0; s < kRank; ++s) product += w[r][s] * column[s];
      pivot -= column[r] * product;
      x[j] -= column[r] * carried[r];
      matrix->row[r][j] = row[r] -= product;
    }
    if (!(pivot > 0.0)) return j + 1;
    matrix->diagonal[j] = 1.0 / pivot;
    x[j] *= matrix->diagonal[j];
    for (int r = 0; r < kRank; ++r) {
      for (int s = 0; s < kRank; ++s) w[r][s] += row[r] * row[s] * matrix->diagonal[j];
      carried[r] += row[r] * x[j];
    }
  }
  for (int j = 0; j < kLinks; ++j) {
    double product = 0.0;
    for (int r = 0; r < kRank; ++r) product += matrix->row[r][j] * sum[r];
    x[j] -= product * matrix->diagonal[j];
    for (int r = 0; r < kRank; ++r) sum[r] += matrix->column[r][j] * x[j];
  }
  return 0;
}
)";

const char* const kDense = R"(
/* Solves A x = b, A = L D L' (row by row; overwritten), x holding b before and x after. Returns 0,
   or the 1-based row whose pivot is not positive. */
static int32_t solve_symmetric(double* a, double* x) {
  enum { n = kCoordinates };
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < j; ++k) {
      const double scaled = a[j * n + k] * a[k * n + k];
      a[j * n + j] -= a[j * n + k] * scaled;
      for (int i = j + 1; i < n; ++i) a[i * n + j] -= a[i * n + k] * scaled;
    }
    if (!(a[j * n + j] > 0.0)) return j + 1;
    for (int i = j + 1; i < n; ++i) a[i * n + j] /= a[j * n + j];
  }
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= a[i * n + k] * x[k];
  }
  for (int i = 0; i < n; ++i) x[i] /= a[i * n + i];
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) x[i] -= a[k * n + i] * x[k];
  }
  return 0;
}
)";

// The elimination of generator/emission/support/quasiseparable.hpp, which has the derivation.
// @Matrix: the type; @matrix: what its functions begin with; @upper, @lower: ranks.
const char* const kQuasiseparable = R"(
/* M_ij = upper_row_i . upper_column_j for j > i, lower_row_i . lower_column_j for j < i, and above_i
   (j = i + 1), below_i (j = i - 1) besides; diagonal_i is the whole entry. */
typedef struct {
  double upper_row[@upper][kLinks], upper_column[@upper][kLinks];
  double lower_row[@lower][kLinks], lower_column[@lower][kLinks];
  double diagonal[kLinks], below[kLinks], above[kLinks];
} @Matrix;

/* Factors in place: diagonal holds the reciprocal pivots then, rows are scaled by them. Returns 0,
   or the 1-based row whose pivot vanished. */
static int32_t @matrix_factor_in_place(@Matrix* m) {
  double w[@upper][@lower] = {{0.0}}, column[@upper], row[@lower];
  double pivot = m->diagonal[kLinks - 1];
  for (int r = 0; r < @upper; ++r) column[r] = m->upper_column[r][kLinks - 1];
  for (int s = 0; s < @lower; ++s) row[s] = m->lower_row[s][kLinks - 1];
  m->above[kLinks - 1] = 0.0;
  for (int j = kLinks - 1;; --j) {
    if (!(pivot > 0.0 || pivot < 0.0)) return j + 1;
    const double reciprocal = 1.0 / pivot;
    double next_column[@upper], next_row[@lower];
    m->diagonal[j] = reciprocal;
    m->above[j] *= reciprocal;
    for (int r = 0; r < @upper; ++r) {
      m->upper_column[r][j] = column[r];
      m->upper_row[r][j] *= reciprocal;
    }
    for (int s = 0; s < @lower; ++s) m->lower_row[s][j] = row[s] * reciprocal;
    if (j == 0) return 0;
    double entry_above = m->above[j - 1], entry_below = m->below[j];
    for (int r = 0; r < @upper; ++r) entry_above += m->upper_row[r][j - 1] * column[r];
    for (int s = 0; s < @lower; ++s) entry_below += row[s] * m->lower_column[s][j - 1];
    pivot = m->diagonal[j - 1];
    for (int r = 0; r < @upper; ++r) {
      double product = 0.0;
      for (int s = 0; s < @lower; ++s) product += w[r][s] * m->lower_column[s][j - 1];
      pivot -= m->upper_row[r][j - 1] * product;
      next_column[r] = m->upper_column[r][j - 1] - product;
    }
    for (int s = 0; s < @lower; ++s) {
      next_row[s] = m->lower_row[s][j - 1];
      for (int r = 0; r < @upper; ++r) next_row[s] -= m->upper_row[r][j - 1] * w[r][s];
    }
    pivot -= entry_above * entry_below * reciprocal;
    m->above[j - 1] = entry_above;
    m->below[j] = entry_below * reciprocal;
    for (int r = 0; r < @upper; ++r) {
      for (int s = 0; s < @lower; ++s) w[r][s] += column[r] * m->lower_row[s][j];
      column[r] = next_column[r] - column[r] * m->below[j];
    }
    for (int s = 0; s < @lower; ++s) row[s] = next_row[s] - entry_above * m->lower_row[s][j];
  }
}

/* Overwrites x, the right-hand side, with the solution; after @matrix_factor_in_place. */
static void @matrix_solve_in_place(const @Matrix* m, double* x) {
  double carried[@upper] = {0.0}, sum[@lower] = {0.0};
  for (int j = kLinks - 1; j >= 0; --j) {
    if (j + 2 < kLinks) {
      for (int r = 0; r < @upper; ++r) carried[r] += m->upper_column[r][j + 2] * x[j + 2];
    }
    x[j] *= m->diagonal[j];
    for (int r = 0; r < @upper; ++r) x[j] -= m->upper_row[r][j] * carried[r];
    if (j + 1 < kLinks) x[j] -= m->above[j] * x[j + 1];
  }
  for (int j = 1; j < kLinks; ++j) {
    if (j > 1) {
      for (int s = 0; s < @lower; ++s) sum[s] += m->lower_column[s][j - 2] * x[j - 2];
    }
    for (int s = 0; s < @lower; ++s) x[j] -= m->lower_row[s][j] * sum[s];
    x[j] -= m->below[j] * x[j - 1];
  }
}
)";

const char* const kQuasiseparableDense = R"(
static void to_dense(const MassMatrix* m, double* M) {
  for (int i = 0; i < kLinks; ++i) {
    for (int j = 0; j < kLinks; ++j) {
      double entry = i == j ? m->diagonal[i] : 0.0;
      if (j > i) {
        for (int r = 0; r < @upper; ++r) entry += m->upper_row[r][i] * m->upper_column[r][j];
        if (j == i + 1) entry += m->above[i];
      } else if (j < i) {
        for (int s = 0; s < @lower; ++s) entry += m->lower_row[s][i] * m->lower_column[s][j];
        if (j == i - 1) entry += m->below[i];
      }
      M[i * kLinks + j] = entry;
    }
  }
}
)";

const char* const kFactorAndSolve = R"(
static int32_t solve_in_place(MassMatrix* matrix, double* x) {
  const int32_t failed = mass_factor_in_place(matrix);
  if (failed == 0) mass_solve_in_place(matrix, x);
  return failed;
}
)";

const char* const kNewton = R"(
static int32_t newton_factor(const void* context, const catena_point* at, double ca, double cv,
                             double cq, double* work) {
  NewtonMatrix* const matrix = (NewtonMatrix*)work;
  (void)context;
  newton_matrix(at, ca, cv, cq, matrix);
  return newton_factor_in_place(matrix);
}

static void newton_solve(const void* context, const double* work, double* x) {
  (void)context;
  newton_solve_in_place((@Solved*)work, x);
}

static void newton_solve_transposed(const void* context, const double* work, double* x) {
  (void)context;
  newton_solve_transposed_in_place((@Solved*)work, x);
}

/* CATENA_DIRECTIONS right-hand sides, one after the other. */
static void newton_solves(const void* context, const double* work, double* x) {
  double one[kCoordinates];
  for (int k = 0; k < CATENA_DIRECTIONS; ++k) {
    for (int i = 0; i < kCoordinates; ++i) one[i] = x[i * CATENA_DIRECTIONS + k];
    newton_solve(context, work, one);
    for (int i = 0; i < kCoordinates; ++i) x[i * CATENA_DIRECTIONS + k] = one[i];
  }
}
)";

const char* const kSolveTransposed = R"(
/* The same with the transpose of the matrix. */
static void newton_solve_transposed_in_place(const NewtonMatrix* m, double* x) {
  double carried[@upper] = {0.0}, sum[@lower] = {0.0};
  for (int j = kLinks - 2; j >= 0; --j) {
    if (j + 2 < kLinks) {
      for (int s = 0; s < @lower; ++s) sum[s] += m->lower_row[s][j + 2] * x[j + 2];
    }
    for (int s = 0; s < @lower; ++s) x[j] -= m->lower_column[s][j] * sum[s];
    x[j] -= m->below[j + 1] * x[j + 1];
  }
  for (int j = 1; j < kLinks; ++j) {
    if (j > 1) {
      for (int r = 0; r < @upper; ++r) carried[r] += m->upper_row[r][j - 2] * x[j - 2];
    }
    for (int r = 0; r < @upper; ++r) x[j] -= m->upper_column[r][j] * carried[r];
    x[j] -= m->above[j - 1] * x[j - 1];
  }
  for (int j = 0; j < kLinks; ++j) x[j] *= m->diagonal[j];
}
)";

// `text` with @Matrix and the others filled in: those of c_block_matrices.hpp. Arrays have at least one entry.
std::string filled_in(const std::string& text, const std::string& type, const MatrixForm& form) {
  const std::map<std::string, std::string> values = {
      {"members", form.border > 0 ? kBorderMembers : ""},
      {"Matrix", type == "mass" ? "MassMatrix" : "NewtonMatrix"},
      {"Solved", is_in_blocks(form) ? "NewtonMatrix" : "const NewtonMatrix"},
      {"border", std::to_string(form.border)},
      {"isotropic", form.isotropic ? "1" : "0"},
      {"block", std::to_string(form.block)},
      {"matrix", type + (form.border > 0 ? "_links" : "")},
      {"whole", type},
      {"upper", std::to_string(std::max(form.upper_rank, 1))},
      {"lower", std::to_string(std::max(form.lower_rank, 1))}};
  std::string out;
  for (std::size_t k = 0; k < text.size();) {
    const auto here = std::find_if(values.begin(), values.end(), [&](const auto& value) {
      return text[k] == '@' && text.compare(k + 1, value.first.size(), value.first) == 0;
    });
    if (here == values.end()) {
      out += text[k++];
    } else {
      out += here->first == "members" ? filled_in(here->second, type, form) : here->second;
      k += 1 + here->first.size();
    }
  }
  return out;
}

// The type of a matrix without symmetry, its factors and the solution.
std::string quasiseparable_text(const MatrixForm& form) {
  return (is_in_blocks(form) ? kBlockQuasiseparable : kQuasiseparable) +
         std::string(form.border > 0 ? kBordered : "");
}

std::string matrices_text(const ModelFunctions& functions) {
  const MatrixForm &mass = functions.mass, &newton = functions.newton;
  std::string text;
  switch (mass.kind) {
    case MatrixForm::kDense:
      text = kDense;
      break;
    case MatrixForm::kSymmetricSemiseparable:
      text = mass.block > 1 ? filled_in(kTangentSemiseparable, "mass", mass) : kSemiseparable;
      break;
    case MatrixForm::kQuasiseparable:
      text =
          filled_in(quasiseparable_text(mass) +
                        (mass.border > 0 ? kBorderedDense : kQuasiseparableDense) + kFactorAndSolve,
                    "mass", mass);
      break;
  }
  if (!functions.summary.structured) return text;
  return text + filled_in(quasiseparable_text(newton) +
                              (is_in_blocks(newton) ? kBlockSolveTransposed : kSolveTransposed) +
                              (newton.border > 0 ? kBorderedTransposed : ""),
                          "newton", newton);
}

std::string argument_text(const Parameter& parameter) {
  switch (parameter.kind) {
    case ParameterKind::kPoint:
      return "const catena_point* " + parameter.name;
    case ParameterKind::kNumber:
      return "double " + parameter.name;
    case ParameterKind::kNumbers:
      return "const double* " + parameter.name;
    case ParameterKind::kResults:
      return "double* " + parameter.name;
    case ParameterKind::kTerm:
      return "int32_t " + parameter.name;
    case ParameterKind::kMatrix:
      return "NewtonMatrix* " + parameter.name;
  }
  return "";
}

const char* const kMassColumns =
    "  double unit[kCoordinates], column[kCoordinates];\n"
    "  catena_point moving = *at;\n"
    "  for (int j = 0; j < kCoordinates; ++j) unit[j] = 0.0;\n"
    "  moving.a = unit;\n"
    "  for (int j = 0; j < kCoordinates; ++j) {\n"
    "    unit[j] = 1.0;\n"
    "    inertial(&moving, column);\n"
    "    unit[j] = 0.0;\n"
    "    for (int i = 0; i < kCoordinates; ++i) M[i * kCoordinates + j] = column[i];\n"
    "  }\n";

const char* const kDenseAcceleration =
    "  double mass[kCoordinates * kCoordinates];\n"
    "  mass_matrix(context, at, mass);\n"
    "  bias(context, at, a);\n"
    "  for (int i = 0; i < kCoordinates; ++i) a[i] = -a[i];\n"
    "  return solve_symmetric(mass, a);\n";

// All entries that the statements leave out are zero.
const char* const kMatrix =
    "  MassMatrix storage, *const matrix = &storage;\n"
    "  memset(matrix, 0, sizeof *matrix);\n";

std::string before(const ModelFunctions& model, const Function& function) {
  switch (function.frame) {
    case Frame::kStatements:
      return "";
    case Frame::kValue:
      return "  double out;\n";
    case Frame::kChooseTerm: {
      std::string text = "  switch (term) {\n";
      for (std::size_t k = 0; k < model.terms.size(); ++k) {
        text += "    case " + std::to_string(k) + ":\n      term_" + model.terms[k] +
                "(at, r);\n      break;\n";
      }
      return text + "  }\n";
    }
    case Frame::kMassMatrix:
    case Frame::kAcceleration:
      return kMatrix;
    case Frame::kMassColumns:
      return kMassColumns;
    case Frame::kDenseAcceleration:
      return kDenseAcceleration;
  }
  return "";
}

std::string after(const Function& function) {
  return function.frame == Frame::kValue          ? "  return out;\n"
         : function.frame == Frame::kMassMatrix   ? "  to_dense(matrix, M);\n"
         : function.frame == Frame::kAcceleration ? "  return solve_in_place(matrix, a);\n"
                                                  : "";
}

// Functions of the table take its context; nothing of it is needed.
std::string function_text(const ModelFunctions& model, const Function& function) {
  const bool status =
      function.frame == Frame::kAcceleration || function.frame == Frame::kDenseAcceleration;
  const std::string result = status                            ? "int32_t "
                             : function.frame == Frame::kValue ? "double "
                                                               : "void ";
  std::vector<std::string> arguments, unused;
  if (function.in_table) arguments.push_back("const void* context");
  if (function.in_table && function.frame != Frame::kDenseAcceleration) unused.push_back("context");
  for (const Parameter& parameter : function.parameters) {
    arguments.push_back(argument_text(parameter));
    if (parameter.maybe_unused) unused.push_back(parameter.name);
  }
  std::string text = "\n/* " + function.comment + " */\n" +
                     in_lines("static " + result + function.name + "(", arguments, ") {");
  for (const std::string& name : unused) text += "  (void)" + name + ";\n";
  return text + before(model, function) + statements_text(function.statements, Language::kC, 1) +
         after(function) + "}\n";
}

std::string c_source_text(const Description& description, const ModelFunctions& functions) {
  const ModelSummary& s = functions.summary;
  std::ostringstream out;
  out << kCBanner << "#include \"" << s.name
      << ".h\"\n\n#include <math.h>\n#include <stddef.h>\n#include <string.h>\n\nenum {\n"
      << "  kLinks = " << s.links << ",\n  kCoordinates = " << s.coordinates
      << ",\n  kStates = " << s.states << ",\n  kSignals = " << s.signals
      << ",\n  kParameters = " << s.parameters;
  // A single link has rank 0, an array at least one entry.
  if (functions.mass.kind == MatrixForm::kSymmetricSemiseparable && functions.mass.block == 1)
    out << ",\n  kRank = " << std::max(functions.mass.lower_rank, 1);
  out << "\n};\n"
      << (functions.space == Space::kPlane ? kSinesAndCosines : kAngleOverSine)
      << matrices_text(functions);
  for (const Function& function : functions.functions) {
    if (function.in_table || function.name != functions.accelerations)
      out << function_text(functions, function);
  }
  if (s.structured) out << filled_in(kNewton, "newton", functions.newton);
  TableText table;
  table.size = "sizeof(catena_model)";
  table.null = table.context = "NULL";
  table.newton_work = "sizeof(NewtonMatrix) / sizeof(double)";
  table.batch = "1";
  table.function = [](const std::string& name) -> std::string {
    if (name == "residual_tangents" || name == "state_rate_tangents") return "NULL";
    return name == "accelerations" ? "acceleration" : name;
  };
  out << "\n"
      << table_arrays(description, functions) << "const catena_model* " << s.name << "(void) {\n"
      << "  static const catena_model model = {\n"
      << table_members(description, functions, table) << "  };\n  return &model;\n}\n";
  return out.str();
}

std::string c_header_text(const ModelSummary& s) {
  std::ostringstream out;
  out << kCBanner << "#ifndef CATENA_MODEL_" << s.name << "\n#define CATENA_MODEL_" << s.name
      << "\n\n#include \"catena_model.h\"\n\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n"
      << "/* The functions of a hanging chain of " << s.links << " link"
      << (s.links == 1 ? "" : "s") << "; see catena_model.h. */\nconst catena_model* " << s.name
      << "(void);\n\n#ifdef __cplusplus\n}\n#endif\n#endif\n";
  return out.str();
}

}  // namespace

EmittedModel emit_c_model(const Description& description, int links, Layout layout) {
  const ModelFunctions functions = model_functions(description, links, layout);
  const std::string name = functions.summary.name;
  return {functions.summary,
          {{name + ".c", c_source_text(description, functions)},
           {name + ".h", c_header_text(functions.summary)}}};
}

}  // namespace catena
