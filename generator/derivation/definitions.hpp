// SPDX-License-Identifier: GPL-3.0-or-later
//
// Single-assignment definitions, the form of a derivation.
//
// The equations of many links are long when they are written out and short when shared terms have
// names. Each definition is a named expression of inputs and earlier definitions. GiNaC
// differentiates, expands and compares their right-hand sides, which have a few terms for any
// number of links.
//
// GiNaC orders its terms by hashes of addresses, so nothing here may depend on that order. Families
// and symbols are numbered in the order of their creation, and every traversal that creates symbols
// follows those numbers.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace catena {

/// Index of a definition that belongs to no link.
inline constexpr int kNoIndex = -1;

struct Symbol {
  std::string family;  ///< "joint_side_velocity"
  int index;           ///< link it belongs to, or kNoIndex
  int family_rank;     ///< order of the family's first appearance
  bool is_input;       ///< has no right-hand side
  GiNaC::ex symbol;
  GiNaC::ex value;  ///< polynomial in symbols (negative powers of symbols allowed), or one function
                    ///< of a symbol
};

class Definitions {
 public:
  /// The symbol of an input. The first call makes it.
  GiNaC::ex input(const std::string& family, int index = kNoIndex);

  /// Names an expression and returns the name. Functions, roots and quotients of sums inside it get
  /// definitions of their own ("<family>_<what>"), so that the value is a polynomial in symbols. A
  /// value that is a number or a symbol is returned unchanged; for a value that has a name already,
  /// that name is returned.
  GiNaC::ex define(const std::string& family, int index, const GiNaC::ex& value);

  /// The same, but the value always gets a name of its own.
  GiNaC::ex define_always(const std::string& family, int index, const GiNaC::ex& value);

  /// The expression with functions, roots and quotients named, expanded; family and index name
  /// them.
  GiNaC::ex named(const GiNaC::ex& expression, const std::string& family, int index);

  /// Numbers of the symbols in an expression, ascending (order of creation).
  std::vector<int> symbols_of(const GiNaC::ex& expression) const;

  /// The number of a symbol that was made here, from 0. Throws std::logic_error for others.
  int number_of(const GiNaC::ex& symbol) const;
  const Symbol& operator[](int number) const { return symbols_[static_cast<size_t>(number)]; }
  int size() const { return static_cast<int>(symbols_.size()); }

  /// Text that is the same for equal expanded polynomials on every run.
  std::string canonical_key(const GiNaC::ex& expression) const;

 private:
  GiNaC::ex make(const std::string& family, int index, bool is_input, const GiNaC::ex& value);
  GiNaC::ex name_of(const std::string& family, int index, const GiNaC::ex& value);
  GiNaC::ex symbol_of(const std::string& family, int index, const GiNaC::ex& value);
  std::string unused_family(const std::string& wish, int index) const;

  std::vector<Symbol> symbols_;
  std::unordered_map<std::string, int> number_by_name_;
  std::unordered_map<std::string, int> family_rank_;
  std::unordered_map<std::string, GiNaC::ex> by_value_;
};

/// Derivatives of expressions, given the differential of each input. Differentials of definitions
/// become definitions too, so that a derivative costs a small multiple of the expression.
class Differential {
 public:
  /// family_name maps a family to the name of its differential's family.
  Differential(Definitions& definitions, std::string (*family_name)(const std::string&));
  /// Sets the differential of a symbol; inputs without one have differential zero.
  void set(const GiNaC::ex& symbol, const GiNaC::ex& differential);
  /// The differential of an expression, and of the symbol of this number.
  GiNaC::ex of(const GiNaC::ex& expression);
  GiNaC::ex of_symbol(int number);

 private:
  Definitions& definitions_;
  std::string (*family_name_)(const std::string&);
  std::map<int, GiNaC::ex> known_;
};

/// Replaces symbols in expressions. Definitions that contain them get new definitions
/// ("<family><suffix>").
class Substitution {
 public:
  /// `definitions` must outlive it.
  Substitution(Definitions& definitions, std::string suffix);
  /// Replaces this symbol from now on.
  void set(const GiNaC::ex& symbol, const GiNaC::ex& replacement);
  GiNaC::ex of(const GiNaC::ex& expression);

 private:
  GiNaC::ex of_symbol(int number);

  Definitions& definitions_;
  std::string suffix_;
  std::map<int, GiNaC::ex> known_;
};

}  // namespace catena
