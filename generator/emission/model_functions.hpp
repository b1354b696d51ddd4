// SPDX-License-Identifier: GPL-3.0-or-later
//
// The functions of one emitted model: which outputs each has, and the statements that compute them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "generator/derivation/chain.hpp"
#include "generator/emission/function_body.hpp"
#include "generator/emission/model_writer.hpp"
#include "generator/emission/statement_text.hpp"

namespace catena {

/// A function behind the table (catena_model.h), in double precision.
struct TableFunction {
  std::string result;     ///< "void"
  std::string name;       ///< in the table: "residual_tangents"
  std::string arguments;  ///< after the context: "const catena_point* at, double* r"
  std::string call;       ///< what it does: "residual(point(at), r)"
};

struct EmittedFunction {
  std::string name;
  std::string comment;    ///< first line of its documentation
  std::string signature;  ///< "void residual(const Point<T>& at, T* r)"
  std::string before;     ///< statements around the body
  FunctionBody body;
  std::string after;
  std::vector<TableFunction> entries;  ///< of the table, that call it
};

struct ModelFunctions {
  ModelSummary summary;
  std::vector<EmittedFunction> functions;
  std::vector<std::string> terms;
  std::vector<EnergyItem> energies;
  std::string mass_type, newton_type;  ///< C++ types over T; empty: no structure
  std::string accelerations;           ///< the function for a T of several numbers; empty: none
  bool uses_time = false, observes = false;

  /// Whether the table has accelerations of a batch of points: not where their arrays would not fit
  /// a thread's stack.
  bool has_batch() const { return summary.links <= most_links_of_batch(); }
  /// Up to how many links they would fit; 0: not made for that.
  int most_links_of_batch() const;
  /// Entries of the table from `residual` on, in its order; "nullptr" where a model has none.
  std::vector<std::string> table_entries(Language language) const;
};

/// In C there is no Newton matrix: `newton_type` stays empty and the table says not structured.
ModelFunctions model_functions(const Description& description, int links, Layout layout,
                               Language language);

}  // namespace catena
