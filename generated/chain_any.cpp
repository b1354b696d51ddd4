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

struct Functions : Chain {
  CATENA_EACH_PROCESSOR void c_residual(const catena_point* at, double* r) { residual(point(at), r); }
  CATENA_EACH_PROCESSOR void c_residual_tangent(const catena_point* at, const catena_point* along, double* dr) {
    residual_tangent(point(at), point(along), dr);
  }
  CATENA_EACH_PROCESSOR void c_residual_tangents(const catena_point* at,
                                                 const catena_point* along, double* dr) {
    residual_tangent(point(at), directions(along), directions(dr));
  }
  CATENA_EACH_PROCESSOR void c_residual_term(const catena_point* at, int32_t term, double* r) {
    residual_term(point(at), term, r);
  }
  CATENA_EACH_PROCESSOR void c_bias(const catena_point* at, double* h) { bias(point(at), h); }
  CATENA_EACH_PROCESSOR void c_mass_matrix(const catena_point* at, double* mass) {
    mass_matrix(point(at), mass);
  }
  CATENA_EACH_PROCESSOR int32_t c_acceleration(const catena_point* at, double* a) {
    return acceleration(point(at), a);
  }
  CATENA_EACH_PROCESSOR int32_t c_newton_factor(const catena_point* at, double ca, double cv, double cq,
                          double* work) {
    NewtonMatrix<double> matrix(links(), work);
    newton_matrix(point(at), ca, cv, cq, matrix);
    return matrix.factor();
  }
  const NewtonMatrix<double> factored(const double* work) const {
    return {links(), const_cast<double*>(work)};  // solving only reads
  }
  CATENA_EACH_PROCESSOR void c_newton_solve(const double* work, double* x) {
    factored(work).solve(x);
  }
  CATENA_EACH_PROCESSOR void c_newton_solves(const double* work, double* x) {
    factored(work).solve(directions(x));
  }
  CATENA_EACH_PROCESSOR void c_newton_solve_transposed(const double* work, double* x) {
    factored(work).solve_transposed(x);
  }
  CATENA_EACH_PROCESSOR void c_energy(const catena_point* at, double* e) { energy(point(at), e); }
  CATENA_EACH_PROCESSOR void c_energy_tangent(const catena_point* at, const catena_point* along, double* de) {
    energy_tangent(point(at), point(along), de);
  }
  CATENA_EACH_PROCESSOR void c_positions(const catena_point* at, double* side, double* down) {
    positions(point(at), side, down);
  }
  CATENA_EACH_PROCESSOR void c_positions_tangent(const catena_point* at, const catena_point* along,
                           double* dside, double* ddown) {
    positions_tangent(point(at), point(along), dside, ddown);
  }
  CATENA_EACH_PROCESSOR void c_velocities(const catena_point* at, double* side_rate, double* down_rate) {
    velocities(point(at), side_rate, down_rate);
  }
  CATENA_EACH_PROCESSOR void c_velocities_tangent(const catena_point* at, const catena_point* along,
                            double* dside_rate, double* ddown_rate) {
    velocities_tangent(point(at), point(along), dside_rate, ddown_rate);
  }
  CATENA_EACH_PROCESSOR void c_internal_forces(const catena_point* at, double* moment, double* tension,
                         double* curvature) {
    internal_forces(point(at), moment, tension, curvature);
  }
  CATENA_EACH_PROCESSOR void c_internal_forces_tangent(const catena_point* at, const catena_point* along,
                                 double* dmoment, double* dtension, double* dcurvature) {
    internal_forces_tangent(point(at), point(along), dmoment, dtension, dcurvature);
  }
  CATENA_EACH_PROCESSOR void c_residual_adjoint(const catena_point* at, const double* weights,
                          const double* rate_weights, double* dq, double* dv, double* dz,
                          double* dp) {
    residual_adjoint(point(at), weights, rate_weights, dq, dv, dz, dp);
  }
  template <int sets>
  int32_t several(const catena_point* at, double* a) {
    using Number = Lanes<sets>;
    const auto numbers = [](const double* first) {
      return reinterpret_cast<const Number*>(first);
    };
    const Point<Number> points{Number(at->t),  numbers(at->q), numbers(at->v), numbers(at->a),
                               numbers(at->z), numbers(at->u), numbers(at->p)};
    return accelerations(points, reinterpret_cast<Number*>(a));
  }
#ifdef CATENA_PROCESSORS
  __attribute__((target("arch=x86-64-v4"), flatten)) int32_t eight(const catena_point* at,
                                                                  double* a) {
    return several<8>(at, a);
  }
  __attribute__((target("arch=x86-64-v3"), flatten)) int32_t four(const catena_point* at,
                                                                 double* a) {
    return several<4>(at, a);
  }
  int32_t sets_at_once() {
    return __builtin_cpu_supports("x86-64-v4")   ? 8
           : __builtin_cpu_supports("x86-64-v3") ? 4
                                                   : 2;
  }
  int32_t c_accelerations(const catena_point* at, double* a) {
    static const int32_t sets = sets_at_once();
    return sets == 8 ? eight(at, a) : sets == 4 ? four(at, a) : several<2>(at, a);
  }
#elif defined(__GNUC__)
#if defined(__AVX512F__)
  static constexpr int kSets = 8;
#elif defined(__AVX2__)
  static constexpr int kSets = 4;
#else
  static constexpr int kSets = 2;
#endif
  int32_t sets_at_once() { return kSets; }
  CATENA_EACH_PROCESSOR int32_t c_accelerations(const catena_point* at, double* a) {
    return several<kSets>(at, a);
  }
#else
  int32_t sets_at_once() { return 1; }
  int32_t c_accelerations(const catena_point* at, double* a) { return c_acceleration(at, a); }
#endif
};

