// SPDX-License-Identifier: GPL-3.0-or-later
//
// The change of a chain under a perturbation of its links, as linear forms (structure.hpp has the equations).
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "generator/derivation/chain.hpp"

namespace catena {

/// Weights of accelerations, velocities and coordinates in N.
struct Weights {
  GiNaC::ex acceleration, velocity, position;
};

/// The definitions do not carry changes along the chain as sums do; what() names one.
struct NotOfThisForm : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A linear form over perturbations u_i, over definitions that carry perturbations along the chain, and over the
/// forces along chords, which change with all links between their places.
struct Basis {
  enum Kind { kPerturbation, kCarriedDown, kCarriedUp, kChordForce } kind;
  std::string family;  ///< empty for u
  int index;
  int component = 0;  ///< of u
  // clang-tidy 14 takes the zero in what this stands for for a null pointer.
  auto operator<=>(const Basis&) const = default;  // NOLINT(modernize-use-nullptr)
};
using Form = std::map<Basis, GiNaC::ex>;

/// Zero where the form has none.
GiNaC::ex entry(const Form& form, const Basis& basis);

/// What moves: the coordinates of the links, by equations that are the residual; or, in space, the second
/// derivatives of the unit vectors along the links alone, by equations that are their generalised forces.
enum class Moving { kCoordinates, kDirections };

/// How a chain changes in an implicit step. Throws NotOfThisForm.
class Linearisation {
 public:
  Linearisation(Chain& chain, const Weights& weights, Moving moving = Moving::kCoordinates);
  /// The equations of component a of link i, at a * links + i - 1; those of no link last.
  const std::vector<GiNaC::ex>& equations() const { return equations_; }
  /// The change of an expression, in terms that are allowed at link i.
  Form at_link(const GiNaC::ex& expression, int i);
  /// The change of what belongs to no link, in u and in what is carried down to any link. Not that of chord forces.
  Form of_no_link(const GiNaC::ex& expression);
  /// The changes of the forces along chords that change, in the same.
  std::map<Basis, Form> chord_forces();
  /// The change of a sum over links, in u of all of them.
  Form along_links(const GiNaC::ex& expression);
  /// Of u at one link.
  int components() const;
  /// Families of definitions that are carried from link to link, towards the far end and towards the support.
  const std::set<std::string>& down() const { return down_; }
  const std::set<std::string>& up() const { return up_; }
  /// A name of an expression of several components; one for all that are the same written out, as far as
  /// they are short. Entries of symmetric blocks have one name so.
  GiNaC::ex one_name(const std::string& family, int index, const GiNaC::ex& value);
  /// The change of a carried definition at link i, if it is there.
  Form carried(const std::string& family, int i);

 private:
  std::set<int> reached_from(const std::vector<GiNaC::ex>& expressions);
  const std::map<Basis, int>& numbers();
  Form at_link_of_form(Form form, int i);
  Form definition_of(const Basis& basis);
  Form change_of(const GiNaC::ex& expression);
  Form change_of_symbol(int number);
  GiNaC::ex slope(int number, const Basis& basis, const GiNaC::ex& coefficient);
  std::string slope_family(const Symbol& symbol, const Basis& basis) const;
  Form change_of_state(int number);
  Form change_of_roll(int link);
  Form change_of_axis(int number, int link, Axis component);

  const Chain& chain_;
  Definitions& definitions_;
  Weights weights_;
  int links_;
  struct Moved {
    int component;
    GiNaC::ex weight;
  };
  std::vector<GiNaC::ex> equations_;
  std::map<std::string, Moved> moved_;  // families of q, v and a
  /// Components of carried axes.
  struct OfAxis {
    int link;
    Axis component;
  };
  std::map<int, OfAxis> of_axis_;
  std::map<int, GiNaC::ex> state_rates_;  // of extra states, by the state's number
  std::set<int> chord_forces_;            // numbers
  std::set<int> reached_;                 // definitions that the equations need
  std::set<std::string> down_, up_;
  std::map<Basis, int> numbers_;
  std::map<int, Form> known_;
  std::map<int, GiNaC::ex> short_forms_;    // of names
  std::map<std::string, GiNaC::ex> names_;  // by their short forms
};

}  // namespace catena
