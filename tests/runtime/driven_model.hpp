// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "generated/catena_model.h"
#include "tests/runtime/reference_model.hpp"

namespace catena::testing {

/// Two links with one extra state and one signal, made by hand from the reference model: a Maxwell
/// element (spring kMaxwellStiffness in series with a dashpot, relaxation time kRelaxationTime)
/// holds theta_1 back with the torque z, and the signal is a torque (N m) that drives theta_2:
///     r_1 += z,  r_2 -= u,  zdot = kMaxwellStiffness v_1 - z / kRelaxationTime
struct DrivenModel {
  static constexpr double kMaxwellStiffness = 3.0;  // N m/rad
  static constexpr double kRelaxationTime = 0.2;    // s

  static const catena_model* table() {
    static const catena_model model = make();
    return &model;
  }

 private:
  static void residual(const void*, const catena_point* at, double* r) {
    base()->residual(base()->context, at, r);
    r[0] += at->z[0];
    r[1] -= at->u[0];
  }
  static void residual_tangent(const void*, const catena_point* at, const catena_point* along,
                               double* dr) {
    base()->residual_tangent(base()->context, at, along, dr);
    dr[0] += along->z[0];
    dr[1] -= along->u[0];
  }
  static void bias(const void*, const catena_point* at, double* h) {
    base()->bias(base()->context, at, h);
    h[0] += at->z[0];
    h[1] -= at->u[0];
  }
  static int32_t acceleration(const void* context, const catena_point* at, double* a) {
    std::vector<double> mass(4);
    base()->mass_matrix(base()->context, at, mass.data());
    bias(context, at, a);
    a[0] = -a[0];
    a[1] = -a[1];
    if (const int bad = reference_model_detail::factor(mass, 2, true)) return bad;
    reference_model_detail::solve(mass.data(), 2, a);
    return 0;
  }
  static void state_rate(const void*, const catena_point* at, double* zdot) {
    zdot[0] = kMaxwellStiffness * at->v[0] - at->z[0] / kRelaxationTime;
  }
  static void state_rate_tangent(const void* context, const catena_point*,
                                 const catena_point* along, double* dzdot) {
    state_rate(context, along, dzdot);  // linear
  }

  static const catena_model* base() { return reference_model<2>(false); }
  static catena_model make() {
    static const catena_quantity state[] = {{"maxwell.torque_1", "N m"}};
    static const catena_quantity signal[] = {{"drive.torque", "N m"}};
    catena_model model = *base();
    model.states = 1;
    model.signals = 1;
    model.state = state;
    model.signal = signal;
    model.residual = &residual;
    model.residual_tangent = &residual_tangent;
    model.bias = &bias;
    model.acceleration = &acceleration;
    model.state_rate = &state_rate;
    model.state_rate_tangent = &state_rate_tangent;
    return model;
  }
};

}  // namespace catena::testing
