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
  const Eigen::Index ends = model.held() ? 2 : 1;
  InternalForces result{empty, empty, empty, {}, {}};
  Eigen::MatrixXd force(axes * ends, times), moment(moments * ends, times);
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
  if (model.held()) result.end = {force.bottomRows(axes), moment.bottomRows(moments)};
  return result;
}

}  // namespace catena
