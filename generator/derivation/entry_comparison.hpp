// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>

#include "generator/derivation/closed_form_proof.hpp"

namespace catena {

/// Compares two arrays entry by entry and keeps the first difference.
class EntryComparison {
 public:
  explicit EntryComparison(const std::string& what);

  /// `difference`: the model's entry minus what it is compared with. It is expanded here, and squares
  /// of sines are replaced where something is left. The entries are equal if nothing is left then.
  void entry(const std::string& place, const GiNaC::ex& difference);

  const Proof& proof() const { return proof_; }

 private:
  Proof proof_;
};

}  // namespace catena
