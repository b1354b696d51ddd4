// SPDX-License-Identifier: GPL-3.0-or-later
//
// The functions of one emitted model as data: what each takes and gives, the statements that compute
// it, and the forms of the matrices.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "generator/derivation/chain.hpp"
#include "generator/emission/model_writer.hpp"
#include "generator/emission/program.hpp"

namespace catena {

enum class ParameterKind {
  kPoint,    ///< t, q, v, a, z, u, p
  kNumber,   ///< read
  kNumbers,  ///< an array that is read
  kResults,  ///< an array that is written
  kTerm,     ///< the number of a term
  kMatrix    ///< the Newton matrix to be filled
};

struct Parameter {
  ParameterKind kind;
  std::string name;
  Type type = Type::kScalar;
  bool maybe_unused = false;  ///< the statements of some models do not read or write it
  bool operator==(const Parameter&) const = default;
};

/// What a function does beside its statements.
enum class Frame {
  kStatements,        ///< nothing
  kValue,             ///< returns the variable `out` that they assign
  kChooseTerm,        ///< calls the function of one term
  kMassMatrix,        ///< writes the matrix that they fill row by row
  kAcceleration,      ///< solves with the matrix that they fill
  kMassColumns,       ///< the mass matrix without structure, from M a for unit accelerations
  kDenseAcceleration  ///< solves with that
};

struct Function {
  std::string name;
  std::string comment;  ///< the first line of its documentation
  std::vector<Parameter> parameters;
  Statements statements;
  Frame frame = Frame::kStatements;
  bool in_table = true;
};

/// Whether there is a type D of differentials beside T.
bool has_differentials(const Function& function);

/// How a matrix is kept and factored (generator/emission/support).
struct MatrixForm {
  enum Kind { kDense, kSymmetricSemiseparable, kQuasiseparable } kind = kDense;
  int upper_rank = 0, lower_rank = 0;  ///< of the semiseparable parts
  int block = 1;                       ///< rows of the blocks that are its entries; 2: by tangents
  int border = 0;                      ///< rows and columns beyond them, of no link
  bool isotropic = false;              ///< by tangents: one number for each block
  bool operator==(const MatrixForm&) const = default;
};

/// Whether its arrays are those of blocks, be they of one entry.
inline bool is_in_blocks(const MatrixForm& form) { return form.block > 1 || form.border > 0; }

/// The function of double precision behind a member of the table.
struct TableEntry {
  std::string name;  ///< of the member
  bool given;        ///< else the member is null
  bool operator==(const TableEntry&) const = default;
};

struct ModelFunctions {
  ModelSummary summary;
  std::vector<Function> functions;
  std::vector<std::string> terms;
  std::vector<EnergyItem> energies;
  MatrixForm mass, newton;  ///< newton.kind == kDense: there is no Newton matrix
  /// The function for a T of several numbers: "acceleration", or one in an order of its own.
  std::string accelerations;
  bool observes = false;
  Space space = Space::kPlane;
  FunctionSet set = FunctionSet::kAll;

  /// Whether the table has accelerations of a batch of points: not where their arrays would not fit
  /// a thread's stack.
  bool has_batch() const {
    return set == FunctionSet::kAll && summary.links <= most_links_of_batch();
  }
  /// Up to how many links they would fit.
  int most_links_of_batch() const;
  /// Members of the table from `residual` on, in its order.
  std::vector<TableEntry> table_entries() const;
};

/// Derives the model. `links`: at least 1.
/// Throws InputError for an effect that the chain cannot have.
ModelFunctions model_functions(const Description& description, int links, Layout layout,
                               FunctionSet set = FunctionSet::kAll);

}  // namespace catena
