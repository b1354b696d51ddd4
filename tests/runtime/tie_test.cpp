// SPDX-License-Identifier: BSD-3-Clause
//
// Motions of a cable with a tie between two of its places.
#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "runtime/internal_forces.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/simulation.hpp"
#include "tests/runtime/check_derivatives.hpp"
#include "tests/runtime/space_cable.hpp"
#include "tests/runtime/vertical_plane.hpp"
#include "tests/support/near.hpp"

namespace {

using catena::Model;
using catena::State;
using Eigen::Index;
using Eigen::VectorXd;
using testing::askew;
using testing::check_motion_in_plane;
using testing::planar_start;
using testing::run;
using testing::set;

/// From the middle of link 1 (of 5, 0.24 m each) to 0.06 m above the end of link 4.
VectorXd tied(const Model& model) {
  VectorXd p = testing::cable(model, 0.05, 1e-3);
  const std::pair<const char*, double> values[] = {{"spring", 20},        {"dashpot", 0.5},
                                                   {"pull", 1.5},         {"rest_length", 0.4},
                                                   {"upper_place", 0.12}, {"lower_place", 0.9}};
  for (const auto& [name, value] : values)
    set(model, p, (std::string("tie.") + name).c_str(), value);
  return p;
}

TEST_CASE("energies of a tied cable balance to 1e-9 of their size") {
  const Model model = Model::load(TIED_5);
  const auto motion = run(model, tied(model), askew(model), {0, 1, 2, 3});
  const double size = motion.trajectory.energy.col(0).cwiseAbs().sum();
  CHECK(size > 1.0);
  CHECK(motion.energy_imbalance < 1e-9 * size);
}

TEST_CASE("in any vertical plane a tied cable moves as in the plane") {
  const Model space = Model::load(TIED_5), plane = Model::load(TIED_PLANE_5);
  check_motion_in_plane(plane, tied(plane), space, tied(space), planar_start(plane, space));
}

TEST_CASE("derivatives of a tied cable agree with differences, those by its places, too") {
  for (const char* path : {TIED_5, TIED_PLANE_5}) {
    CAPTURE(path);
    const Model model = Model::load(path);
    const State initial = model.coordinates() == 5
                              ? from_angles(model, VectorXd::LinSpaced(5, 0.2, 1.2))
                              : askew(model);
    for (const char* name : {"tie.spring", "tie.upper_place", "tie.lower_place"}) {
      CAPTURE(name);
      testing::check_derivatives(model, tied(model), initial, {}, {name, 2e-5, 4});
    }
  }
}

TEST_CASE("a taut cable bears what hangs below less the pull of its tie") {
  const Model model = Model::load(TIED_PLANE_5);
  VectorXd p = tied(model);
  set(model, p, "tie.spring", 0);
  const State still = State::zero(model);
  const auto forces = internal_forces(model, p, {{0.0}, still.q, still.v, still.z, {}});
  // Link 1 is half of it within the tie, link 4 three quarters.
  const double within[] = {0.5, 1, 1, 0.75, 0};
  for (Index i = 0; i < 5; ++i) {
    const double weight = (0.3 + 0.15 * 0.24 * static_cast<double>(5 - i)) * testing::kGravity;
    CHECK(forces.tension(i, 0) == catena::near(weight - 1.5 * within[i], 1e-5));
  }
  CHECK(forces.support.force(1, 0) == catena::near(-(0.3 + 0.15 * 1.2) * testing::kGravity, 1e-12));
}

}  // namespace
