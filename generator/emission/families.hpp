// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the outputs of a function need of the definitions, as families: the definitions of one name, or
// the outputs to one part of an array, over the links.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "generator/derivation/definitions.hpp"
#include "generator/emission/function_body.hpp"

namespace catena {

/// Offset of a dependency where one of the two has no link.
inline constexpr int kUnrelated = 1'000'000;

/// A statement: a definition or an output.
struct Item {
  std::string family;
  int index;  ///< its link, or kNoIndex
  GiNaC::ex value;
  int number = -1;                 ///< of a definition
  const Output* output = nullptr;  ///< of an output
};

struct Dependency {
  std::string family;
  int offset;  ///< link of what is read, less that of the reader; or kUnrelated
  auto operator<=>(const Dependency&) const = default;
};

struct Family {
  std::string name;
  std::map<int, Item> items;          ///< by index
  std::set<Dependency> dependencies;  ///< on other definitions; inputs are left out
  bool is_output = false;
  bool along = false;  ///< depends on a differential
  // Set by guard_families():
  std::string adds_to;  ///< the family whose values this one adds to; empty: it has its own
  std::set<int> guard;  ///< switches of which one must be on; empty: always computed
  bool zero = false;    ///< read where it was not computed
  // Set by schedule():
  int sweep = -1;
  bool local = true;     ///< read only at the same link in the same sweep
  bool carried = false;  ///< or at the one before, and after the sweep at its last link
  /// An output of the same sweep with these values, from which later sweeps read them.
  const Output* kept = nullptr;
};

class Families {
 public:
  /// What `outputs` need, in the order of the derivation; outputs last. Throws std::logic_error if
  /// they need an input that `inputs` does not have. The arguments are kept by reference.
  Families(const Definitions& definitions, const std::vector<Output>& outputs,
           const Inputs& inputs);

  std::vector<Family> all;

  const Definitions& definitions() const { return definitions_; }
  size_t position(const std::string& family) const { return position_.at(family); }
  Family& named(const std::string& family) { return all[position(family)]; }
  const Family& named(const std::string& family) const { return all[position(family)]; }
  void add(Family family);

  /// What an input is brought in by; empty: an argument has its name.
  const std::optional<Input>& input(const std::string& family) const { return inputs_.at(family); }
  /// Inputs, and what a declaration brings in ready-made (sines and cosines).
  bool given(const Symbol& symbol) const { return inputs_.count(symbol.family) > 0; }
  /// Names of the inputs that are needed, in the order of the derivation.
  const std::set<std::pair<int, std::string>>& used_inputs() const { return used_inputs_; }

  /// Whether a value depends on a differential.
  bool along(const GiNaC::ex& value) const;
  /// Whether an input of the function is a differential.
  bool has_differentials() const;

  /// Finds the dependencies of a family anew.
  void depend(Family& family) const;

 private:
  const Definitions& definitions_;
  const Inputs& inputs_;
  std::map<std::string, size_t> position_;
  std::set<std::pair<int, std::string>> used_inputs_;
  std::set<int> along_;  // symbols that depend on a differential
};

}  // namespace catena