struct MakeTable {
  template <int place>
  catena_model operator()(int links) const {
    using Place = AtPlace<Functions, place>;
    Place::links = links;
    const bool several = links <= 1000;
    Functions functions{{links}};
    return {
        CATENA_MODEL_ABI,
        sizeof(catena_model),
        nullptr,  // id
        "fa7041eb0fff7d62b7a0a54413cc5a263a87087073ced168df3a0024accbbce8",
        links,
        functions.coordinates(),
        0,  // states
        0,  // signals
        functions.parameters(),
        6,  // terms
        5,  // energies
        0,  // uses_time
        0,  // observes
        1,  // structured
        NewtonMatrix<double>::numbers(links),
        nullptr,  // coordinates
        nullptr,
        nullptr,
        nullptr,  // parameters
        kTermTable,
        kEnergyTable,
        Place::template Call<&Functions::c_residual>::of,
        Place::template Call<&Functions::c_residual_tangent>::of,
        Place::template Call<&Functions::c_residual_term>::of,
        nullptr,
        nullptr,
        Place::template Call<&Functions::c_mass_matrix>::of,
        Place::template Call<&Functions::c_bias>::of,
        Place::template Call<&Functions::c_acceleration>::of,
        Place::template Call<&Functions::c_newton_factor>::of,
        Place::template Call<&Functions::c_newton_solve>::of,
        Place::template Call<&Functions::c_energy>::of,
        Place::template Call<&Functions::c_positions>::of,
        Place::template Call<&Functions::c_positions_tangent>::of,
        Place::template Call<&Functions::c_velocities>::of,
        Place::template Call<&Functions::c_internal_forces>::of,
        nullptr,
        nullptr,
        nullptr,
        nullptr,
        Place::template Call<&Functions::c_velocities_tangent>::of,
        Place::template Call<&Functions::c_energy_tangent>::of,
        Place::template Call<&Functions::c_internal_forces_tangent>::of,
        Place::template Call<&Functions::c_residual_adjoint>::of,
        Place::template Call<&Functions::c_newton_solve_transposed>::of,
        Place::template Call<&Functions::c_residual_tangents>::of,
        nullptr,
        Place::template Call<&Functions::c_newton_solves>::of,
        several ? Place::template Call<&Functions::c_accelerations>::of : Place::template Call<&Functions::c_acceleration>::of,
        several ? functions.sets_at_once() : 1,
    };
  }
};

}  // namespace

catena_model table_at_place(int place, int links) {
  return catena::table_at_place(place, links, MakeTable{});
}

}  // namespace catena::chain_any
