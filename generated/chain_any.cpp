// SPDX-License-Identifier: BSD-3-Clause
// Written by catena-derive. Do not edit: change the model description and derive again.
#include "chain_any.hpp"

#include "directions.hpp"

namespace catena::chain_any {

namespace {

static const catena_quantity kTermTable[] = {
    {"inertia", "N m"},
    {"coriolis", "N m"},
    {"gravity", "N m"},
    {"elastic", "N m"},
    {"friction", "N m"},
    {"torque", "N m"},
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

const Chain& chain(const void* context) {
  return *static_cast<const Chain*>(context);
}

CATENA_EACH_PROCESSOR
void c_residual(const void* context, const catena_point* at, double* r) {
  chain(context).residual(point(at), r);
}
CATENA_EACH_PROCESSOR
void c_residual_tangent(const void* context, const catena_point* at, const catena_point* along,
                        double* dr) {
  chain(context).residual_tangent(point(at), point(along), dr);
}
CATENA_EACH_PROCESSOR
void c_residual_tangents(const void* context, const catena_point* at, const catena_point* along,
                         double* dr) {
  chain(context).residual_tangent(point(at), directions(along), directions(dr));
}
CATENA_EACH_PROCESSOR
void c_residual_term(const void* context, const catena_point* at, int32_t term, double* r) {
  chain(context).residual_term(point(at), term, r);
}
CATENA_EACH_PROCESSOR
void c_bias(const void* context, const catena_point* at, double* h) {
  chain(context).bias(point(at), h);
}
CATENA_EACH_PROCESSOR
void c_mass_matrix(const void* context, const catena_point* at, double* M) {
  chain(context).mass_matrix(point(at), M);
}
CATENA_EACH_PROCESSOR
int32_t c_acceleration(const void* context, const catena_point* at, double* a) {
  return chain(context).acceleration(point(at), a);
}
CATENA_EACH_PROCESSOR
void c_energy(const void* context, const catena_point* at, double* e) {
  chain(context).energy(point(at), e);
}
CATENA_EACH_PROCESSOR
void c_positions(const void* context, const catena_point* at, double* side, double* down) {
  chain(context).positions(point(at), side, down);
}
CATENA_EACH_PROCESSOR
void c_positions_tangent(const void* context, const catena_point* at, const catena_point* along,
                         double* dside, double* ddown) {
  chain(context).positions_tangent(point(at), point(along), dside, ddown);
}
CATENA_EACH_PROCESSOR
void c_velocities(const void* context, const catena_point* at, double* side_rate,
                  double* down_rate) {
  chain(context).velocities(point(at), side_rate, down_rate);
}
CATENA_EACH_PROCESSOR
void c_internal_forces(const void* context, const catena_point* at, double* moment, double* tension,
                       double* curvature) {
  chain(context).internal_forces(point(at), moment, tension, curvature);
}
CATENA_EACH_PROCESSOR
void c_reactions(const void* context, const catena_point* at, double* force, double* moment) {
  chain(context).reactions(point(at), force, moment);
}
CATENA_EACH_PROCESSOR
void c_residual_adjoint(const void* context, const catena_point* at, const double* weights,
                        const double* rate_weights, double* dq, double* dv, double* dz,
                        double* dp) {
  chain(context).residual_adjoint(point(at), weights, rate_weights, dq, dv, dz, dp);
}
NewtonMatrix<double> matrix_in(const void* context, double* work) {
  return {chain(context).links(), work};
}
const NewtonMatrix<double> factored(const void* context, const double* work) {
  return matrix_in(context, const_cast<double*>(work));  // solving only reads
}
CATENA_EACH_PROCESSOR
int32_t c_newton_factor(const void* context, const catena_point* at, double ca, double cv,
                        double cq, double* __restrict work) {
  auto&& matrix = matrix_in(context, work);
  chain(context).newton_matrix(point(at), ca, cv, cq, matrix);
  return matrix.factor();
}
CATENA_EACH_PROCESSOR
void c_newton_solve(const void* context, const double* work, double* x) {
  factored(context, work).solve(x);
}
CATENA_EACH_PROCESSOR
void c_newton_solves(const void* context, const double* work, double* x) {
  factored(context, work).solve(directions(x));
}
CATENA_EACH_PROCESSOR
void c_newton_solve_transposed(const void* context, const double* work, double* x) {
  factored(context, work).solve_transposed(x);
}
template <int size>
int32_t batch_of(const void* context, const catena_point* at, double* a) {
  using Number = Batch<size>;
  const auto numbers = [](const double* first) {
    return reinterpret_cast<const Number*>(first);
  };
  const Point<Number> points{Number(at->t),  numbers(at->q), numbers(at->v), numbers(at->a),
                             numbers(at->z), numbers(at->u), numbers(at->p)};
  return chain(context).accelerations(points, reinterpret_cast<Number*>(a));
}
#ifdef CATENA_PROCESSORS
__attribute__((target("arch=x86-64-v4"), flatten))
int32_t eight(const void* context, const catena_point* at, double* a) {
  return batch_of<8>(context, at, a);
}
__attribute__((target("arch=x86-64-v3"), flatten))
int32_t four(const void* context, const catena_point* at, double* a) {
  return batch_of<4>(context, at, a);
}
int32_t batch_size() {
  return __builtin_cpu_supports("x86-64-v4")   ? 8
         : __builtin_cpu_supports("x86-64-v3") ? 4
                                                 : 2;
}
int32_t c_accelerations(const void* context, const catena_point* at, double* a) {
  static const int32_t batch = batch_size();
  return batch == 8 ? eight(context, at, a) : batch == 4 ? four(context, at, a) : batch_of<2>(context, at, a);
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
int32_t c_accelerations(const void* context, const catena_point* at, double* a) {
  return batch_of<kBatch>(context, at, a);
}
#else
int32_t batch_size() { return 1; }
int32_t c_accelerations(const void* context, const catena_point* at, double* a) {
  return c_acceleration(context, at, a);
}
#endif

}  // namespace

catena_model table(const Chain& chain) {
  const int links = chain.links();
  const bool has_batch = links <= 1000;  // their arrays are on the stack
  return {
      CATENA_MODEL_ABI,
      sizeof(catena_model),
      nullptr,  // id
      "fa7041eb0fff7d62b7a0a54413cc5a263a87087073ced168df3a0024accbbce8",
      &chain,  // context
      links,
      chain.coordinates(),
      chain.states(),
      chain.signals(),
      chain.parameters(),
      6,  // terms
      5,  // energies
      0,  // observes
      1,  // structured
      NewtonMatrix<double>::numbers(links),
      has_batch ? batch_size() : 1,  // batch
      nullptr,
      nullptr,
      nullptr,
      nullptr,
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
      has_batch ? c_accelerations : c_acceleration,
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
      chain.events(),  // events
      nullptr,
  };
}

}  // namespace catena::chain_any
