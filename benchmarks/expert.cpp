// SPDX-License-Identifier: BSD-3-Clause
//
// Compiled for the processor at hand with -ffast-math: g++ then takes the vector sine and cosine of
// the C library. Directions: x to the side, y down; e points along a link, t = de/dq.
#include "benchmarks/expert.hpp"

#include <cmath>
#include <type_traits>

namespace catena::benchmark {
namespace {

template <int N>
class ExpertOf : public Expert {
 public:
  ExpertOf(const Cable& cable, double rest_angle)
      : torque(cable.stiffness * rest_angle), load(cable.load), g(cable.gravity) {
    for (int i = 0; i < N; ++i) {
      l[i] = cable.length;
      m[i] = cable.mass;
      half[i] = m[i] * l[i] / 2;
      about_joint[i] = cable.inertia + half[i] * l[i] / 2;
      k[i] = cable.stiffness;
      c[i] = cable.damping;
    }
  }

  void accelerations(const double* q, const double* v, double* a) override {
    directions(q);
    joint_moments(q, v);
    double hx[N], hy[N], moment[N], inverse[N], square[N];
    for (int i = 0; i < N; ++i) square[i] = l[i] * v[i] * v[i];
    double xx = load, xy = 0, yy = load, bx = 0, by = 0;
    for (int i = N - 1; i >= 0; --i) {
      const double tx = cosine[i], ty = -sine[i];
      const double ax = xx * tx + xy * ty, ay = xy * tx + yy * ty;
      // The end's centripetal acceleration is -square e, with e = (-ty, tx).
      const double ex = bx + square[i] * (xx * ty - xy * tx);
      const double ey = by + square[i] * (xy * ty - yy * tx);
      hx[i] = half[i] * tx + l[i] * ax;
      hy[i] = half[i] * ty + l[i] * ay;
      inverse[i] = 1 / (about_joint[i] + l[i] * l[i] * (tx * ax + ty * ay));
      moment[i] = (acting[i] - l[i] * (tx * ex + ty * ey)) * inverse[i];
      bx = ex + m[i] / 2 * square[i] * ty + hx[i] * moment[i];
      by = ey - m[i] / 2 * square[i] * tx + hy[i] * moment[i];
      xx += m[i] - hx[i] * hx[i] * inverse[i];
      xy -= hx[i] * hy[i] * inverse[i];
      yy += m[i] - hy[i] * hy[i] * inverse[i];
      hx[i] *= inverse[i];
      hy[i] *= inverse[i];
    }
    double rx = 0, ry = -g;
    for (int i = 0; i < N; ++i) {
      a[i] = moment[i] - hx[i] * rx - hy[i] * ry;
      rx += l[i] * a[i] * cosine[i] - square[i] * sine[i];
      ry -= l[i] * a[i] * sine[i] + square[i] * cosine[i];
    }
  }

  void residual(const double* q, const double* v, const double* a, double* r) override {
    directions(q);
    joint_moments(q, v);
    joint_accelerations_and_forces(v, a);
    for (int i = 0; i < N; ++i)
      r[i] = about_joint[i] * a[i] - acting[i] +
             cosine[i] * (half[i] * above_x[i] + l[i] * force_x[i]) -
             sine[i] * (half[i] * above_y[i] + l[i] * force_y[i]);
  }

  void tangent(const double* q, const double* v, const double* a, const double* dq,
               const double* dv, const double* da, double* dr) override {
    directions(q);
    joint_accelerations_and_forces(v, a);
    double ux[N], uy[N], moved_x[N], moved_y[N];
    for (int i = 0; i < N; ++i) {
      const double along_t = l[i] * (da[i] - v[i] * v[i] * dq[i]);
      const double along_e = l[i] * (a[i] * dq[i] + 2 * v[i] * dv[i]);
      ux[i] = along_t * cosine[i] - along_e * sine[i];
      uy[i] = -along_t * sine[i] - along_e * cosine[i];
    }
    double rx = 0, ry = 0;
    for (int i = 0; i < N; ++i) {
      moved_x[i] = rx;
      moved_y[i] = ry;
      rx += ux[i];
      ry += uy[i];
    }
    double fx = load * rx, fy = load * ry;
    double below = 0;  // moment of the joint below
    for (int i = N - 1; i >= 0; --i) {
      const double joint =
          k[i] * (dq[i] - (i ? dq[i - 1] : 0)) + c[i] * (dv[i] - (i ? dv[i - 1] : 0));
      const double hx = half[i] * above_x[i] + l[i] * force_x[i];
      const double hy = half[i] * above_y[i] + l[i] * force_y[i];
      dr[i] = about_joint[i] * da[i] + joint - below - dq[i] * (sine[i] * hx + cosine[i] * hy) +
              cosine[i] * (half[i] * moved_x[i] + l[i] * fx) -
              sine[i] * (half[i] * moved_y[i] + l[i] * fy);
      below = joint;
      fx += m[i] * (moved_x[i] + ux[i] / 2);
      fy += m[i] * (moved_y[i] + uy[i] / 2);
    }
  }

