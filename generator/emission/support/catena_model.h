/* SPDX-License-Identifier: BSD-3-Clause
 *
 * catena_model.h: the table of functions behind which every emitted model stands. Plain C.
 *
 * Equations of motion, in the form of the inverse dynamics (3.4):
 *
 *     r(t, q, v, a, z, u, p) = M(q) a + C v + K q + F(q, v) + G(q) + effects - T = 0
 *     zdot                   = f(t, q, v, z, u, p)
 *
 * q     coordinates: the absolute angle of each link from the downward vertical (rad), positive
 *       towards +side; further coordinates of effects follow. In space: the components side, then
 *       down, then across of a vector along each link, of any length but zero (docs/model.md)
 * v, a  first and second time derivatives of q
 * z     extra states of effects (hysteresis and the like)
 * u     signals: functions of time given by data; for signal k, u[3k] is its value, u[3k+1] its
 *       first and u[3k+2] its second time derivative
 * p     parameters, in the order of the parameter table
 * side, down   the two Cartesian components: side is horizontal, down along gravity; origin at the
 *       nominal fixed point. In space a third, across, horizontal too: side x down = across
 *
 * SI units throughout. No function allocates, keeps state, or writes anything but its outputs; all
 * may be called from several threads. Pointers must be valid for the counts declared here; arrays
 * of count zero may be null. Outputs must not overlap inputs.
 *
 * A tangent (directional derivative) takes a second point, `along`, that holds the differentials
 * (dt, dq, dv, da, dz, du, dp); every array is to be given, zero where nothing varies.
 *
 * Versions: `abi` rises when a member changes meaning, moves or goes; else members are only added at
 * the end, and `size` tells how many bytes of the table are there.
 */
#ifndef CATENA_MODEL_H
#define CATENA_MODEL_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CATENA_MODEL_ABI 4
#define CATENA_DIRECTIONS 4

typedef struct catena_parameter {
  const char* name;        /* "length_3", "load_mass", "air_drag_quadratic.normal" */
  const char* unit;        /* "m", "N m/rad", "1" */
  const char* description; /* one line */
  double default_value;    /* NaN: a case must give it */
  double lower, upper;     /* bounds of the admissible values; infinite where there is none */
  double neutral;          /* value at which the effect vanishes; NaN for the chain's own */
} catena_parameter;

typedef struct catena_quantity {
  const char* name; /* "theta_1", "gravity", "joint_damping" */
  const char* unit;
} catena_quantity;

enum {
  CATENA_STORED = 0,     /* an energy, J */
  CATENA_DISSIPATED = 1, /* a power that leaves the chain, W */
  CATENA_SUPPLIED = 2    /* a power that enters the chain, W */
};

typedef struct catena_energy {
  const char* name; /* "kinetic", "gravity", "joint_elastic", "joint_damping", an effect's id */
  int32_t kind;     /* CATENA_STORED, CATENA_DISSIPATED or CATENA_SUPPLIED */
} catena_energy;

typedef struct catena_point {
  double t;
  const double *q, *v, *a, *z, *u, *p;
} catena_point;

