// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace catena::checking {

/// A place in the text of a derivation; both count from 1.
struct Location {
  int line = 1;
  int column = 1;
};

/// One node of an expression as written, before anything is evaluated.
struct Expression {
  enum class Kind {
    kNumber,       ///< text: the digits as written
    kName,         ///< text: the name with its underscores; children: subscripts in brackets
    kCall,         ///< text: the function; children: its arguments
    kNegate,       ///< children: operand
    kNot,          ///< children: operand
    kTerms,        ///< text: + or - for each child; children: terms
    kFactors,      ///< text: * or / for each child; children: factors and divisors
    kBinary,       ///< text: ^ < <= > >= == != and or; children: left, right
    kSum,          ///< text: the index; children: from, to, body and, if there is one, condition
    kConditional,  ///< children: condition, value if it holds, value if not
    kMatrix,       ///< children: rows
    kRow           ///< children: entries of one row of a matrix
  };
  Kind kind = Kind::kNumber;
  Location at;
  std::string text;
  std::vector<Expression> children;
};

/// One statement of a derivation as written.
struct Statement {
  enum class Kind {
    kLinks,      ///< expressions: the number of links; names: "space", or nothing for the plane
    kSymbols,    ///< names: free symbols of a scalar derivation
    kPositive,   ///< names: symbols that stand for positive numbers
    kSymmetric,  ///< names: matrices whose unwritten entries are mirrored
    kGiven,      ///< expressions: a parameter, its value; holds on both sides of every comparison
    kAssign,     ///< expressions: target, value
    kEquation,   ///< expressions: number of the equation of motion, left side, right side
    kIdentity,   ///< names: label; expressions: left side, right side
    kFor,        ///< names: index; expressions: from, to and, if any, condition; block: body
    kIf          ///< expressions: condition; block: if it holds; otherwise: if not
  };
  Kind kind = Kind::kAssign;
  Location at;
  std::vector<std::string> names;
  std::vector<Expression> expressions;
  std::vector<Statement> block;
  std::vector<Statement> otherwise;
};

using Program = std::vector<Statement>;

}  // namespace catena::checking