  void newton_factor(const double* q, const double* v, const double* a, double cm, double cv,
                     double cq) override {
    directions(q);
    joint_accelerations_and_forces(v, a);
    double ux[N], uy[N], pivot[N];
    for (int i = 0; i < N; ++i) {
      const double along_t = l[i] * (cm - v[i] * v[i] * cq);
      const double along_e = l[i] * (a[i] * cq + 2 * v[i] * cv);
      ux[i] = along_t * cosine[i] - along_e * sine[i];
      uy[i] = -along_t * sine[i] - along_e * cosine[i];
      pivot[i] = about_joint[i] * cm + cq * k[i] + cv * c[i] -
                 cq * (sine[i] * (half[i] * above_x[i] + l[i] * force_x[i]) +
                       cosine[i] * (half[i] * above_y[i] + l[i] * force_y[i]));
    }
    // What a joint passes up, (force, less the moment), by what it is given: its change of
    // acceleration and the change of the angle above.
    double s[3][3] = {{load, 0, 0}, {0, load, 0}, {0, 0, 0}};
    for (int i = N - 1; i >= 0; --i) {
      const double coupling = cq * k[i] + cv * c[i];
      const double tx = l[i] * cosine[i], ty = -l[i] * sine[i];
      const double cx = s[0][0] * ux[i] + s[0][1] * uy[i] + s[0][2];
      const double cy = s[1][0] * ux[i] + s[1][1] * uy[i] + s[1][2];
      const double cz = s[2][0] * ux[i] + s[2][1] * uy[i] + s[2][2];
      const double inverse = 1 / (pivot[i] + tx * cx + ty * cy + cz);
      const double row[3] = {m[i] / 2 * tx + tx * s[0][0] + ty * s[1][0] + s[2][0],
                             m[i] / 2 * ty + tx * s[0][1] + ty * s[1][1] + s[2][1], -coupling};
      const double column[3] = {cx + m[i] / 2 * ux[i], cy + m[i] / 2 * uy[i], -coupling};
      row_x[i] = row[0] * inverse;
      row_y[i] = row[1] * inverse;
      row_z[i] = row[2] * inverse;
      column_x[i] = column[0];
      column_y[i] = column[1];
      inverse_pivot[i] = inverse;
      couplings[i] = coupling;
      end_x[i] = ux[i];
      end_y[i] = uy[i];
      s[0][0] += m[i] - column[0] * row_x[i];
      s[0][1] -= column[0] * row_y[i];
      s[0][2] = -column[0] * row_z[i];
      s[1][0] -= column[1] * row_x[i];
      s[1][1] += m[i] - column[1] * row_y[i];
      s[1][2] = -column[1] * row_z[i];
      s[2][0] = coupling * row_x[i];
      s[2][1] = coupling * row_y[i];
      s[2][2] = coupling + coupling * row_z[i];
    }
  }

  void newton_solve(double* x) override {
    double sx = 0, sy = 0, sz = 0;
    for (int i = N - 1; i >= 0; --i) {
      x[i] = (x[i] - l[i] * (cosine[i] * sx - sine[i] * sy) - sz) * inverse_pivot[i];
      sx += column_x[i] * x[i];
      sy += column_y[i] * x[i];
      sz = -couplings[i] * x[i];
    }
    double rx = 0, ry = 0, above = 0;
    for (int i = 0; i < N; ++i) {
      x[i] -= row_x[i] * rx + row_y[i] * ry + row_z[i] * above;
      rx += end_x[i] * x[i];
      ry += end_y[i] * x[i];
      above = x[i];
    }
  }

 private:
  void directions(const double* q) {
    for (int i = 0; i < N; ++i) sine[i] = std::sin(q[i]);
    for (int i = 0; i < N; ++i) cosine[i] = std::cos(q[i]);
  }

  void joint_moments(const double* q, const double* v) {
    double joint[N + 1];
    joint[0] = k[0] * q[0] + c[0] * v[0] - torque;
    for (int i = 1; i < N; ++i) joint[i] = k[i] * (q[i] - q[i - 1]) + c[i] * (v[i] - v[i - 1]);
    joint[N] = 0;
    for (int i = 0; i < N; ++i) acting[i] = joint[i + 1] - joint[i];
  }

  /// Of the joint above each link, less gravity, and the force in the joint below it.
  void joint_accelerations_and_forces(const double* v, const double* a) {
    double ux[N], uy[N];
    for (int i = 0; i < N; ++i) {
      ux[i] = l[i] * (a[i] * cosine[i] - v[i] * v[i] * sine[i]);
      uy[i] = -l[i] * (a[i] * sine[i] + v[i] * v[i] * cosine[i]);
    }
    double rx = 0, ry = -g;
    for (int i = 0; i < N; ++i) {
      above_x[i] = rx;
      above_y[i] = ry;
      rx += ux[i];
      ry += uy[i];
    }
    double fx = load * rx, fy = load * ry;
    for (int i = N - 1; i >= 0; --i) {
      force_x[i] = fx;
      force_y[i] = fy;
      fx += m[i] * (above_x[i] + ux[i] / 2);
      fy += m[i] * (above_y[i] + uy[i] / 2);
    }
  }

  const double torque, load, g;
  double l[N], m[N], half[N], about_joint[N], k[N], c[N];
  double sine[N], cosine[N], acting[N], above_x[N], above_y[N], force_x[N], force_y[N];
  double row_x[N], row_y[N], row_z[N], column_x[N], column_y[N], end_x[N], end_y[N];
  double inverse_pivot[N], couplings[N];
};

template <int... counts>
std::unique_ptr<Expert> make_one_of(const Cable& cable, double rest_angle) {
  std::unique_ptr<Expert> made;
  const auto make = [&]<int n>(std::integral_constant<int, n>) {
    if (cable.links == n) made = std::make_unique<ExpertOf<n>>(cable, rest_angle);
  };
  (make(std::integral_constant<int, counts>()), ...);
  return made;
}

}  // namespace

std::unique_ptr<Expert> make_expert(const Cable& cable, double rest_angle) {
  return make_one_of<2, 3, 4, 12, 60, 240, 1000>(cable, rest_angle);
}

}  // namespace catena::benchmark
