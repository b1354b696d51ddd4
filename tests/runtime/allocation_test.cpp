// SPDX-License-Identifier: BSD-3-Clause
//
// No step of a simulation allocates: a run of many more steps calls malloc no more often.
#include <doctest/doctest.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include "runtime/any_links.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"
#include "tests/runtime/cable_case.hpp"
#include "tests/runtime/reference_model.hpp"

namespace {

std::atomic<long> allocations{0};

}  // namespace

// Every allocation of the process is counted: operator new, Eigen's and SUNDIALS' malloc.
#if defined(__SANITIZE_ADDRESS__)

#include <sanitizer/allocator_interface.h>

namespace {

[[maybe_unused]] const int installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t) { ++allocations; }, [](const volatile void*) {});

}  // namespace

#elif defined(__GLIBC__)

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  ++allocations;
  return __libc_realloc(block, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  ++allocations;
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}
}

#else
#error "no way is known to count allocations here; this test would check nothing"
#endif

namespace {

TEST_CASE("allocations of every kind are counted") {
  const auto counted = [](const auto& allocate) {
    const long before = allocations;
    void* volatile block = allocate();
    const long after = allocations;
    std::free(block);
    return after > before;
  };
  CHECK(counted([] { return std::malloc(24); }));
  CHECK(counted([] { return std::calloc(3, 8); }));
  CHECK(counted([] { return std::realloc(nullptr, 24); }));
  CHECK(counted([] { return std::aligned_alloc(64, 64); }));
  const long before = allocations;
  const std::vector<double> made(100);
  const double* volatile first = made.data();  // keeps the compiler from leaving the vector out
  CHECK(first != nullptr);
  CHECK(allocations > before);
}

struct Count {
  long steps, allocations;
};

Count count(const catena::Model& model, double last, bool sensitivities,
            catena::LinearSolver solver) {
  const auto p = catena::testing::cable_parameters(model, 20.0, 0.1);
  const auto start = catena::straight(model, 0.6);
  std::vector<catena::SensitivityDirection> directions;
  if (sensitivities)
    directions = {catena::SensitivityDirection::parameter(model, 0),
                  catena::SensitivityDirection::parameter(model, 5)};
  catena::SimulationOptions options;
  options.linear_solver = solver;
  const long before = allocations;
  const auto run =
      catena::simulate_with_sensitivities(model, p, start, directions, {0.0, last}, options);
  const long after = allocations;
  REQUIRE(run.status == catena::Status::kSuccess);
  return {run.statistics.steps, after - before};
}

TEST_CASE("steps do not allocate") {
  for (const auto& model : {catena::Model::built_in(12), catena::any_links_model(12)})
    for (const bool sensitivities : {false, true})
      for (const auto solver : {catena::LinearSolver::kStructured, catena::LinearSolver::kDense}) {
        CAPTURE(sensitivities);
        const Count few = count(model, 0.1, sensitivities, solver),
                    many = count(model, 1.0, sensitivities, solver);
        CHECK(few.allocations > 0);
        CHECK(many.steps > 3 * few.steps);
        CHECK(many.allocations == few.allocations);
      }
}

}  // namespace
