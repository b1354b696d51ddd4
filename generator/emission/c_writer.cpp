// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/c_writer.hpp"

#include <algorithm>
#include <sstream>

#include "generator/emission/model_functions.hpp"
#include "generator/emission/table_text.hpp"

namespace catena {

namespace {

const char* const kBanner =
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

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// "void residual(const Point<T>& at, T* r)" in C; every function takes the table's context.
std::string c_signature(std::string signature) {
  signature.insert(signature.find('(') + 1, "const void* context, ");
  for (const auto& [from, to] : {std::pair{"[[maybe_unused]] ", ""},
                                 {"const Point<T>&", "const catena_point*"},
                                 {"const Point<D>&", "const catena_point*"},
                                 {"const T&", "double"},
                                 {"T*", "double*"},
                                 {"D*", "double*"},
                                 {"int acceleration", "int32_t acceleration"},
                                 {"int term", "int32_t term"}}) {
    signature = replaced(signature, from, to);
  }
  return signature.starts_with("T ") ? "double " + signature.substr(2) : signature;
}

std::string source_text(const Description& description, const ModelFunctions& functions) {
  const ModelSummary& s = functions.summary;
  std::ostringstream out;
  out << kBanner << "#include \"" << s.name
      << ".h\"\n\n#include <math.h>\n#include <stddef.h>\n\nenum {\n"
      << "  kLinks = " << s.links << ",\n  kCoordinates = " << s.coordinates
      << ",\n  kStates = " << s.states << ",\n  kSignals = " << s.signals
      << ",\n  kParameters = " << s.parameters;
  // A single link has rank 0, an array at least one entry.
  if (s.mass_structured) out << ",\n  kRank = " << std::max(s.mass_rank, 1);
  out << "\n};\n" << kSinesAndCosines << (s.mass_structured ? kSemiseparable : kDense);
  for (const EmittedFunction& function : functions.functions) {
    out << "\n/* " << function.comment << " */\nstatic " << c_signature(function.signature)
        << " {\n  (void)context;\n";
    // What a function does not read it names all the same, so that compilers stay quiet.
    for (const std::string argument : {"t", "p", "dp", "in", "rate_weights", "dz"}) {
      for (const std::string type : {"const T* ", "const T& ", "T* "}) {
        for (const char* end : {",", ")"}) {
          if (function.signature.find("[[maybe_unused]] " + type + argument + end) !=
              std::string::npos)
            out << "  (void)" << argument << ";\n";
        }
      }
    }
    out << function.before << statements_text(function.body.statements, Language::kC, 1)
        << function.after << "}\n";
  }
  out << "\n"
      << table_arrays(description, functions) << "const catena_model* " << s.name << "(void) {\n"
      << "  static const catena_model model = {\n"
      << table_entries(description, functions, Language::kC) << "  };\n  return &model;\n}\n";
  return out.str();
}

std::string header_text(const ModelSummary& s) {
  std::ostringstream out;
  out << kBanner << "#ifndef CATENA_MODEL_" << s.name << "\n#define CATENA_MODEL_" << s.name
      << "\n\n#include \"catena_model.h\"\n\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n"
      << "/* The functions of a hanging chain of " << s.links << " link"
      << (s.links == 1 ? "" : "s") << "; see catena_model.h. */\nconst catena_model* " << s.name
      << "(void);\n\n#ifdef __cplusplus\n}\n#endif\n#endif\n";
  return out.str();
}

}  // namespace

EmittedModel emit_c_model(const Description& description, int links, Layout layout) {
  const ModelFunctions functions = model_functions(description, links, layout, Language::kC);
  const std::string name = functions.summary.name;
  return {functions.summary,
          {{name + ".c", source_text(description, functions)},
           {name + ".h", header_text(functions.summary)}}};
}

}  // namespace catena
