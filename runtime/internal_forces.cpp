// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/internal_forces.hpp"

#include <stdexcept>
#include <string>

#include "common/number_text.hpp"
#include "runtime/dynamics.hpp"

namespace catena {

InternalForces internal_forces(const Model& model, const Eigen::VectorXd& parameters,
                               const Trajectory& trajectory, const Signals& signals) {
  Dynamics dynamics(model, parameters, signals);
  const Eigen::Index times = trajectory.q.cols();
  const Eigen::MatrixXd empty(model.links(), times);
  const Eigen::Index axes = model.in_space() ? 3 : 2, moments = model.in_space() ? 3 : 1;
  const Eigen::Index held = static_cast<Eigen::Index>(model.held_links().size());
  InternalForces result{empty, empty, empty, {}, {}};
  Eigen::MatrixXd force(axes * (1 + held), times), moment(moments * (1 + held), times);
  Eigen::VectorXd a(model.coordinates());
  for (Eigen::Index k = 0; k < times; ++k) {
    const double t = trajectory.time[static_cast<std::size_t>(k)];
    const catena_point at =
        dynamics.at(t, trajectory.q.col(k).data(), trajectory.v.col(k).data(), a.data(),
                    model.states() > 0 ? trajectory.z.col(k).data() : dynamics.zero());
    if (const int pivot = model.acceleration(at, a.data()))
      throw std::runtime_error("internal forces: the mass matrix is not positive definite at " +
                               std::string(model.table().coordinate[pivot - 1].name) +
                               " at t = " + number_text(t) + " s");
    model.internal_forces(at, result.moment.col(k).data(), result.tension.col(k).data(),
                          result.curvature.col(k).data());
    if (model.table().reactions) model.reactions(at, force.col(k).data(), moment.col(k).data());
  }
  if (!model.table().reactions) return result;
  result.support = {force.topRows(axes), moment.topRows(moments)};
  for (Eigen::Index place = 1; place <= held; ++place)
    result.held.push_back(
        {model.held_links()[static_cast<std::size_t>(place - 1)],
         {force.middleRows(axes * place, axes), moment.middleRows(moments * place, moments)}});
  return result;
}

}  // namespace catena
