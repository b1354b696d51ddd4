// SPDX-License-Identifier: BSD-3-Clause
// Written by catena-derive. Do not edit: change the model description and derive again.
#include "chain_4.hpp"

#include "catena_model.h"
#include "directions.hpp"

namespace catena::chain_4 {

namespace {

static const catena_quantity kCoordinateTable[] = {
    {"theta_1", "rad"},
    {"theta_2", "rad"},
    {"theta_3", "rad"},
    {"theta_4", "rad"},
};

static const catena_quantity kStateTable[] = {
    {0, 0},
};

static const catena_quantity kSignalTable[] = {
    {0, 0},
};

static const catena_quantity kTermTable[] = {
    {"inertia", "N m"},
    {"coriolis", "N m"},
    {"gravity", "N m"},
    {"elastic", "N m"},
    {"friction", "N m"},
    {"torque", "N m"},
};

static const catena_parameter kParameterTable[] = {
    {"length_1", "m", "length of link 1", NAN, 0.0, INFINITY, NAN},
    {"length_2", "m", "length of link 2", NAN, 0.0, INFINITY, NAN},
    {"length_3", "m", "length of link 3", NAN, 0.0, INFINITY, NAN},
    {"length_4", "m", "length of link 4", NAN, 0.0, INFINITY, NAN},
    {"mass_1", "kg", "mass of link 1", NAN, 0.0, INFINITY, NAN},
    {"mass_2", "kg", "mass of link 2", NAN, 0.0, INFINITY, NAN},
    {"mass_3", "kg", "mass of link 3", NAN, 0.0, INFINITY, NAN},
    {"mass_4", "kg", "mass of link 4", NAN, 0.0, INFINITY, NAN},
    {"inertia_1", "kg m^2", "rotational inertia about its own centre of link 1", NAN, 0.0, INFINITY, NAN},
    {"inertia_2", "kg m^2", "rotational inertia about its own centre of link 2", NAN, 0.0, INFINITY, NAN},
    {"inertia_3", "kg m^2", "rotational inertia about its own centre of link 3", NAN, 0.0, INFINITY, NAN},
    {"inertia_4", "kg m^2", "rotational inertia about its own centre of link 4", NAN, 0.0, INFINITY, NAN},
    {"stiffness_1", "N m/rad", "stiffness of joint 1", NAN, 0.0, INFINITY, NAN},
    {"stiffness_2", "N m/rad", "stiffness of joint 2", NAN, 0.0, INFINITY, NAN},
    {"stiffness_3", "N m/rad", "stiffness of joint 3", NAN, 0.0, INFINITY, NAN},
    {"stiffness_4", "N m/rad", "stiffness of joint 4", NAN, 0.0, INFINITY, NAN},
    {"damping_1", "N m s/rad", "damping of joint 1", NAN, 0.0, INFINITY, NAN},
    {"damping_2", "N m s/rad", "damping of joint 2", NAN, 0.0, INFINITY, NAN},
    {"damping_3", "N m s/rad", "damping of joint 3", NAN, 0.0, INFINITY, NAN},
    {"damping_4", "N m s/rad", "damping of joint 4", NAN, 0.0, INFINITY, NAN},
    {"torque_1", "N m", "external torque on the angle of link 1", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_2", "N m", "external torque on the angle of link 2", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_3", "N m", "external torque on the angle of link 3", 0.0, -INFINITY, INFINITY, NAN},
    {"torque_4", "N m", "external torque on the angle of link 4", 0.0, -INFINITY, INFINITY, NAN},
    {"load_mass", "kg", "mass of the load at the free end", NAN, 0.0, INFINITY, NAN},
    {"gravity", "m/s^2", "acceleration of gravity", 9.8100000000000005, -INFINITY, INFINITY, NAN},
};

static const catena_energy kEnergyTable[] = {
    {"kinetic", CATENA_STORED},
    {"gravity", CATENA_STORED},
    {"joint_elastic", CATENA_STORED},
    {"joint_damping", CATENA_DISSIPATED},
    {"torque", CATENA_SUPPLIED},
};

#if !defined(__GNUC__) || defined(__clang__) || defined(__SANITIZE_ADDRESS__)
#define CATENA_EACH_PROCESSOR
#elif defined(__x86_64__) && !(defined(__AVX2__) && defined(__FMA__))
// Compiled twice, for processors with AVX2 and fused multiply-add too; the bits are the same.
#define CATENA_PROCESSORS
#define CATENA_EACH_PROCESSOR \
  __attribute__((target_clones("arch=x86-64-v3", "default"), flatten))
#else
#define CATENA_EACH_PROCESSOR __attribute__((flatten))
#endif

Point<double> point(const catena_point* p) {
  return {p->t, p->q, p->v, p->a, p->z, p->u, p->p};
}

CATENA_EACH_PROCESSOR
void c_residual(const void*, const catena_point* at, double* r) {
  residual(point(at), r);
}
CATENA_EACH_PROCESSOR
void c_residual_tangent(const void*, const catena_point* at, const catena_point* along,
                        double* dr) {
  residual_tangent(point(at), point(along), dr);
}
CATENA_EACH_PROCESSOR
void c_residual_tangents(const void*, const catena_point* at, const catena_point* along,
                         double* dr) {
  residual_tangent(point(at), directions(along), directions(dr));
}
CATENA_EACH_PROCESSOR
void c_residual_term(const void*, const catena_point* at, int32_t term, double* r) {
  residual_term(point(at), term, r);
}
CATENA_EACH_PROCESSOR
void c_bias(const void*, const catena_point* at, double* h) {
  bias(point(at), h);
}
CATENA_EACH_PROCESSOR
void c_mass_matrix(const void*, const catena_point* at, double* M) {
  mass_matrix(point(at), M);
}
CATENA_EACH_PROCESSOR
int32_t c_acceleration(const void*, const catena_point* at, double* a) {
  return acceleration(point(at), a);
}
CATENA_EACH_PROCESSOR
void c_energy(const void*, const catena_point* at, double* e) {
  energy(point(at), e);
}
CATENA_EACH_PROCESSOR
void c_positions(const void*, const catena_point* at, double* side, double* down) {
  positions(point(at), side, down);
}
CATENA_EACH_PROCESSOR
void c_positions_tangent(const void*, const catena_point* at, const catena_point* along,
                         double* dside, double* ddown) {
  positions_tangent(point(at), point(along), dside, ddown);
}
CATENA_EACH_PROCESSOR
void c_velocities(const void*, const catena_point* at, double* side_rate, double* down_rate) {
  velocities(point(at), side_rate, down_rate);
}
CATENA_EACH_PROCESSOR
void c_internal_forces(const void*, const catena_point* at, double* moment, double* tension,
                       double* curvature) {
  internal_forces(point(at), moment, tension, curvature);
}
CATENA_EACH_PROCESSOR
void c_reactions(const void*, const catena_point* at, double* force, double* moment) {
  reactions(point(at), force, moment);
}
CATENA_EACH_PROCESSOR
void c_residual_adjoint(const void*, const catena_point* at, const double* weights,
                        const double* rate_weights, double* dq, double* dv, double* dz,
                        double* dp) {
  residual_adjoint(point(at), weights, rate_weights, dq, dv, dz, dp);
}
NewtonMatrix<double>& matrix_in(double* work) {
  return *reinterpret_cast<NewtonMatrix<double>*>(work);
}
const NewtonMatrix<double>& factored(const double* work) {
  return matrix_in(const_cast<double*>(work));  // solving only reads
}
CATENA_EACH_PROCESSOR
int32_t c_newton_factor(const void*, const catena_point* at, double ca, double cv, double cq,
                        double* __restrict work) {
  auto&& matrix = matrix_in(work);
  newton_matrix(point(at), ca, cv, cq, matrix);
  return matrix.factor();
}
CATENA_EACH_PROCESSOR
void c_newton_solve(const void*, const double* work, double* x) {
  factored(work).solve(x);
}
CATENA_EACH_PROCESSOR
void c_newton_solves(const void*, const double* work, double* x) {
  factored(work).solve(directions(x));
}
CATENA_EACH_PROCESSOR
void c_newton_solve_transposed(const void*, const double* work, double* x) {
  factored(work).solve_transposed(x);
}
template <int size>
int32_t batch_of(const catena_point* at, double* a) {
  using Number = Batch<size>;
  const auto numbers = [](const double* first) {
    return reinterpret_cast<const Number*>(first);
  };
  const Point<Number> points{Number(at->t),  numbers(at->q), numbers(at->v), numbers(at->a),
                             numbers(at->z), numbers(at->u), numbers(at->p)};
  return acceleration(points, reinterpret_cast<Number*>(a));
}
#ifdef CATENA_PROCESSORS
__attribute__((target("arch=x86-64-v4"), flatten))
int32_t eight(const catena_point* at, double* a) {
  return batch_of<8>(at, a);
}
__attribute__((target("arch=x86-64-v3"), flatten))
int32_t four(const catena_point* at, double* a) {
  return batch_of<4>(at, a);
}
int32_t batch_size() {
  return __builtin_cpu_supports("x86-64-v4")   ? 8
         : __builtin_cpu_supports("x86-64-v3") ? 4
                                                 : 2;
}
int32_t c_accelerations(const void*, const catena_point* at, double* a) {
  static const int32_t batch = batch_size();
  return batch == 8 ? eight(at, a) : batch == 4 ? four(at, a) : batch_of<2>(at, a);
}
#elif defined(__GNUC__)
#if defined(__AVX512F__)
static constexpr int kBatch = 8;
#elif defined(__AVX2__)
static constexpr int kBatch = 4;
#else
static constexpr int kBatch = 2;
#endif
int32_t batch_size() { return kBatch; }
CATENA_EACH_PROCESSOR
int32_t c_accelerations(const void*, const catena_point* at, double* a) {
  return batch_of<kBatch>(at, a);
}
#else
int32_t batch_size() { return 1; }
int32_t c_accelerations(const void* context, const catena_point* at, double* a) {
  return c_acceleration(context, at, a);
}
#endif
}  // namespace

const ::catena_model& table() {
  static const ::catena_model model = {
      CATENA_MODEL_ABI,
      sizeof(::catena_model),
      "chain_4",
      "fa7041eb0fff7d62b7a0a54413cc5a263a87087073ced168df3a0024accbbce8",
      nullptr,  // context
      kLinks,
      kCoordinates,
      kStates,
      kSignals,
      kParameters,
      6,  // terms
      5,  // energies
      0,  // observes
      1,  // structured
      sizeof(NewtonMatrix<double>) / sizeof(double),
      batch_size(),  // batch
      kCoordinateTable,
      kStateTable,
      kSignalTable,
      kParameterTable,
      kTermTable,
      kEnergyTable,
      c_residual,
      c_residual_tangent,
      c_residual_tangents,
      c_residual_adjoint,
      c_residual_term,
      nullptr,
      nullptr,
      nullptr,
      c_mass_matrix,
      c_bias,
      c_acceleration,
      c_accelerations,
      c_newton_factor,
      c_newton_solve,
      c_newton_solves,
      c_newton_solve_transposed,
      c_energy,
      c_positions,
      c_positions_tangent,
      c_velocities,
      c_internal_forces,
      nullptr,
      nullptr,
      nullptr,
      nullptr,
      nullptr,
      nullptr,
      nullptr,
      c_reactions,
      nullptr,
      nullptr,
      0,  // events
      nullptr,
  };
  return model;
}

}  // namespace catena::chain_4

#ifdef CATENA_SHARED_LIBRARY
// The one entry of a shared library that holds this model alone.
extern "C" const catena_model* catena_model_table() {
  return &catena::chain_4::table();
}
#endif
