// SPDX-License-Identifier: GPL-3.0-or-later
//
// From definitions to the statements of a C++ (or C99) function: what the outputs do not need is
// left out, definitions are put in sweeps over the links (towards the tip, or towards the support),
// and links whose statements read the same become one loop.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "generator/derivation/definitions.hpp"
#include "generator/emission/polynomial_text.hpp"

namespace catena {

/// One assignment to the outside: before + (index + shift) + after = value.
/// index kNoIndex: before + after = value.
struct Output {
  std::string before;
  int index;
  int shift;
  std::string after;
  GiNaC::ex value;
};

/// How an input is reached: a declaration that brings its name into the function
/// ("const FromOne<T> theta(at.q);").
struct InputDeclaration {
  std::string text;
  bool along = false;  ///< a differential of type D; what depends on it is of that type too
};
using InputDeclarations = std::map<std::string, InputDeclaration>;  ///< by family

enum class Layout {
  kStraight,  ///< one statement a definition
  kLoops,     ///< loops over links where they read the same, cut so that compilers make vectors of
              ///< links
  kWholeSweeps  ///< such loops uncut: less is stored between them, for scalars that are vectors
};

struct FunctionBody {
  std::string text;  ///< statements, one a line, indented by two
  OperationCount operations;
  int statements = 0;
  bool along = false;  ///< has inputs of type D beside those of type T
};

FunctionBody function_body(const Definitions& definitions, const std::vector<Output>& outputs,
                           const InputDeclarations& inputs, Layout layout,
                           Language language = Language::kCpp);

/// The same statements, lines broken before an operator where they are longer than a page is wide.
std::string page_text(const std::string& statements);

}  // namespace catena
