// SPDX-License-Identifier: GPL-3.0-or-later
//
// The functions of a model as data: expressions, statements, loops, arrays. They are built once from
// a derivation (function_body.hpp) and printed for each language (statement_text.hpp). Whatever
// depends on the number of links n is affine in n, so that one program may stand for every n
// (any_links_table.hpp).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace catena {

/// An integer that is affine in the number of links n: constant + slope * n.
struct Affine {
  long constant = 0, slope = 0;

  Affine() = default;
  Affine(long constant, long slope = 0) : constant(constant), slope(slope) {}
  long at(long links) const { return constant + slope * links; }
  bool operator==(const Affine&) const = default;
  Affine& operator+=(const Affine& other);
};

/// A place in an array: `base + at`, in a loop over links i `base + i + at`.
struct ArrayPlace {
  Affine base;           ///< where the part of the array begins
  bool of_link = false;  ///< relative to the loop's i
  Affine at;
  bool operator==(const ArrayPlace&) const = default;
};

/// An array of a function's own or of its arguments.
struct Array {
  std::string owner;  ///< the structure that has it: "at", "along" (points), "matrix"; or empty
  std::string name;
  std::optional<int> row;  ///< of the arrays of a matrix
  bool operator==(const Array&) const = default;
};

// ---- expressions ----------------------------------------------------------------------------

/// A rational number.
struct Number {
  double numerator = 0, denominator = 1;
  bool operator==(const Number&) const = default;
};

/// A variable, or an entry of an array.
struct Read {
  std::string name;
  std::optional<ArrayPlace> place;
  bool is_argument = false;  ///< an array among the inputs (InputKind::kArray): entries from 1 on
  bool operator==(const Read&) const = default;
};

/// A function of one variable: sin, sqrt ...
struct Call {
  std::string function;
  Read argument;
  bool operator==(const Call&) const = default;
};

struct Product;
/// A sum of products; empty: zero.
using Sum = std::vector<Product>;

struct Factor {
  std::variant<Number, Read, Call, Sum> value;
  bool operator==(const Factor& other) const;
};

/// [-] above * above ... / (below * below ...); at least one factor above.
struct Product {
  bool negative = false;
  std::vector<Factor> above, below;
  bool operator==(const Product&) const = default;
};

// ---- statements -----------------------------------------------------------------------------

/// kDifferential: of type D, which in C is double as everything else.
enum class Type { kScalar, kDifferential };

enum class InputKind {
  kArray,            ///< the array from `place` on, counted from 1
  kEntry,            ///< the entry at `place`
  kNumber,           ///< `array` names an argument that is a number
  kSinesAndCosines,  ///< arrays sine and cosine of the first `place` entries, counted from 1
  kPi,
  kZero
};

/// Gives an argument, or a part of one, the name that the derivation knows it by.
struct Input {
  InputKind kind = InputKind::kNumber;
  Type type = Type::kScalar;
  std::string name;
  Array array;
  Affine place;
  bool operator==(const Input&) const = default;
};

/// A variable without a value yet, or an array.
struct Variable {
  Type type = Type::kScalar;
  std::string name;
  std::optional<Affine> entries;  ///< of an array
  bool zero = false;              ///< zero from the start
  bool operator==(const Variable&) const = default;
};

/// A name for a value.
struct NamedValue {
  Type type = Type::kScalar;
  std::string name;
  Sum value;
  bool operator==(const NamedValue&) const = default;
};

struct Assignment {
  Array array;
  std::optional<ArrayPlace> place;
  Sum value;
  bool as_differential = false;  ///< the value is of type T, the array of type D
  bool adds = false;             ///< to what is there
  bool operator==(const Assignment&) const = default;
};

struct Loop;
/// Statements with names of their own, left out where all numbers of `unless_zero` are zero.
struct Block;

using Statement = std::variant<Input, Variable, NamedValue, Assignment, Loop, Block>;
using Statements = std::vector<Statement>;

struct Block {
  Statements body;
  std::vector<std::string> unless_zero = {};  ///< names of variables; empty: never left out
  bool operator==(const Block&) const;
};

/// For i = first, first + step, ..., last.
struct Loop {
  Affine first, last;
  int step = 1;  ///< or -1
  Statements body;
  bool operator==(const Loop&) const;
};

// ---- what can be asked of statements --------------------------------------------------------

struct OperationCount {
  Affine additions, multiplications, divisions, functions;
  bool operator==(const OperationCount&) const = default;
};

/// Arithmetic operations of all steps of all loops.
/// Throws std::logic_error where their number is not affine in the number of links.
OperationCount operations_of(const Statements& statements);

/// Calls `visit` for every integer that may depend on the number of links, in the order in which
/// they stand: bounds, sizes, places.
void for_each_affine(Statements& statements, const std::function<void(Affine&)>& visit);

/// The statements for `links` links: no slopes are left.
Statements at_links(Statements statements, long links);

/// The statements of step i of a loop: no place is relative to i.
Statements at_step(Statements statements, long i);

/// What is computed, in which order: loops and blocks are resolved into their statements.
/// The statements are for one number of links.
Statements written_out(const Statements& statements);

}  // namespace catena
