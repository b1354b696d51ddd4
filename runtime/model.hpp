// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "generated/catena_model.h"

namespace catena {

/// An emitted model: the table of functions of generated/catena_model.h. Copies are cheap and share
/// a loaded library, which stays open as long as one of them lives.
///
///     const Model model = Model::built_in(12);
///     Eigen::VectorXd parameters = model.default_parameters();  // NaN where there is no default
///     parameters[model.parameter_index("load_mass")] = 1.381;   // kg
class Model {
 public:
  /// The plain chain of `links` links, linked into this program. Throws InputError that names the
  /// numbers that are built in.
  static Model built_in(int links);
  /// Whether built_in works for so many links.
  static bool has_built_in(int links);
  /// The numbers of links for which built_in works, ascending.
  static std::vector<int> built_in_links();

  /// A model compiled as a shared library that exports catena_model_table. Throws InputError that
  /// names the file and the fault: it is missing, lacks this entry, has another ABI or lacks
  /// functions.
  static Model load(const std::filesystem::path& shared_library);

  /// `table` must outlive this object and its copies. Throws InputError if it cannot be used.
  explicit Model(const catena_model* table);
  /// The same with a table that lives as long as this object and its copies.
  explicit Model(std::shared_ptr<const catena_model> table);

  /// The table it was made of.
  const catena_model& table() const { return *table_; }

  /// Lengths of the arrays of a point and of the energies; see catena_model.h.
  int links() const { return table_->links; }
  int coordinates() const { return table_->coordinates; }
  int states() const { return table_->states; }
  int parameters() const { return table_->parameters; }
  int signals() const { return table_->signals; }
  int energies() const { return table_->energies; }
  /// Whether it moves in space: q has three components for each link, and positions have three.
  bool in_space() const { return table_->positions_across != nullptr; }

  /// The functions of the table, with its context; shapes and units are those of catena_model.h, which also says
  /// which of them may be null.
  void residual(const catena_point& at, double* r) const {
    table_->residual(table_->context, &at, r);
  }
  void residual_tangent(const catena_point& at, const catena_point& along, double* dr) const {
    table_->residual_tangent(table_->context, &at, &along, dr);
  }
  void residual_tangents(const catena_point& at, const catena_point& along, double* dr) const {
    table_->residual_tangents(table_->context, &at, &along, dr);
  }
  void residual_adjoint(const catena_point& at, const double* weight, const double* rate_weight,
                        double* dq, double* dv, double* dz, double* dp) const {
    table_->residual_adjoint(table_->context, &at, weight, rate_weight, dq, dv, dz, dp);
  }
  void state_rate(const catena_point& at, double* zdot) const {
    table_->state_rate(table_->context, &at, zdot);
  }
  void state_rate_tangent(const catena_point& at, const catena_point& along, double* dzdot) const {
    table_->state_rate_tangent(table_->context, &at, &along, dzdot);
  }
  void state_rate_tangents(const catena_point& at, const catena_point& along, double* dzdot) const {
    table_->state_rate_tangents(table_->context, &at, &along, dzdot);
  }
  int acceleration(const catena_point& at, double* a) const {
    return table_->acceleration(table_->context, &at, a);
  }
  int accelerations(const catena_point& at, double* a) const {
    return table_->accelerations(table_->context, &at, a);
  }
  int newton_factor(const catena_point& at, double ca, double cv, double cq, double* work) const {
    return table_->newton_factor(table_->context, &at, ca, cv, cq, work);
  }
  void newton_solve(const double* work, double* x) const {
    table_->newton_solve(table_->context, work, x);
  }
  void newton_solves(const double* work, double* x) const {
    table_->newton_solves(table_->context, work, x);
  }
  void newton_solve_transposed(const double* work, double* x) const {
    table_->newton_solve_transposed(table_->context, work, x);
  }
  void energy(const catena_point& at, double* e) const { table_->energy(table_->context, &at, e); }
  void positions(const catena_point& at, double* side, double* down) const {
    table_->positions(table_->context, &at, side, down);
  }
  void positions_tangent(const catena_point& at, const catena_point& along, double* dside,
                         double* ddown) const {
    table_->positions_tangent(table_->context, &at, &along, dside, ddown);
  }
  void velocities(const catena_point& at, double* side_rate, double* down_rate) const {
    table_->velocities(table_->context, &at, side_rate, down_rate);
  }
  void positions_across(const catena_point& at, double* across) const {
    table_->positions_across(table_->context, &at, across);
  }
  void positions_across_tangent(const catena_point& at, const catena_point& along,
                                double* dacross) const {
    table_->positions_across_tangent(table_->context, &at, &along, dacross);
  }
  void internal_forces(const catena_point& at, double* moment, double* tension,
                       double* curvature) const {
    table_->internal_forces(table_->context, &at, moment, tension, curvature);
  }
  void reactions(const catena_point& at, double* force, double* moment) const {
    table_->reactions(table_->context, &at, force, moment);
  }
  /// Whether constraints hold the far end or joints; else the next two are not there.
  bool held() const { return table_->gap != nullptr; }
  /// The links whose far ends constraints hold, from 1, in the order of `gap` and of the last coordinates, whose
  /// names tell: hold_6_side is of link 6, hold_side of the last.
  const std::vector<int>& held_links() const { return held_links_; }
  /// Of the last coordinates, how many belong to these constraints: three for each.
  int constraints() const { return 3 * static_cast<int>(held_links_.size()); }
  void gap(const catena_point& at, double* apart, double* rate) const {
    table_->gap(table_->context, &at, apart, rate);
  }
  /// Values that change their sign at events.
  int events() const { return table_->events; }
  void event_values(const catena_point& at, double* value) const {
    table_->event_values(table_->context, &at, value);
  }
  void velocities_across(const catena_point& at, double* across_rate) const {
    table_->velocities_across(table_->context, &at, across_rate);
  }
  void observe(double t, const double* p, const double in[3], double out[3]) const {
    table_->observe(table_->context, t, p, in, out);
  }
  void observe_tangent(double t, const double* p, const double* dp, const double in[3],
                       const double din[3], double dout[3]) const {
    table_->observe_tangent(table_->context, t, p, dp, in, din, dout);
  }
  double clock(double t, const double* p) const { return table_->clock(table_->context, t, p); }
  double clock_tangent(double t, const double* p, const double* dp) const {
    return table_->clock_tangent(table_->context, t, p, dp);
  }

  /// Index of a parameter in the vector p, from 0. Throws InputError that names the nearest known
  /// name.
  int parameter_index(std::string_view name) const;

  /// One value per parameter, in the order of the table: its default, or NaN if it has none.
  Eigen::VectorXd default_parameters() const;

  /// Throws ImpossibleValue naming the parameter, its value and the rule it breaks: finite, at most
  /// 1e50 in size, within the bounds of the parameter table; std::invalid_argument for another number of values.
  void check_parameters(const Eigen::VectorXd& parameters) const;

 private:
  Model(const catena_model* table, std::shared_ptr<const void> owner);

  const catena_model* table_;
  std::vector<int> held_links_;
  std::shared_ptr<const void> owner_;  // a loaded library, or the table itself
};

}  // namespace catena
