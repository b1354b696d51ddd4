// SPDX-License-Identifier: GPL-3.0-or-later
//
// From definitions to the statements of a function: what the outputs do not need is left out,
// definitions are put in sweeps over the links (towards the tip, or towards the support), and links
// whose statements are the same become one loop.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "generator/derivation/definitions.hpp"
#include "generator/emission/program.hpp"

namespace catena {

/// One assignment to the outside.
struct Output {
  Array array;
  int index;                        ///< the link it belongs to, or kNoIndex
  std::optional<ArrayPlace> place;  ///< relative to that link; empty: `array` names a variable
  GiNaC::ex value;
};

/// What brings the inputs into the function, by family; empty: an argument has the family's name.
using Inputs = std::map<std::string, std::optional<Input>>;

enum class Layout {
  kStraight,    ///< one statement a definition
  kLoops,       ///< loops over links where they are the same, cut so that compilers make vectors of
                ///< links
  kWholeSweeps  ///< such loops uncut: less is stored between them, for scalars that are vectors
};

/// What need not be computed while some numbers are zero: an effect at its neutral values.
struct Switch {
  std::set<std::string> families;  ///< inputs without an index
};

/// The statements that compute `outputs`, inputs first. Definitions that matter only where a switch
/// is on (one of its inputs, or their differentials, is not zero) are computed only there; not in
/// Layout::kStraight.
/// Throws std::logic_error if the outputs need an input that `inputs` does not have.
Statements function_body(const Definitions& definitions, const std::vector<Output>& outputs,
                         const Inputs& inputs, Layout layout,
                         const std::vector<Switch>& switches = {});

}  // namespace catena
