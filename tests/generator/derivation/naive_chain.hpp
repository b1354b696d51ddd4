// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <set>
#include <string>
#include <vector>

namespace catena {

/// The chain and its effects derived the long way, by separate code: positions written out, one
/// flat Lagrangian, Euler-Lagrange entry by entry, forces by virtual work in Cartesian components.
/// Each effect is coded by hand from its description, not read from its file. Small n only.
class NaiveChain {
 public:
  NaiveChain(int links, std::set<std::string> effects);

  /// Whether the effect's physics is coded here.
  static bool knows(const std::string& effect);

  /// One symbol for each name: "theta[1]", "length[2]", "time", "load_drag_coefficient",
  /// "axial_stretch_strain_dot[3]" ...
  GiNaC::ex symbol(const std::string& name);
  GiNaC::ex symbol(const std::string& family, int i);
  const std::map<std::string, GiNaC::ex>& symbols() const { return symbols_; }

  /// The position, velocity and acceleration of the support (symbols "support_side", ..._dot,
  /// ..._ddot, and down) as the effects prescribe them.
  GiNaC::exmap support_motion();

  std::vector<GiNaC::ex> residual();
  std::vector<GiNaC::ex> state_rates();

  /// d/dt of T + V along any motion.
  GiNaC::ex stored_rate() { return rate(kinetic_ + potential_); }
  /// Power of all that is no energy: forces, friction; the support's not included.
  GiNaC::ex power();
  /// Power of the force that moves the support.
  GiNaC::ex support_power();

  std::vector<GiNaC::ex> side, down;  ///< support, ends of links, load

 private:
  using ex = GiNaC::ex;

  bool has(const std::string& effect) const { return effects_.contains(effect); }
  ex parameter(const std::string& effect, const std::string& name) {
    return symbol(effect + "_" + name);
  }
  ex rate(const ex& expression);  // total time derivative
  void add_force(const ex& side, const ex& down, const ex& force_side, const ex& force_down);
  void add_joint_moment(int joint, const ex& moment);
  std::vector<ex> rows();  // of the coordinates, the support's last
  void make_coordinates();
  void make_shape();
  void add_energies();
  void add_link_forces(int i);
  void add_joint_moments(int i);
  void add_load_forces();
  struct Fluid {
    ex side, across;  // velocity
  };
  Fluid fluid_at(const std::string& effect, const ex& s, const ex& d);
  struct Floor {
    ex sunk, touch;
  };
  Floor floor_at(const ex& s, const ex& d);
  static ex slip(const ex& speed);

  int n_;
  std::set<std::string> effects_;
  std::map<std::string, ex> symbols_;
  std::vector<ex> q_, v_, a_;
  std::vector<ex> middle_side_, middle_down_, centre_side_, centre_down_, rest_;
  ex tilt_ = 0;
  ex kinetic_ = 0, potential_ = 0;
  std::vector<ex> force_;  // generalised
};

}  // namespace catena