typedef struct catena_model {
  uint32_t abi;  /* CATENA_MODEL_ABI */
  uint32_t size; /* sizeof(catena_model) where the model was compiled */
  const char* id;
  const char* description_hash; /* SHA-256 of the canonical model description, hexadecimal */
  /* What the functions need to know of this one model: each takes it as its first argument and
     nobody else looks into it. Null where the functions know all themselves. Where it is not, it
     lives as long as the table. */
  const void* context;

  int32_t links;
  int32_t coordinates; /* length of q, v, a, r */
  int32_t states;      /* length of z */
  int32_t signals;     /* u has three times as many entries */
  int32_t parameters;  /* length of p */
  int32_t terms;       /* terms of r, each available alone; their sum is r */
  int32_t energies;    /* length of the energy output */
  int32_t observes;    /* 1 if a sensor effect changes what is observed */
  int32_t structured;  /* 1: the Newton matrix is factored in O(links); 0: newton_* are null */
  int32_t newton_work; /* doubles of work space for newton_factor and newton_solve */
  int32_t batch;       /* points that one call of accelerations takes: 1, 2, 4 or 8, which the
                          processor decides */

  const catena_quantity* coordinate;
  const catena_quantity* state;
  const catena_quantity* signal;
  const catena_parameter* parameter;
  /* "inertia", "coriolis", "gravity", "elastic", "friction", "torque", effects' ids */
  const catena_quantity* term;
  const catena_energy* energy_item;

  /* Functions. The first argument of each is `context` of this table. */

  /* r[coordinates] and its derivative along `along` */
  void (*residual)(const void* context, const catena_point* at, double* r);
  void (*residual_tangent)(const void* context, const catena_point* at, const catena_point* along,
                           double* dr);
  /* residual_tangent for CATENA_DIRECTIONS directions at once: every array of `along` and dr hold
     that many numbers for each entry, one a direction, and are aligned to as many doubles; along->t
     is that of all. The bits are those of one direction at a time. Null in models emitted as C. */
  void (*residual_tangents)(const void* context, const catena_point* at, const catena_point* along,
                            double* dr);
  /* Gradient of weight . r + rate_weight . zdot with respect to q, v, z and p, at->a held fixed:
     dq[coordinates], dv[coordinates], dz[states], dp[parameters]. weight[coordinates],
     rate_weight[states]. */
  void (*residual_adjoint)(const void* context, const catena_point* at, const double* weight,
                           const double* rate_weight, double* dq, double* dv, double* dz,
                           double* dp);
  /* one term of r alone */
  void (*residual_term)(const void* context, const catena_point* at, int32_t term, double* r);
  /* zdot[states], its derivative along `along`, and that along CATENA_DIRECTIONS directions at once,
     as residual_tangents; all null if states is 0 */
  void (*state_rate)(const void* context, const catena_point* at, double* zdot);
  void (*state_rate_tangent)(const void* context, const catena_point* at, const catena_point* along,
                             double* dzdot);
  void (*state_rate_tangents)(const void* context, const catena_point* at,
                              const catena_point* along, double* dzdot);
  /* M, coordinates x coordinates, row by row; at->v, at->a are not read */
  void (*mass_matrix)(const void* context, const catena_point* at, double* mass);
  /* r with a = 0; at->a is not read */
  void (*bias)(const void* context, const catena_point* at, double* h);
  /* a such that r = 0; at->a is not read. Returns 0, or the 1-based index of the coordinate whose
     pivot is not positive (M not positive definite): then a is not to be used. */
  int32_t (*acceleration)(const void* context, const catena_point* at, double* a);
  /* acceleration for `batch` points at once, with the bits of one at a time: entry i of point k is
     [i * batch + k] in q, v, z, u, p and a, each aligned to 8 * batch bytes; t is the same for all. */
  int32_t (*accelerations)(const void* context, const catena_point* at, double* a);
  /* N = ca dr/da + cv dr/dv + cq dr/dq at the point (at->a is read). Factors N into work; returns
     0, or the 1-based index of the coordinate whose pivot vanished. newton_solve overwrites x, the
     right-hand side, with the solution; newton_solves does so for CATENA_DIRECTIONS right-hand
     sides, x as dr in residual_tangents; newton_solve_transposed solves with the transpose of N.
     Null unless structured. With extra states ca must be 1 and N has
     cv dr/dz (1 - cv dzdot/dz)^-1 (cv dzdot/dv + cq dzdot/dq) besides: z is eliminated. */
  int32_t (*newton_factor)(const void* context, const catena_point* at, double ca, double cv,
                           double cq, double* work);
  void (*newton_solve)(const void* context, const double* work, double* x);
  void (*newton_solves)(const void* context, const double* work, double* x);
  void (*newton_solve_transposed)(const void* context, const double* work, double* x);
  /* energies and powers, energies entries in the order of energy_item */
  void (*energy)(const void* context, const catena_point* at, double* e);
  /* side[links + 2], down[links + 2]: the support, the far ends of links 1 to n, the load */
  void (*positions)(const void* context, const catena_point* at, double* side, double* down);
  void (*positions_tangent)(const void* context, const catena_point* at, const catena_point* along,
                            double* dside, double* ddown);
  /* velocities of the same points */
  void (*velocities)(const void* context, const catena_point* at, double* side_rate,
                     double* down_rate);
  /* per joint: moment[links] (N m, acting on link i from link i-1's side, positive towards +theta),
     per link: tension[links] (N, at its upper end, positive pulls), curvature[links] (rad/m) at
     joint i: its change of angle over the distance between the middles of its links; at joint 1,
     the clamp, over half of link 1. In space moments and curvatures are sizes, not negative. */
  void (*internal_forces)(const void* context, const catena_point* at, double* moment,
                          double* tension, double* curvature);
  /* What a sensor reports of a point. in, out: its side and down (m), then in the plane the angle of its
     link (rad), in space its across (m). Null unless observes: then nothing changes. */
  void (*observe)(const void* context, double t, const double* p, const double in[3],
                  double out[3]);
  void (*observe_tangent)(const void* context, double t, const double* p, const double* dp,
                          const double in[3], const double din[3], double dout[3]);
  /* model time at which what was recorded at time t happened, and its derivative along dp; null
     unless observes */
  double (*clock)(const void* context, double t, const double* p);
  double (*clock_tangent)(const void* context, double t, const double* p, const double* dp);
  /* In space, the third component of positions, of positions_tangent and of velocities; null in the
     plane. */
  void (*positions_across)(const void* context, const catena_point* at, double* across);
  void (*positions_across_tangent)(const void* context, const catena_point* at,
                                   const catena_point* along, double* dacross);
  void (*velocities_across)(const void* context, const catena_point* at, double* across_rate);
  /* What holds the support, then each of the k held places, exerts on the chain: forces (N) and moments
     (N m) by components side, down, across, force[3 + 3 k] and moment[3 + 3 k]. In the plane force[2] and
     moment[1], positive towards +theta. at->a is read. Null where nothing tells them. */
  void (*reactions)(const void* context, const catena_point* at, double* force, double* moment);
  /* Where k links have a held far end, null elsewhere. The last 3 k coordinates are then those of the
     constraints: their second derivatives are the forces that the links exert on what holds them, their
     values and rates enter no equation. apart[3 k]: from where each is held to its link's far end, m;
     rate[3 k]: its time derivative. */
  void (*gap)(const void* context, const catena_point* at, double* apart, double* rate);
  /* value[events]: each changes its sign at events of its kind, such as a link that touches the floor.
     at->a is not read. Null if events is 0. */
  void (*event_values)(const void* context, const catena_point* at, double* value);
  int32_t events; /* length of the output of event_values */
  const catena_quantity* event;
} catena_model;

/* What a shared library holding one model exports. */
typedef const catena_model* (*catena_model_entry)(void);
#define CATENA_MODEL_ENTRY "catena_model_table"

#ifdef __cplusplus
}
#endif
#endif
