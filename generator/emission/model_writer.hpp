// SPDX-License-Identifier: GPL-3.0-or-later
//
// Writes the C++ of one model: everything its table of functions (catena_model.h) needs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "description/description.hpp"
#include "generator/emission/function_body.hpp"

namespace catena {

struct FunctionSummary {
  std::string name;
  OperationCount operations;
};

/// What was derived and found, for people and for the certificate.
struct ModelSummary {
  std::string name;  ///< "chain_12"
  int links = 0, coordinates = 0, states = 0, signals = 0, parameters = 0, events = 0;
  bool structured = false;       ///< Newton matrix: tridiagonal plus semiseparable
  bool mass_structured = false;  ///< mass matrix: semiseparable
  bool mass_symmetric = false;   ///< proved from its rows and columns
  int mass_rank = 0, newton_upper_rank = 0, newton_lower_rank = 0;
  int block = 1;        ///< both are of blocks of so many rows
  int constraints = 0;  ///< of a held end
  int border = 0;       ///< rows and columns of no link, of the load or of constraints, beyond both
  bool stiffness_tridiagonal = false, damping_tridiagonal = false;
  std::string why_not;  ///< what stands in the way of a structure
  Layout layout = Layout::kLoops;
  std::vector<FunctionSummary> functions;
};

enum class FunctionSet {
  kAll,
  /// What a fit calls; the rest of the table is null. An effect at its neutral values costs next to
  /// nothing: what it computes is left out.
  kFits
};

struct EmittedModel {
  ModelSummary summary;
  std::map<std::string, std::string> files;  ///< name -> text: <name>.hpp, <name>.cpp
};

/// The model of one number of links as C++. Throws InputError for effects that exclude one another or the space.
EmittedModel emit_model(const Description& description, int links, Layout layout,
                        FunctionSet set = FunctionSet::kAll);

/// "chain_12"
std::string model_name(const Description& description, int links);

}  // namespace catena
